// moire run: a study's results, images and report.
#include "study/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "app/commands.h"
#include "app/image_files.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/studies.h"
#include "core/parallel.h"
#include "reports/csv.h"
#include "reports/file.h"
#include "reports/json.h"
#include "reports/markdown.h"
#include "reports/provenance.h"
#include "reports/terminal.h"
#include "study/study.h"
#include "study/summary.h"

namespace moire {
namespace {

void print_plan(const Study& study, const std::vector<Case>& cases) {
  print(fmt::format("# {} cases: scene pattern spp filter estimator trial\n", cases.size()));
  for (const Case& c : cases) print(describe(study, c) + "\n");
}

void write_reports(const std::string& folder, const Study& study, const Table& rows) {
  const Summary summary = summarize(rows);
  write_whole(folder + "/results.csv", csv(rows));
  write_whole(folder + "/summary.csv", csv(summary.rows));
  const std::string report = folder + "/report.md";
  write_whole(report, markdown_report(study.name, rows, summary));
  print(terminal_tables(summary, ::isatty(STDOUT_FILENO) != 0));
  print("report: " + report + "\n");
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
  if (study.images != Images::none) make_folder(options.folder + "/images");
  const std::string path = options.folder + "/results.jsonl";
  JsonLines results(path, json_header(tool(), host(), {study.name, study.text}));

  watch_interrupts();
  Results outcome;
  {
    Progress progress(cases.size());
    Observer observer;
    observer.row = [&](const Row& row) { results.append(row); };
    observer.exact_image = [&](std::uint32_t scene, std::uint32_t filter, const Truth& truth) {
      write_exact_images(options.folder, study, scene, filter, truth);
    };
    observer.case_image = [&](const Case& c, const Truth& truth, const CaseResult& result) {
      write_case_images(options.folder, study, c, truth, result);
    };
    observer.progress = [&](double share) { progress.step(share); };
    observer.stop = interrupted;
    outcome = run(study, cases, observer);
  }
  results.finish(outcome.rows);
  if (!outcome.complete) {
    throw Error(path,
                fmt::format("interrupted; the {} of {} rows that were finished are kept here", outcome.rows.size(),
                            cases.size()),
                Exit::interrupted);
  }
  write_reports(options.folder, study, outcome.rows);
  return Exit::ok;
}

}  // namespace moire
