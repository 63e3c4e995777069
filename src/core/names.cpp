// Nearest names by optimal string alignment distance (Damerau 1964, Levenshtein 1966, restricted form).
#include "core/names.h"

#include <algorithm>
#include <vector>

namespace moire {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<std::size_t> before(n + 1), above(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= n; ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[n];
}

std::string join(std::span<const std::string_view> names) {
  std::string out;
  for (const std::string_view name : names) {
    if (!out.empty()) out += ", ";
    out += name;
  }
  return out;
}

std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> known) {
  // Echo at most this much of what was given: it may be a whole file.
  constexpr std::size_t kShown = 60;
  const std::string shown = name.size() <= kShown ? std::string(name) : std::string(name.substr(0, kShown)) + "...";
  std::vector<std::pair<std::size_t, std::string_view>> near;
  for (const std::string_view k : known) {
    const std::size_t d = edit_distance(name.substr(0, kShown), k);
    // A third of the letters wrong is a slip; more is another word. A prefix is a name cut short.
    if (d * 3 <= std::max(name.size(), k.size()) || (name.size() >= 3 && k.starts_with(name))) near.emplace_back(d, k);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string out = std::string(kind) + " \"" + shown + "\" is not known; ";
  if (!near.empty()) {
    out += "did you mean ";
    for (std::size_t i = 0; i < std::min<std::size_t>(near.size(), 3); ++i) {
      if (i > 0) out += " or ";
      out += near[i].second;
    }
    out += "? (all: " + join(known) + ")";
  } else {
    out += "choose from " + join(known);
  }
  return out;
}

}  // namespace moire
