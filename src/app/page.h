// Writing the report page of runs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/page_run.h"

namespace moire {

// The page of the runs as it would stand at `path`, of at most `budget` bytes if the tables leave room for images; says
// on standard error what is missing in it. Throws Error (Exit::usage) when the program was built without the page.
std::string page_of(const std::vector<PageRun>& runs, const std::string& path, std::size_t budget);

// Before long work: throws Error (Exit::io) when no file can be made at `path`, as far as that shows without making it.
void check_page_path(const std::string& path);

// For a run that ends: writes index.html into the run's folder, prints where it is, or says in one line that it is left
// out and why. Throws Error (Exit::io).
void write_run_page(PageRun run);

// The same of all results in the folder, without printing: the path of the page, "" when it is left out.
std::string write_folder_page(const std::string& folder);

}  // namespace moire
