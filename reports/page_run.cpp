// A run as a page takes it.
#include "reports/page_run.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "reports/json.h"
#include "reports/pattern_ranking.h"
#include "study/discrepancy_study.h"
#include "study/document.h"
#include "study/filter_table.h"
#include "study/text_file.h"

namespace moire {
namespace {

namespace fs = std::filesystem;

using Tables = std::vector<std::pair<std::string, Table>>;

constexpr std::string_view kFiles[] = {"results.jsonl", "bench.jsonl", "stress.jsonl"};
constexpr std::string_view kNeeded = "give a folder of moire run, bench or stress, or its .jsonl file";

void add(Tables& tables, std::string_view name, Table table) {
  if (!table.empty()) tables.emplace_back(name, std::move(table));
}

// What the page calls the kinds of rows of a file of several tables.
std::string table_name(std::string_view schema, const std::string& kind) {
  const bool bench = schema == kBenchSchema;
  if (kind == "row") return bench ? "bench" : "stress";
  return kind == "exponent" ? "exponents" : kind;
}

// Of the filters of the rows, where the run has such a table.
Table filters_of(const PageRun& run) {
  if (!fs::exists(fs::path(run.folder) / "filters.csv")) return {};
  std::vector<Filter> filters;
  for (const Row& row : run.rows) {
    const std::string_view name = row.text("filter");
    const bool known = std::any_of(filters.begin(), filters.end(), [&](const Filter& f) { return f.text() == name; });
    if (name.empty() || known) continue;
    try {
      filters.emplace_back(parse_spec(name, "filter"));
    } catch (const Error&) {
      // It needs a file that is not where the study found it; page_filters() tells of it.
    }
  }
  return filter_table(filters);
}

// Discrepancies are summarised by the plan of their study, which the header has.
Tables discrepancy_tables(const PageRun& run, const std::string& path) {
  const std::string text = text_at(run.header, "/study/text"), name = text_at(run.header, "/study/name");
  const DiscrepancyStudy study = parse_discrepancy_study(parse_toml(text, path + ":1"), text, name);
  const DiscrepancyPlan planned = plan(study);
  if (planned.rows != run.rows.size()) {
    throw Error(path, "has " + std::to_string(run.rows.size()) + " of the " + std::to_string(planned.rows) +
                          " rows of its study; go on with moire run --resume first");
  }
  return page_tables(summarize(study, planned, run.rows));
}

std::string schema_of(const std::string& path) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  errno = 0;
  std::string header;
  std::getline(file, header);
  if (!file && !file.eof()) {
    throw Error(path, std::string("cannot be read: ") + std::strerror(errno == 0 ? ENOENT : errno), Exit::io);
  }
  return text_at(header, "/schema");
}

PageRun read_run(const std::string& path) {
  PageRun run;
  run.folder = fs::path(path).parent_path().string();
  if (run.folder.empty()) run.folder = ".";
  const std::string schema = schema_of(path);
  if (schema == kResultsSchema) {
    ResultsFile file = read_results(path);
    run.header = std::move(file.header);
    run.rows = std::move(file.rows);
    const bool of_discrepancies = !run.rows.empty() && run.rows.front().find("measure") != nullptr;
    run.tables =
        of_discrepancies ? discrepancy_tables(run, path) : page_tables(run.rows, summarize(run.rows), filters_of(run));
  } else if (schema == kBenchSchema || schema == kStressSchema) {
    JsonTables file = read_json_tables(path);
    run.header = std::move(file.header);
    for (auto& [kind, table] : file.tables) add(run.tables, table_name(schema, kind), std::move(table));
  } else {
    throw Error(path, "has the schema \"" + schema + "\"; " + std::string(kNeeded));
  }
  return run;
}

}  // namespace

Tables page_tables(const Table& rows, const Summary& summary, const Table& filters) {
  Tables tables;
  Table timed = with_times(summary.rows, rows);
  add(tables, "ranking", rank_patterns(timed));
  add(tables, "summary", std::move(timed));
  add(tables, "slopes", summary.slopes);
  add(tables, "filters", filters);
  add(tables, "filter_ranking", summary.filters);
  add(tables, "noise_ranking", summary.noise);
  add(tables, "correlations", summary.correlations);
  return tables;
}

Tables page_tables(const DiscrepancySummary& summary) {
  Tables tables;
  add(tables, "summary", summary.rows);
  add(tables, "slopes", summary.slopes);
  return tables;
}

std::vector<PageRun> read_runs(const std::string& path) {
  std::error_code none;  // what cannot be asked about is no folder; reading it will say what is wrong
  if (!fs::is_directory(path, none)) return {read_run(path)};
  std::vector<PageRun> runs;
  for (const std::string_view name : kFiles) {
    const fs::path file = fs::path(path) / name;
    if (fs::exists(file, none)) runs.push_back(read_run(file.string()));
  }
  if (runs.empty()) throw Error(path, "holds no results; " + std::string(kNeeded), Exit::usage);
  return runs;
}

}  // namespace moire
