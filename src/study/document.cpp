// TOML by toml++ (M. Gillard); the only file that knows it.
#include "study/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"

namespace moire {
namespace {

std::string place_of(const toml::source_position& at, std::string_view file) {
  return fmt::format("{}:{}:{}", file, at.line, at.column);
}

Node copy(const toml::node& from, std::string_view file);

// toml++ sorts a table by name; the text's order is that of the names' positions.
void copy_members(const toml::table& from, std::string_view file, Node& to) {
  std::vector<std::pair<toml::source_position, Node>> members;
  for (const auto& [key, value] : from) {
    Node member = copy(value, file);
    member.key = std::string(key.str());
    member.key_place = place_of(key.source().begin, file);
    members.emplace_back(key.source().begin, std::move(member));
  }
  std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [position, member] : members) to.items.push_back(std::move(member));
}

Node copy(const toml::node& from, std::string_view file) {
  Node to;
  to.place = place_of(from.source().begin, file);
  if (const auto* text = from.as_string()) {
    to.kind = Node::Kind::text;
    to.text = text->get();
  } else if (const auto* integer = from.as_integer()) {
    to.kind = Node::Kind::integer;
    to.integer = integer->get();
  } else if (const auto* number = from.as_floating_point()) {
    to.kind = Node::Kind::number;
    to.number = number->get();
  } else if (const auto* list = from.as_array()) {
    to.kind = Node::Kind::list;
    for (const toml::node& item : *list) to.items.push_back(copy(item, file));
  } else if (const auto* table = from.as_table()) {
    to.kind = Node::Kind::table;
    copy_members(*table, file, to);
  } else {
    to.kind = from.is_boolean() ? Node::Kind::boolean : Node::Kind::date;
  }
  return to;
}

}  // namespace

const Node* Node::find(std::string_view name) const {
  const auto it = std::find_if(items.begin(), items.end(), [&](const Node& n) { return n.key == name; });
  return it == items.end() ? nullptr : &*it;
}

std::string_view kind_name(Node::Kind kind) {
  switch (kind) {
    case Node::Kind::text:
      return "a text";
    case Node::Kind::integer:
      return "a whole number";
    case Node::Kind::number:
      return "a number";
    case Node::Kind::boolean:
      return "true or false";
    case Node::Kind::date:
      return "a date or time";
    case Node::Kind::list:
      return "a list";
    case Node::Kind::table:
      return "a table";
  }
  return "a value";
}

namespace {

// toml++, its destructors and copy() above follow tables within tables by recursion: a text nested many thousand levels
// deep would end the stack. Nothing here needs more than a handful. Dots are counted between characters that no key
// holds, brackets as they open; what stands in strings and comments does not count.
class Nesting {
 public:
  Nesting(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  void check() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        if (!skip_string(c)) return;  // never closed, which toml++ refuses where it begins
        continue;
      }
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      count(c);
      ++at_;
    }
  }

 private:
  static constexpr int kMaxDots = 64, kMaxBrackets = 16;

  void count(char c) {
    if (c == '.') {
      if (++dots_ > kMaxDots) refuse("a key of more than {} dotted parts; no key here needs more than three", kMaxDots);
      return;
    }
    const bool opens = c == '[' || c == '{', closes = c == ']' || c == '}';
    if (opens && ++brackets_ > kMaxBrackets) {
      refuse("lists and tables are nested more than {} deep; nothing here needs more than three", kMaxBrackets);
    }
    if (closes && brackets_ > 0) --brackets_;
    if (opens || closes || c == '=' || c == ',' || c == '\n') dots_ = 0;
  }

  // From an opening quote to behind the closing one; false when there is none. Basic strings have escapes, literal ones
  // have not; three quotes make a string of several lines, which may end in up to two quotes of its own.
  bool skip_string(char quote) {
    const std::string three(3, quote);
    const bool multi = text_.substr(at_).starts_with(three);
    at_ += multi ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\\' && quote == '"') {
        ++at_;
      } else if (c == '\n' && !multi) {
        return false;
      } else if (c == quote && (!multi || text_.substr(at_).starts_with(three))) {
        at_ += multi ? 3 : 1;
        for (int more = 0; multi && more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) ++at_;
        return true;
      }
    }
    return false;
  }

  [[noreturn]] void refuse(const char* what, int most) const {
    const std::string_view before = text_.substr(0, at_);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0: the first line
    throw Error(fmt::format("{}:{}:{}", file_, line, column), fmt::format(fmt::runtime(what), most));
  }

  std::string_view text_, file_;
  std::size_t at_ = 0;
  int dots_ = 0, brackets_ = 0;
};

}  // namespace

Node parse_toml(std::string_view text, std::string_view file) {
  Nesting(text, file).check();
  try {
    return copy(toml::parse(text), file);
  } catch (const toml::parse_error& e) {
    throw Error(place_of(e.source().begin, file), fmt::format("this is not TOML: {}", e.description()));
  }
}

double exact_number(const Node& node) {
  if (node.kind == Node::Kind::number) {
    if (std::isfinite(node.number)) return node.number;
    throw Error(node.place, "the number is not finite; give a finite number");
  }
  if (node.kind != Node::Kind::integer) {
    throw Error(node.place,
                fmt::format("{} stands where a number belongs; give a finite number", kind_name(node.kind)));
  }
  const double number = static_cast<double>(node.integer);
  // 2^63 itself is out of the range of int64, so that the way back is defined below it only.
  if (number < 0x1p63 && static_cast<std::int64_t>(number) == node.integer) return number;
  throw Error(node.place, fmt::format("no double is exactly {}; write a number that a double holds, or with a decimal "
                                      "point to have it rounded",
                                      node.integer));
}

const std::string& text_of(const Node& node, std::string_view what) {
  if (node.kind == Node::Kind::text) return node.text;
  throw Error(node.place, fmt::format("{} is {}; give a text in quotes", what, kind_name(node.kind)));
}

const std::string& name_of(const Node& node, std::string_view what) {
  const std::string& name = text_of(node, what);
  const bool bad =
      std::any_of(name.begin(), name.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f' || c == '`'; });
  if (bad) {
    throw Error(node.place,
                fmt::format("\"{}\" must be a name without line breaks, control characters or backquotes", what));
  }
  return name;
}

std::int64_t integer_of(const Node& node, std::string_view what, std::int64_t min, std::int64_t max) {
  if (node.kind != Node::Kind::integer) {
    throw Error(node.place,
                fmt::format("{} is {}; give a whole number from {} to {}", what, kind_name(node.kind), min, max));
  }
  if (node.integer < min || node.integer > max) {
    throw Error(node.place, fmt::format("{} is {}; it must be {} to {}", what, node.integer, min, max));
  }
  return node.integer;
}

}  // namespace moire
