// moire render: one sampled image and its error.
#include <fmt/format.h>

#include <variant>

#include "app/commands.h"
#include "app/definition.h"
#include "app/image_files.h"
#include "app/output.h"
#include "app/scene_argument.h"
#include "core/args.h"
#include "reports/json.h"
#include "study/file_names.h"
#include "study/run.h"
#include "study/sample_maker.h"
#include "study/study.h"

namespace moire {
namespace {

// A study of one case.
Study study_of(const RenderOptions& options) {
  Study study;
  study.scenes = {load_scene(options.scene)};
  study.patterns = {PatternChoice(parse_spec(options.pattern, "--pattern"))};
  study.spp = {static_cast<int>(options.spp)};
  study.filters = {Filter(parse_spec(options.filter, "--filter"))};
  study.layouts = {find_layout(options.layout, "--layout")};
  study.estimators = {EstimatorChoice(find_estimator(options.estimator, "--estimator"))};
  require_layout(study.estimators[0].value, study.layouts[0], "--estimator");
  study.seed = options.seed;
  study.images = Images::none;
  return study;
}

// The row, then the scene with the doubles that define it.
std::string row_json(const Study& study, const Row& row) {
  std::string text = json_row(row, "");
  text.pop_back();
  return text + ",\"definition\":" + scene_json(study.scenes[0]) + "}\n";
}

std::string cell_text(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return shortest(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return std::to_string(*integer);
  if (const auto* flag = std::get_if<bool>(&cell)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return {};
}

// One line per cell that has a value.
std::string row_text(const Row& row) {
  std::string lines;
  for (const auto& [name, cell] : row.cells()) {
    if (!std::holds_alternative<std::monostate>(cell)) lines += fmt::format("{:<24} {}\n", name, cell_text(cell));
  }
  return lines;
}

}  // namespace

Exit execute(const RenderOptions& options) {
  check_image_path("-o", options.out);
  check_image_path("--error", options.error);
  if (!options.out.empty() && options.out == options.error) {
    throw Error("--error", "\"" + options.error + "\" is the file of -o, too; give two names");
  }
  const Study study = study_of(options);
  if (study.scenes[0].image.moves()) study.patterns[0].require_time();
  // An exhaustive image is dense in memory, too.
  if (!options.out.empty() || !options.error.empty() || options.exhaustive) check_image_size(study.scenes[0], "SCENE");
  require_renderable(study.scenes[0].image.grid(), study.filters[0], study.estimators[0].value, study.spp[0], "SCENE");
  Case c;
  c.trial = options.trial;
  SampleMaker maker(study);
  const Samples samples = maker.samples(c);
  const Truth truth = find_truth(study.scenes[0].image, study.filters[0]);
  const CaseResult result = run_case(study, c, samples, maker.time_ns(), truth, options.exhaustive);
  if (!options.out.empty()) write_got_exr(options.out, study, c, truth, result);
  if (!options.error.empty()) write_error_exr(options.error, study, c, truth, result);
  print(options.json ? row_json(study, result.row) : row_text(result.row));
  return Exit::ok;
}

}  // namespace moire
