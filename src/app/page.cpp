// Writing the report page of runs.
#include "app/page.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/output.h"
#include "core/error.h"
#include "reports/file.h"
#include "reports/html.h"
#include "reports/page_data.h"

namespace moire {

std::string page_of(const std::vector<PageRun>& runs, const std::string& path, std::size_t budget) {
  if (!why_no_page().empty()) {
    throw Error("moire report",
                "there is no page: " + std::string(why_no_page()) + "; install nodejs and npm and build it again");
  }
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const PageData data = page_data(runs, folder, budget - std::min(budget, empty_page_bytes()));
  for (const std::string& notice : data.notices) say("page", notice);
  return html_page(data.title, data.json);
}

void write_run_page(PageRun run) {
  const std::string path = run.folder + "/index.html";
  if (!why_no_page().empty()) return say(path, "is left out: " + std::string(why_no_page()));
  std::vector<PageRun> runs;
  runs.push_back(std::move(run));
  write_whole(path, page_of(runs, path, kDefaultBudget));
  print("report: " + path + "\n");
}

}  // namespace moire
