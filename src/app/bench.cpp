// moire bench: run time against error.
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "app/commands.h"
#include "app/folder_lock.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/page.h"
#include "app/progress.h"
#include "app/studies.h"
#include "reports/bench_report.h"
#include "reports/csv.h"
#include "reports/file.h"
#include "reports/json.h"
#include "reports/provenance.h"
#include "study/benchmark.h"

namespace moire {
namespace {

constexpr std::string_view kPlotFile = "bench.svg";

Study image_study(const std::string& word) {
  AnyStudy study = load_study(word);
  if (auto* images = std::get_if<Study>(&study)) return std::move(*images);
  throw Error("STUDY",
              "\"" + word + "\" has no scenes, and so no images to time; give a study with scenes, such as bench");
}

std::string header_of(const Study& study) {
  return json_header(tool(), host(), {study.name, study.text}, kBenchSchema);
}

// What is written as lines and printed as an object.
std::string json_of(const Study& study, const Benchmark& benchmark, decltype(json_lines)* form) {
  return form(header_of(study), {{"rows", "row", &benchmark.rows},
                                 {"exponents", "exponent", &benchmark.exponents},
                                 {"scaling", "scaling", &benchmark.scaling}});
}

void write_files(const std::string& folder, const Study& study, const Benchmark& benchmark) {
  const auto write = [&](std::string_view name, const std::string& text) {
    write_whole(folder + "/" + std::string(name), text);
  };
  write("bench.csv", csv(benchmark.rows));
  write("bench.jsonl", json_of(study, benchmark, json_lines));
  write(kPlotFile, log_plot_svg(bench_plot(study.name, benchmark.rows)));
  write("report.md", bench_markdown(study.name, benchmark, tool(), host(), kPlotFile));
}

}  // namespace

Exit execute(const BenchOptions& options) {
  const Study study = image_study(options.study);
  std::optional<FolderLock> lock;
  if (!options.folder.empty()) {
    make_folder(options.folder);
    lock.emplace(options.folder);
    check_page_path(options.folder + "/index.html");
  }
  BenchmarkSettings settings;
  settings.repeats = options.repeats;
  settings.threads = options.threads;
  watch_interrupts();
  Benchmark benchmark;
  {
    Progress progress;
    benchmark = run_benchmark(
        study, settings,
        {.progress = [&](std::size_t done, std::size_t due, double share) { progress.step(done, due, share); },
         .stop = interrupted});
  }
  if (!benchmark.complete) {
    throw Error("moire bench", "interrupted; nothing is written, since medians need all repeats", Exit::interrupted);
  }
  // First, so that a folder that fails now loses nothing.
  print(options.json ? json_of(study, benchmark, json_object) : bench_text(benchmark, host()));
  flush_output();
  if (!options.folder.empty()) {
    write_files(options.folder, study, benchmark);
    const std::string page = write_folder_page(options.folder);
    if (!options.json) print("report: " + options.folder + "/report.md\n");
    if (!options.json && !page.empty()) print("report: " + page + "\n");
  }
  for (const Row& row : benchmark.rows) {
    const Cell* same = row.find("exhaustive_same");
    if (same != nullptr && *same == Cell(false)) return Exit::failed;
  }
  return Exit::ok;
}

}  // namespace moire
