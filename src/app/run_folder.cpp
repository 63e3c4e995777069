// The folder of a run's results.
#include "app/run_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "app/output.h"
#include "core/error.h"
#include "reports/file.h"

namespace moire {

namespace {

// What write_whole() left of files as a run was killed; another study would not write them again. Only the program's
// own kinds of files: the folder may hold others.
void remove_parts(const std::string& folder) {
  std::error_code ignored;
  for (std::filesystem::directory_iterator it(folder, ignored), end; it != end; it.increment(ignored)) {
    const std::string name = it->path().filename().string();
    for (const std::string_view ending :
         {".exr.part", ".png.part", ".csv.part", ".md.part", ".html.part", ".jsonl.part"}) {
      if (name.ends_with(ending) && it->is_regular_file(ignored)) std::filesystem::remove(it->path(), ignored);
    }
  }
}

}  // namespace

RunFolder::RunFolder(const RunOptions& options, const StudyText& study, const PlannedRows& planned,
                     std::span<const std::string_view> reports, bool images)
    : study_(options.study),
      folder_(options.folder),
      results_file_(options.folder + "/results.jsonl"),
      planned_(planned.keys.size()) {
  make_folder(folder_);
  lock_.emplace(folder_);
  if (images) make_folder(folder_ + "/images");
  remove_parts(folder_);
  remove_parts(folder_ + "/images");
  header_ = json_header(tool(), host(), study);
  if (options.resume) {
    earlier_ = find_earlier(results_file_, header_, planned);
    if (!earlier_.file.cut.empty()) {
      say(results_file_,
          fmt::format("the last line was cut after {} bytes, and is left out", earlier_.file.cut.size()));
    }
  }
  goes_on_ = !earlier_.file.header.empty();
  const bool replaces = !options.resume && std::filesystem::is_regular_file(results_file_);
  if (goes_on_) {
    header_ = earlier_.file.header;  // the machine may be of another kind
    results_.emplace(results_file_, earlier_.file);
  } else {
    results_.emplace(results_file_, header_);
    for (const std::string_view name : reports) {
      std::error_code ignored;  // a file that cannot be removed cannot be written either, which is told then
      std::filesystem::remove(file(name), ignored);
    }
  }
  if (replaces) say(results_file_, "earlier results are replaced; --resume would have gone on with them");
}

void RunFolder::finish(const Table& rows, bool complete) {
  results_->finish(rows);
  if (complete) return;
  throw Error(results_file_,
              fmt::format("interrupted; the {} of {} rows that were finished are kept here; this goes on: moire run {} "
                          "-o {} --resume",
                          rows.size(), planned_, study_, folder_),
              Exit::interrupted);
}

}  // namespace moire
