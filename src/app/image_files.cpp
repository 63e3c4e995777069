// Writing the images of cases: float EXR with what defines the image, and PNG previews.
#include "app/image_files.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <system_error>
#include <vector>

#include "app/definition.h"
#include "core/args.h"
#include "core/parallel.h"
#include "core/sum.h"
#include "reports/csv.h"
#include "reports/file.h"
#include "reports/images.h"
#include "reports/preview.h"
#include "reports/spectrum_preview.h"
#include "study/file_names.h"
#include "study/noise_measures.h"

namespace moire {
namespace {

// -0.0 becomes +0.0; all else stays.
float to_float(double value) { return static_cast<float>(value) + 0.0F; }

// The image of what windows without boundary hold: 0 or 1, or no error at all.
std::vector<float> flat_image(const ActiveRows& rows, bool is_error) {
  const Grid grid = rows.grid();
  std::vector<float> image(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  if (is_error) return image;
  auto out = image.begin();
  for (int y = 0; y < grid.height; ++y) {
    for (const Run& run : rows.row(y)) {
      const auto count = static_cast<std::ptrdiff_t>(run.x1 - run.x0);
      if (run.cover == Cover::all) std::fill_n(out, count, 1.0F);
      out += count;
    }
  }
  return image;
}

std::size_t pixel_index(const ActiveRows& rows, int x, int y) {
  return static_cast<std::size_t>(std::int64_t{y} * rows.grid().width + x);
}

std::vector<float> dense_exact(const Truth& truth) {
  std::vector<float> image = flat_image(truth.rows, false);
  for_each_active(truth.rows, [&](int x, int y, std::int64_t i) {
    image[pixel_index(truth.rows, x, y)] = to_float(truth.exact.value[static_cast<std::size_t>(i)]);
  });
  return image;
}

std::vector<float> dense_got(const Truth& truth, const CaseResult& result) {
  std::vector<float> image = flat_image(truth.rows, false);
  for_each_rendered(truth.rows, result.got,
                    [&](int x, int y, Cover, double value) { image[pixel_index(truth.rows, x, y)] = to_float(value); });
  return image;
}

std::vector<float> dense_error(const Truth& truth, const CaseResult& result) {
  std::vector<float> image = flat_image(truth.rows, true);
  std::size_t active = 0;
  for_each_rendered(truth.rows, result.got, [&](int x, int y, Cover cover, double value) {
    const double error = cover == Cover::partial ? result.error[active++] : value - (cover == Cover::all ? 1.0 : 0.0);
    image[pixel_index(truth.rows, x, y)] = to_float(error);
  });
  return image;
}

std::vector<Attribute> exact_attributes(const Study& study, std::uint32_t scene, std::uint32_t filter) {
  return {{"moire:schema", "moire.image/1"},
          {"moire:kind", "exact"},
          {"moire:scene", scene_json(study.scenes[scene])},
          {"moire:filter", study.filters[filter].text()},
          {"moire:params", params_json(nullptr, study.filters[filter])}};
}

std::vector<Attribute> case_attributes(const char* kind, const Study& study, const Case& c) {
  const PatternChoice& pattern = study.patterns[c.pattern];
  const Filter& filter = study.filters[c.filter];
  return {{"moire:schema", "moire.image/1"},
          {"moire:kind", kind},
          {"moire:scene", scene_json(study.scenes[c.scene])},
          {"moire:pattern", pattern.text()},
          {"moire:filter", filter.text()},
          {"moire:estimator", study.estimators[c.estimator].text},
          {"moire:layout", std::string(name_of(study.layouts[c.layout]))},
          {"moire:spp", std::int64_t{study.spp[c.spp]}},
          {"moire:seed", static_cast<std::int64_t>(study.seed)},
          {"moire:trial", std::int64_t{c.trial}},
          {"moire:params", params_json(&pattern, filter)}};
}

// Power over its mean without zero frequency, so that white noise is the same grey in every picture.
Raster relative_preview(Grid grid, std::vector<float> power) {
  Sum sum;
  for (const float p : power) sum.add(static_cast<double>(p));
  const auto center = static_cast<std::size_t>(std::int64_t{grid.height / 2} * grid.width + grid.width / 2);
  const double mean =
      (sum.value() - static_cast<double>(power[center])) / std::max(1.0, static_cast<double>(power.size()) - 1);
  if (mean > 0) {
    for (float& p : power) p = static_cast<float>(static_cast<double>(p) / mean);
  }
  Raster picture = spectrum_preview(grid, power, PowerScale::linear);
  picture.text.emplace_back("moire:unit", shortest(mean) + ", the mean power without zero frequency");
  return picture;
}

// Empty files are none: a system that stopped may keep the name of a file and not its bytes.
bool all_there(const std::string& stem, std::initializer_list<const char*> endings) {
  return std::all_of(endings.begin(), endings.end(), [&](const char* ending) {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(stem + ending, missing);
    return !missing && size > 0;
  });
}

}  // namespace

void write_exact_exr(const std::string& path, const Study& study, std::uint32_t scene, std::uint32_t filter,
                     const Truth& truth) {
  write_exr(path, truth.rows.grid(), dense_exact(truth), exact_attributes(study, scene, filter));
}

void write_got_exr(const std::string& path, const Study& study, const Case& c, const Truth& truth,
                   const CaseResult& result) {
  write_exr(path, truth.rows.grid(), dense_got(truth, result), case_attributes("got", study, c));
}

void write_error_exr(const std::string& path, const Study& study, const Case& c, const Truth& truth,
                     const CaseResult& result) {
  write_exr(path, truth.rows.grid(), dense_error(truth, result), case_attributes("error", study, c));
}

void write_exact_images(const std::string& folder, const Study& study, std::uint32_t scene, std::uint32_t filter,
                        const Truth& truth) {
  const std::string stem = folder + "/" + exact_stem(study, scene, filter);
  const std::vector<float> image = dense_exact(truth);
  write_exr(stem + ".exact.exr", truth.rows.grid(), image, exact_attributes(study, scene, filter));
  write_png(stem + ".exact.png", reconstruction_preview(truth.rows.grid(), image));
}

void write_case_images(const std::string& folder, const Study& study, const Case& c, const Truth& truth,
                       const CaseResult& result) {
  const Grid grid = truth.rows.grid();
  const std::string stem = folder + "/" + image_stem(study, c);
  const std::vector<float> got = dense_got(truth, result), error = dense_error(truth, result);
  // Together, unless they are large: then there is memory for one at a time, and the formats have threads of their own.
  const std::function<void()> writers[kWrittenTogether] = {
      [&] { write_png(stem + ".error.png", error_preview(grid, error, result.active.p995)); },
      [&] { write_exr(stem + ".got.exr", grid, got, case_attributes("got", study, c)); },
      [&] { write_png(stem + ".got.png", reconstruction_preview(grid, got)); },
      [&] { write_exr(stem + ".error.exr", grid, error, case_attributes("error", study, c)); },
  };
  const std::size_t together = got.size() <= kSmallImage ? 1 : kWrittenTogether;  // taken by one thread
  parallel_for(
      kWrittenTogether, [&](std::size_t i) { writers[i](); }, together);
}

void write_spectra_files(const std::string& folder, const Study& study, const Case& c, const Spectra& spectra) {
  const Grid grid{spectra.width, spectra.height};
  const std::string stem = folder + "/" + spectra_stem(study, c);
  const auto write = [&](const char* ending, const char* kind, const std::vector<double>& power) {
    std::vector<float> image;
    for (const double p : power) image.push_back(to_float(p));
    write_exr(stem + ending, grid, image, case_attributes(kind, study, c));
    return image;
  };
  const std::vector<float> total = write(".spectrum.exr", "spectrum", spectra.total);
  if (spectra.has_split()) {
    write(".structured.exr", "structured spectrum", spectra.structured);
    write(".noise.exr", "noise spectrum", spectra.noise);
  }
  write_png(stem + ".spectrum.png", relative_preview(grid, total));
  write_whole(stem + ".spectrum.csv", csv(radial_rows(spectra)));
}

bool has_spectra_files(const std::string& folder, const Study& study, const Case& c) {
  return all_there(folder + "/" + spectra_stem(study, c), {".spectrum.exr", ".spectrum.png", ".spectrum.csv"});
}

bool has_exact_images(const std::string& folder, const Study& study, std::uint32_t scene, std::uint32_t filter) {
  return all_there(folder + "/" + exact_stem(study, scene, filter), {".exact.exr", ".exact.png"});
}

bool has_case_images(const std::string& folder, const Study& study, const Case& c) {
  return all_there(folder + "/" + image_stem(study, c), {".got.exr", ".error.exr", ".got.png", ".error.png"});
}

}  // namespace moire
