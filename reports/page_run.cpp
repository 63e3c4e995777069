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
#include "reports/page_plan.h"
#include "reports/page_rows.h"
#include "study/filter_table.h"
#include "study/pattern_ranking.h"
#include "study/row_keys.h"
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

// Says how far a run has come that was stopped, or still goes on.
void tell_rows(PageRun& run, std::size_t planned) {
  if (run.rows.size() == planned) return;
  run.notices.push_back("The run is not complete: " + std::to_string(run.rows.size()) + " of the " +
                        std::to_string(planned) + " rows of its study are here; moire run --resume goes on with it.");
}

Tables set_tables(PageRun& run, const std::string& path) {
  const WholeSets whole = whole_sets(run.header, run.rows, path);
  tell_rows(run, whole.planned);
  return page_tables(summarize(whole.study, whole.plan, whole.rows));
}

Tables image_tables(PageRun& run) {
  if (const auto planned = order_by_plan(run.header, run.rows)) {
    tell_rows(run, *planned);
  } else if (run.rows.empty()) {
    run.notices.emplace_back("The run has no rows yet; moire run --resume goes on with it.");
  }
  return page_tables(run.rows, summarize(run.rows), filters_of(run));
}

void read_study_run(PageRun& run, const std::string& path) {
  ResultsFile file = read_results(path);
  check_header(file.header, path + ":1");
  check_rows(file.rows, path);
  run.header = std::move(file.header);
  run.rows = std::move(file.rows);
  if (!file.cut.empty()) run.notices.emplace_back("The last line of the results is cut, and is left out.");
  const bool of_sets = run.rows.empty() ? is_of_sets(run.header) : is_set_row(run.rows.front());
  run.tables = of_sets ? set_tables(run, path) : image_tables(run);
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
    read_study_run(run, path);
  } else if (schema == kBenchSchema || schema == kStressSchema) {
    JsonTables file = read_json_tables(path);
    check_header(file.header, path + ":1");
    run.header = std::move(file.header);
    for (auto& [kind, table] : file.tables) add(run.tables, table_name(schema, kind), std::move(table));
  } else if (schema.empty()) {
    throw Error(path, "is no results file of moire; give a run's folder or its results.jsonl");
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
