// What an earlier run left in a folder, put beside the plan of the study that is to go on there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/json.h"
#include "study/study.h"

namespace moire {

struct Earlier {
  ResultsFile file;      // its rows are moved to `rows`; no header: nothing is there, the run starts afresh
  Table rows;            // one per case of the plan, without cells where there is none
  std::size_t kept = 0;  // rows that are there
};

// Reads `path`, which `header` would begin if the study ran now. Throws Error for results of another study, seed,
// schema or build, for damage before the last line, and for rows that are not of the plan or there twice, with the
// line. No file is changed.
Earlier find_earlier(const std::string& path, const std::string& header, const Study& study,
                     const std::vector<Case>& cases);

}  // namespace moire
