// moire report: the page of runs that are there, and its charts as files.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/browser.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/page.h"
#include "reports/file.h"
#include "reports/json.h"

namespace moire {
namespace {

namespace fs = std::filesystem;

// A folder of its own among the system's temporary ones, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "moire-figures-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw Error(name, "cannot be made a folder", Exit::io);
    path_ = std::move(name);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(std::string_view name) const { return path_ + "/" + std::string(name); }

 private:
  std::string path_;
};

// Where the figures stand in the document: a JSON array of {name, svg}, the page's last element.
std::string_view figures_in(std::string_view document) {
  constexpr std::string_view kBegin = "id=\"moire-figures\">", kEnd = "</script>";
  const std::size_t begin = document.rfind(kBegin);
  const std::size_t end = begin == std::string_view::npos ? begin : document.find(kEnd, begin);
  if (end == std::string_view::npos) throw Error("--figures", "the browser did not draw the page", Exit::io);
  return document.substr(begin + kBegin.size(), end - begin - kBegin.size());
}

// Names become files of the folder and of no other.
bool is_file_name(std::string_view name) {
  return !name.empty() && name[0] != '.' && name.size() < 200 &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789._=-") == std::string_view::npos;
}

void write_figures(const std::string& page, const std::string& folder) {
  const TemporaryFolder temporary;
  write_whole(temporary.file("page.html"), page);
  watch_interrupts();
  const std::string document =
      rendered_document(temporary.file("page.html"), "figures=1", temporary.file("profile"), interrupted);
  const Table figures = parse_json_rows(figures_in(document), "the page's figures");
  make_folder(folder);
  for (const Row& figure : figures) {
    const std::string name(figure.text("name"));
    if (!is_file_name(name)) throw Error("the page's figures", "\"" + name + "\" is no name of a file", Exit::io);
    const std::string path = folder + "/" + name + ".svg";
    write_whole(path, figure.text("svg"));
    print("figure: " + path + "\n");
  }
}

}  // namespace

Exit execute(const ReportOptions& options) {
  const bool writes_page = options.figures.empty() || !options.out.empty();
  if (!options.out.empty()) check_page_path(options.out);
  std::vector<PageRun> runs;
  for (const std::string& path : options.runs) {
    for (PageRun& run : read_runs(path)) runs.push_back(std::move(run));
  }
  const std::string out = options.out.empty() ? runs.front().folder + "/index.html" : options.out;
  if (writes_page && options.out.empty()) check_page_path(out);
  const std::string page = page_of(runs, out, options.budget);
  if (!options.figures.empty()) write_figures(page, options.figures);
  if (writes_page) {
    write_whole(out, page);
    print("report: " + out + "\n");
  }
  return Exit::ok;
}

}  // namespace moire
