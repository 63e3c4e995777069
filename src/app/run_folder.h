// The folder of a run's results: taken by this process alone, with what an earlier run left in it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/commands.h"
#include "app/folder_lock.h"
#include "app/resume.h"
#include "reports/json.h"
#include "reports/provenance.h"

namespace moire {

class RunFolder {
 public:
  // Makes and locks the folder, reads what is to go on, begins results.jsonl, and removes `reports`, names of files
  // that a new run will not write at once and that must not stand beside its results as if they were theirs. Whatever
  // is wrong with the folder shows here, before the work begins. Throws Error.
  RunFolder(const RunOptions& options, const StudyText& study, const PlannedRows& planned,
            std::span<const std::string_view> reports, bool images);

  const std::string& path() const { return folder_; }
  // The line that begins results.jsonl.
  const std::string& header() const { return header_; }
  std::string file(std::string_view name) const { return folder_ + "/" + std::string(name); }
  // Whether an earlier run goes on.
  bool goes_on() const { return goes_on_; }
  // Its rows, one per row of the plan, without cells where there is none; to be taken once.
  Table take_rows() { return std::move(earlier_.rows); }
  void append(const Row& row) { results_->append(row); }
  // Writes the results whole. Throws Error (Exit::interrupted), saying how to go on, when they are not complete.
  void finish(const Table& rows, bool complete);

 private:
  std::string study_, folder_, results_file_, header_;
  std::size_t planned_;
  std::optional<FolderLock> lock_;
  Earlier earlier_;
  bool goes_on_ = false;
  std::optional<JsonLines> results_;
};

}  // namespace moire
