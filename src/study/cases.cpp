// Rows of results by their key.
#include "study/cases.h"

#include <algorithm>

#include "study/columns.h"
#include "study/scene_file.h"

namespace moire {
namespace {

template <class T>
void add_new(std::vector<T>& list, const T& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

}  // namespace

std::string Reconstruction::label() const {
  return estimator.empty() || estimator == "ratio" ? filter : filter + ", " + estimator;
}

Cases::Cases(const Table& rows) {
  for (const Row& row : rows) {
    const std::string scene(scene_family(row.text("scene"))), pattern(sampler_of(row));
    const Reconstruction kernel{std::string(row.text("filter")), std::string(row.text("estimator"))};
    const Cell* cell = row.find("spp");
    const auto* count = cell == nullptr ? nullptr : std::get_if<std::int64_t>(cell);
    const std::int64_t spp = count == nullptr ? 0 : *count;
    auto& same_key = rows_[{scene, pattern, kernel, spp}];
    if (same_key.empty()) {
      add_new(scenes_, scene);
      add_new(patterns_, pattern);
      add_new(kernels_, kernel);
      add_new(spp_, spp);
    }
    same_key.push_back(&row);
  }
  std::sort(spp_.begin(), spp_.end());
}

const std::vector<const Row*>& Cases::at(const std::string& scene, const std::string& pattern,
                                         const Reconstruction& kernel, std::int64_t spp) const {
  const auto found = rows_.find({scene, pattern, kernel, spp});
  return found == rows_.end() ? none_ : found->second;
}

const Row* Cases::first(const std::string& scene, const std::string& pattern, const Reconstruction& kernel,
                        std::int64_t spp) const {
  const auto& rows = at(scene, pattern, kernel, spp);
  return rows.empty() ? nullptr : rows.front();
}

}  // namespace moire
