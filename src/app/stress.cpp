// moire stress: the worst errors that adversarial cases find.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/folder_lock.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/page.h"
#include "app/progress.h"
#include "core/names.h"
#include "core/parallel.h"
#include "reports/csv.h"
#include "reports/file.h"
#include "reports/json.h"
#include "reports/provenance.h"
#include "reports/stress_report.h"
#include "stress/hunt.h"

namespace moire {
namespace {

constexpr std::string_view kPlotFile = "stress.svg";

std::vector<stress::Family> chosen_families(const std::vector<std::string>& names) {
  const std::span<const stress::Family> all = stress::families();
  if (names.empty()) return {all.begin(), all.end()};
  std::vector<stress::Family> chosen;
  for (const std::string& name : names) {
    const auto is_it = [&](const stress::Family& f) { return f.name == name; };
    const auto at = std::find_if(all.begin(), all.end(), is_it);
    if (at == all.end()) {
      std::vector<std::string_view> known;
      for (const stress::Family& family : all) known.push_back(family.name);
      throw Error("--family", unknown_name("family", name, known));
    }
    if (std::any_of(chosen.begin(), chosen.end(), is_it)) throw Error("--family", "\"" + name + "\" is listed twice");
    chosen.push_back(*at);
  }
  return chosen;
}

// What a hunt is, in the words of a study: its seed and size.
std::string header_of(const StressOptions& options) {
  const std::string text =
      "cases = " + std::to_string(options.cases) + "\nseed = " + std::to_string(options.seed) + "\n";
  return json_header(tool(), host(), {"stress", text}, kStressSchema);
}

}  // namespace

Exit execute(const StressOptions& options) {
  const std::vector<stress::Family> families = chosen_families(options.families);
  if (options.only_case) {
    const stress::CaseKey key{options.seed, *options.only_case};
    const stress::Outcome outcome = stress::run_case(families.front(), key);
    print(stress_case_text(families.front(), key, outcome));
    return stress::passes(outcome) ? Exit::ok : Exit::failed;
  }
  std::optional<FolderLock> lock;
  if (!options.folder.empty()) {
    make_folder(options.folder);
    lock.emplace(options.folder);
    check_page_path(options.folder + "/index.html");
  }
  const ThreadLimit limit(options.threads);
  watch_interrupts();
  std::vector<stress::Findings> findings;
  {
    Progress progress;
    findings =
        stress::hunt(families, {.cases = options.cases,
                                .seed = options.seed,
                                .progress =
                                    [&](std::uint64_t done, std::uint64_t due) {
                                      progress.step(done, due, static_cast<double>(done) / static_cast<double>(due));
                                    },
                                .stop = interrupted});
  }
  if (interrupted()) {
    throw Error("moire stress", "interrupted; nothing is written, since a part of the cases says too little",
                Exit::interrupted);
  }
  const Table rows = stress_rows(findings, options.seed), growth = growth_rows(findings),
              failures = failure_rows(findings, options.seed);
  const auto json_of = [&](decltype(json_lines)* form) {
    return form(header_of(options),
                {{"rows", "row", &rows}, {"growth", "growth", &growth}, {"failures", "failure", &failures}});
  };
  // First, so that a folder that fails now loses nothing.
  print(options.json ? json_of(json_object) : stress_text(rows, failures));
  flush_output();
  if (!options.folder.empty()) {
    const auto write = [&](std::string_view name, const std::string& text) {
      write_whole(options.folder + "/" + std::string(name), text);
    };
    write("stress.jsonl", json_of(json_lines));
    write("stress.csv", csv(rows));
    write("growth.csv", csv(growth));
    write(kPlotFile, log_plot_svg(stress_plot(findings)));
    write("report.md", stress_markdown(rows, failures, tool(), host(), kPlotFile));
    const std::string page = write_folder_page(options.folder);
    if (!options.json) print("report: " + options.folder + "/report.md\n");
    if (!options.json && !page.empty()) print("report: " + page + "\n");
  }
  return failures.empty() ? Exit::ok : Exit::failed;
}

}  // namespace moire
