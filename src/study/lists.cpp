// Lists in study files.
#include "study/lists.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace moire {

const std::vector<Node>& list_of(const Node& node, std::string_view what, std::string_view example) {
  if (node.kind != Node::Kind::list || node.items.empty()) {
    throw Error(node.place,
                fmt::format("{} is {}; give a list such as {}", what,
                            node.kind == Node::Kind::list ? "an empty list" : kind_name(node.kind), example));
  }
  if (node.items.size() > kMaxListed) {
    throw Error(node.place, fmt::format("{} has {} entries; give at most {}", what, node.items.size(), kMaxListed));
  }
  return node.items;
}

void refuse_twice(const Node& node, std::string_view what, bool inserted) {
  if (!inserted) throw Error(node.place, fmt::format("{} is listed twice; name each one once", what));
}

std::vector<int> integers_of(const Node& node, std::string_view what, std::string_view example, std::string_view entry,
                             int min, int max) {
  std::vector<int> numbers;
  for (const Node& item : list_of(node, what, example)) {
    const int n = static_cast<int>(integer_of(item, entry, min, max));
    refuse_twice(item, std::to_string(n), std::find(numbers.begin(), numbers.end(), n) == numbers.end());
    numbers.push_back(n);
  }
  return numbers;
}

}  // namespace moire
