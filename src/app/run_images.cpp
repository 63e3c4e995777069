// A study of images: its results, pictures and report.
#include "app/run_images.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "app/image_files.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/page.h"
#include "app/progress.h"
#include "app/run_folder.h"
#include "core/parallel.h"
#include "reports/csv.h"
#include "reports/file.h"
#include "reports/markdown.h"
#include "reports/terminal.h"
#include "study/filter_table.h"
#include "study/row_keys.h"
#include "study/run.h"
#include "study/summary.h"

namespace moire {
namespace {

constexpr auto kReports =
    std::to_array<std::string_view>({"results.csv", "summary.csv", "filters.csv", "filter_ranking.csv",
                                     "noise_ranking.csv", "correlations.csv", "report.md", "index.html"});

void print_plan(const Study& study, const std::vector<Case>& cases) {
  print(fmt::format("# {} cases: scene pattern spp filter estimator trial [layout]\n", cases.size()));
  for (const Case& c : cases) print(describe(study, c) + "\n");
}

// Takes the rows; the page is the last file of a run.
void write_reports(const RunFolder& run, const Study& study, Table rows) {
  const std::string& folder = run.path();
  const Summary summary = summarize(rows);
  write_whole(folder + "/results.csv", csv(rows));
  write_whole(folder + "/summary.csv", csv(summary.rows));
  Table filters;
  if (study.measures.has(Measure::kernel)) {
    filters = filter_table(study.filters);
    write_whole(folder + "/filters.csv", csv(filters));
  }
  if (!summary.filters.empty()) write_whole(folder + "/filter_ranking.csv", csv(summary.filters));
  if (!summary.noise.empty()) write_whole(folder + "/noise_ranking.csv", csv(summary.noise));
  if (!summary.correlations.empty()) write_whole(folder + "/correlations.csv", csv(summary.correlations));
  const std::string report = folder + "/report.md";
  write_whole(report, markdown_report(study.name, rows, summary, filters));
  print(terminal_tables(summary, ::isatty(STDOUT_FILENO) != 0));
  print("report: " + report + "\n");
  auto tables = page_tables(rows, summary, filters);
  write_run_page({run.header(), folder, std::move(rows), std::move(tables)});
}

}  // namespace

Exit run_study(const RunOptions& options, const Study& study) {
  const std::vector<Case> cases = plan(study);
  if (options.dry_run) {
    print_plan(study, cases);
    return Exit::ok;
  }
  const ThreadLimit limit(options.threads);
  const PlannedRows planned{study.seed, row_keys(study, cases), image_row_key};
  RunFolder folder(options, {study.name, study.text}, planned, kReports, study.images != Images::none);

  watch_interrupts();
  Results outcome;
  {
    Progress progress;
    Observer observer;
    observer.row = [&](const Row& row) { folder.append(row); };
    observer.exact_image = [&](std::uint32_t scene, std::uint32_t filter, const Truth& truth) {
      write_exact_images(folder.path(), study, scene, filter, truth);
    };
    observer.case_image = [&](const Case& c, const Truth& truth, const CaseResult& result) {
      write_case_images(folder.path(), study, c, truth, result);
    };
    observer.spectra = [&](const Case& c, const Spectra& spectra) {
      write_spectra_files(folder.path(), study, c, spectra);
    };
    if (folder.goes_on()) {
      observer.has_exact_image = [&](std::uint32_t scene, std::uint32_t filter) {
        return has_exact_images(folder.path(), study, scene, filter);
      };
      observer.has_spectra = [&](const Case& c) { return has_spectra_files(folder.path(), study, c); };
      observer.has_case_image = [&](const Case& c) { return has_case_images(folder.path(), study, c); };
    }
    observer.progress = [&](std::size_t done, std::size_t due, double share) { progress.step(done, due, share); };
    observer.stop = interrupted;
    outcome = run(study, cases, observer, folder.take_rows());
  }
  folder.finish(outcome.rows, outcome.complete);
  write_reports(folder, study, std::move(outcome.rows));
  return Exit::ok;
}

}  // namespace moire
