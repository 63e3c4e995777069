// Writing the report page of runs.
#include "app/page.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/output.h"
#include "core/error.h"
#include "reports/file.h"
#include "reports/html.h"
#include "reports/page_data.h"
#include "reports/page_rows.h"

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

void check_page_path(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code none;  // what cannot be asked about is not there; making a file will say what is wrong
  if (fs::is_directory(path, none)) throw Error(path, "cannot be written: it is a folder", Exit::io);
  if (fs::exists(path, none) && !fs::is_regular_file(path, none)) return;  // /dev/stdout, a pipe
  const fs::path target = fs::is_symlink(path, none) ? fs::weakly_canonical(path, none) : fs::path(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::string name = (folder / ".moire-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file < 0) {
    throw Error(path, "cannot be written: folder " + folder.string() + ": " + std::strerror(errno), Exit::io);
  }
  ::close(file);
  ::unlink(name.c_str());
}

void write_run_page(PageRun run) {
  const std::string path = run.folder + "/index.html";
  if (!why_no_page().empty()) return say(path, "is left out: " + std::string(why_no_page()));
  try {
    check_names(run.rows, run.folder + "/results.jsonl");
  } catch (const Error& e) {
    return say(path, std::string("is left out: ") + e.what());
  }
  std::vector<PageRun> runs;
  runs.push_back(std::move(run));
  write_whole(path, page_of(runs, path, kDefaultBudget));
  print("report: " + path + "\n");
}

std::string write_folder_page(const std::string& folder) {
  const std::string path = folder + "/index.html";
  std::vector<PageRun> runs;
  try {
    if (!why_no_page().empty()) throw Error("", std::string(why_no_page()));
    runs = read_runs(folder);
  } catch (const Error& e) {
    say(path, std::string("is left out: ") + e.what());
    return {};
  }
  write_whole(path, page_of(runs, path, kDefaultBudget));
  return path;
}

}  // namespace moire
