// A run as a page takes it: its header, its rows, its tables. From memory when it has just ended, or read from its
// folder.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/discrepancy_summary.h"
#include "study/results.h"
#include "study/summary.h"

namespace moire {

struct PageRun {
  std::string header;  // the JSON line that begins its results
  std::string folder;  // of its files, on disk
  Table rows;          // of results.jsonl; images, filters and patterns are found in them
  std::vector<std::pair<std::string, Table>> tables;  // by the names that schema.ts lists; none is empty
  std::vector<std::string> notices = {};              // what it lacks, a sentence each, for the page's reader
};

// The tables of a study of images, and of one of discrepancies. `filters`: see filter_table(); may be empty.
std::vector<std::pair<std::string, Table>> page_tables(const Table& rows, const Summary& summary, const Table& filters);
std::vector<std::pair<std::string, Table>> page_tables(const DiscrepancySummary& summary);

// The runs at `path`: a results.jsonl, bench.jsonl or stress.jsonl (by its schema, not by its name), or a folder with
// one or more of the three. What summaries have is computed again. A run that was stopped has what is there, and a
// notice. Throws Error for a path that is none of these, and for files with other contents, naming the place.
std::vector<PageRun> read_runs(const std::string& path);

}  // namespace moire
