// Lists in study files: not empty, not endless, and nothing twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "study/document.h"

namespace moire {

// Entries of a list: each one is compared with all others, and makes a pattern, a filter or a block of cases.
inline constexpr std::size_t kMaxListed = 4096;

// The members of a list that must have some, at most kMaxListed; `what` names it and `example` shows one in the
// message. Throws Error.
const std::vector<Node>& list_of(const Node& node, std::string_view what, std::string_view example);

// Throws Error unless `inserted`.
void refuse_twice(const Node& node, std::string_view what, bool inserted);

// Different whole numbers within [min, max]; `entry` is what one of them is called. Throws Error.
std::vector<int> integers_of(const Node& node, std::string_view what, std::string_view example, std::string_view entry,
                             int min, int max);

// A list of specs: `make(text, place)` turns each into a choice; the texts must differ. Throws Error.
template <class T, class F>
std::vector<T> specs_of(const Node& node, std::string_view what, std::string_view example, F&& make) {
  std::vector<T> choices;
  std::unordered_set<std::string> seen;
  for (const Node& item : list_of(node, what, example)) {
    const std::string& text = text_of(item, "an entry of " + std::string(what));
    refuse_twice(item, "\"" + text + "\"", seen.insert(text).second);
    choices.push_back(make(text, item.place));
  }
  return choices;
}

}  // namespace moire
