// Rows of results by their key, for tables: the axes of a study as its rows show them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "study/results.h"

namespace moire {

// How samples became pixels: a column of a report.
struct Reconstruction {
  std::string filter, estimator;
  std::string label() const;  // the filter; "filter, estimator" for others than `ratio`
  friend auto operator<=>(const Reconstruction&, const Reconstruction&) = default;
};

// Keeps pointers into the table, which must outlive it. The axes are in the order of first appearance, spp rising. A
// family of random lines is one scene, as it is in a summary; its raw rows are those of all its lines.
class Cases {
 public:
  explicit Cases(const Table& rows);

  const std::vector<std::string>& scenes() const { return scenes_; }
  const std::vector<std::string>& patterns() const { return patterns_; }
  const std::vector<Reconstruction>& kernels() const { return kernels_; }
  const std::vector<std::int64_t>& spp() const { return spp_; }

  // The rows of a key: one in a summary, one per trial (and line) in raw rows, none where there is no such case. Rows
  // without an spp column (slopes) have spp 0.
  const std::vector<const Row*>& at(const std::string& scene, const std::string& pattern, const Reconstruction& kernel,
                                    std::int64_t spp = 0) const;
  // The first of them, or null.
  const Row* first(const std::string& scene, const std::string& pattern, const Reconstruction& kernel,
                   std::int64_t spp = 0) const;

 private:
  std::vector<std::string> scenes_, patterns_;
  std::vector<Reconstruction> kernels_;
  std::vector<std::int64_t> spp_;
  std::map<std::tuple<std::string, std::string, Reconstruction, std::int64_t>, std::vector<const Row*>> rows_;
  std::vector<const Row*> none_;
};

}  // namespace moire
