// A TOML text as plain values that know where they stand, so that every later message can name file:line:column.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace moire {

// One value. Tables keep the order of the text; a list or a table holds its members in `items`.
struct Node {
  enum class Kind : std::uint8_t { text, integer, number, boolean, date, list, table };
  Kind kind = Kind::table;
  std::string key;        // name within its table; "" in lists and at the root
  std::string key_place;  // where that name stands
  std::string place;      // where the value stands
  std::string text;
  std::int64_t integer = 0;
  double number = 0;  // integers too, when a double holds them exactly (see exact_number)
  std::vector<Node> items;

  // The member of a table, null when there is none.
  const Node* find(std::string_view name) const;
};

// "a text", "a whole number", ...: for messages.
std::string_view kind_name(Node::Kind kind);

// Reads TOML 1.0. `file` is what messages call the text. Throws Error with file:line:column, also for keys of more than
// 64 parts and values more than 16 lists or tables deep.
Node parse_toml(std::string_view text, std::string_view file);

// The value as a finite double. Throws Error for anything else, also for integers that no double holds exactly.
double exact_number(const Node& node);

// The value as text, or as a whole number within [min, max]; `what` names it in the message. Throws Error.
const std::string& text_of(const Node& node, std::string_view what);
std::int64_t integer_of(const Node& node, std::string_view what, std::int64_t min, std::int64_t max);

// The text of a name, which goes into tables, reports and file names: without control characters and backquotes.
const std::string& name_of(const Node& node, std::string_view what);

}  // namespace moire
