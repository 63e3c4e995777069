// What an earlier run left in a folder, put beside the plan of the study that is to go on there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "reports/json.h"
#include "study/results.h"

namespace moire {

// The rows that a study will have: a key for each, and the key of a row that is there.
struct PlannedRows {
  std::uint64_t seed = 1;
  std::vector<std::string> keys;
  std::function<std::string(const Row&)> key_of;
};

struct Earlier {
  ResultsFile file;      // its rows are moved to `rows`; no header: nothing is there, the run starts afresh
  Table rows;            // one per planned row, without cells where there is none
  std::size_t kept = 0;  // rows that are there
};

// Reads `path`, which `header` would begin if the study ran now. Throws Error for results of another study, seed,
// schema or build, for damage before the last line, and for rows that are not of the plan or there twice, with the
// line. No file is changed.
Earlier find_earlier(const std::string& path, const std::string& header, const PlannedRows& planned);

}  // namespace moire
