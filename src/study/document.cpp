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

// toml++ follows a dotted key by recursion: a key of many thousand parts would end the stack. Nothing here needs more
// than a handful. Dots are counted between characters that no key holds, quoted strings left out.
void refuse_deep_keys(std::string_view text, std::string_view file) {
  constexpr int kMaxDots = 64;
  std::size_t line = 1, line_begin = 0;
  int dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      ++line;
      line_begin = i + 1;
      dots = 0;
    } else if (c == '"' || c == '\'') {
      // To the closing quote on this line; a multi-line string ends its line, which resets the count.
      const std::size_t end = text.find_first_of(c == '"' ? "\"\n" : "'\n", i + 1);
      if (end == std::string_view::npos) return;
      i = text[end] == '\n' ? end - 1 : end;
    } else if (c == '.') {
      if (++dots > kMaxDots) {
        throw Error(fmt::format("{}:{}:{}", file, line, i - line_begin + 1),
                    fmt::format("a key of more than {} dotted parts; no key here needs more than three", kMaxDots));
      }
    } else if (c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}') {
      dots = 0;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    }
  }
}

}  // namespace

Node parse_toml(std::string_view text, std::string_view file) {
  refuse_deep_keys(text, file);
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
