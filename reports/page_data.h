// What a report page shows, as JSON: moire.report/1, whose fields reports/web/src/schema.ts explains.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "reports/page_run.h"

namespace moire {

struct PageData {
  std::string title;  // the names of the runs
  std::string json;
  std::vector<std::string> notices;  // what is missing in the page and why, for a person; one line each
};

// The JSON has no '<' (script_safe() in page_json.h). The same runs give the same bytes, apart from what comes of their
// times. `page_folder` is where the page will stand: links lead from there to the runs' folders. `budget`, in bytes, is
// for everything together: tables, filters and points are always there, then come radial spectra (a quarter of a run's
// share at most) and images by rank; what is left out is listed in the page. Files that are missing or cannot be read,
// runs that are not complete, and tables above the budget are told in `notices` and in the page.
inline constexpr std::size_t kDefaultBudget = 10'000'000;
PageData page_data(std::span<const PageRun> runs, const std::string& page_folder, std::size_t budget);

}  // namespace moire
