// moire run: a study's results, images and report.
#include "study/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/folder_lock.h"
#include "app/image_files.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/resume.h"
#include "app/studies.h"
#include "core/parallel.h"
#include "reports/csv.h"
#include "reports/file.h"
#include "reports/json.h"
#include "reports/markdown.h"
#include "reports/provenance.h"
#include "reports/terminal.h"
#include "study/filter_table.h"
#include "study/study.h"
#include "study/summary.h"

namespace moire {
namespace {

void print_plan(const Study& study, const std::vector<Case>& cases) {
  print(fmt::format("# {} cases: scene pattern spp filter estimator trial [layout]\n", cases.size()));
  for (const Case& c : cases) print(describe(study, c) + "\n");
}

void write_reports(const std::string& folder, const Study& study, const Table& rows) {
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
  const std::string report = folder + "/report.md";
  write_whole(report, markdown_report(study.name, rows, summary, filters));
  print(terminal_tables(summary, ::isatty(STDOUT_FILENO) != 0));
  print("report: " + report + "\n");
}

// The results that are to go on, if there are any.
Earlier take_up(const std::string& path, const std::string& header, const Study& study,
                const std::vector<Case>& cases) {
  Earlier earlier = find_earlier(path, header, study, cases);
  if (!earlier.file.cut.empty()) {
    say(path, fmt::format("the last line was cut after {} bytes, and is left out", earlier.file.cut.size()));
  }
  return earlier;
}

// What a new run will not write at once must not stand beside its results as if it were theirs.
void remove_reports(const std::string& folder) {
  for (const char* name :
       {"/results.csv", "/summary.csv", "/filters.csv", "/filter_ranking.csv", "/noise_ranking.csv", "/report.md"}) {
    std::error_code ignored;  // a file that cannot be removed cannot be written either, which is told then
    std::filesystem::remove(folder + name, ignored);
  }
}

}  // namespace

Exit execute(const RunOptions& options) {
  const Study study = load_study(options.study);
  const std::vector<Case> cases = plan(study);
  if (options.dry_run) {
    print_plan(study, cases);
    return Exit::ok;
  }
  const ThreadLimit limit(options.threads);
  // Whatever is wrong with the folder shows before the work begins.
  make_folder(options.folder);
  const FolderLock lock(options.folder);
  if (study.images != Images::none) make_folder(options.folder + "/images");
  const std::string path = options.folder + "/results.jsonl";
  const std::string header = json_header(tool(), host(), {study.name, study.text});
  Earlier earlier;
  if (options.resume) earlier = take_up(path, header, study, cases);
  const bool goes_on = !earlier.file.header.empty();
  const bool replaces = !options.resume && std::filesystem::is_regular_file(path);
  JsonLines results = goes_on ? JsonLines(path, earlier.file) : JsonLines(path, header);
  if (!goes_on) remove_reports(options.folder);
  if (replaces) say(path, "earlier results are replaced; --resume would have gone on with them");

  watch_interrupts();
  Results outcome;
  {
    Progress progress;
    Observer observer;
    observer.row = [&](const Row& row) { results.append(row); };
    observer.exact_image = [&](std::uint32_t scene, std::uint32_t filter, const Truth& truth) {
      write_exact_images(options.folder, study, scene, filter, truth);
    };
    observer.case_image = [&](const Case& c, const Truth& truth, const CaseResult& result) {
      write_case_images(options.folder, study, c, truth, result);
    };
    observer.spectra = [&](const Case& c, const Spectra& spectra) {
      write_spectra_files(options.folder, study, c, spectra);
    };
    if (goes_on) {
      observer.has_exact_image = [&](std::uint32_t scene, std::uint32_t filter) {
        return has_exact_images(options.folder, study, scene, filter);
      };
      observer.has_spectra = [&](const Case& c) { return has_spectra_files(options.folder, study, c); };
      observer.has_case_image = [&](const Case& c) { return has_case_images(options.folder, study, c); };
    }
    observer.progress = [&](std::size_t done, std::size_t due, double share) { progress.step(done, due, share); };
    observer.stop = interrupted;
    outcome = run(study, cases, observer, std::move(earlier.rows));
  }
  results.finish(outcome.rows);
  if (!outcome.complete) {
    throw Error(
        path,
        fmt::format("interrupted; the {} of {} rows that were finished are kept here; this goes on: moire run {} "
                    "-o {} --resume",
                    outcome.rows.size(), cases.size(), options.study, options.folder),
        Exit::interrupted);
  }
  write_reports(options.folder, study, outcome.rows);
  return Exit::ok;
}

}  // namespace moire
