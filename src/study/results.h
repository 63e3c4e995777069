// The results table: rows of named cells. Sinks write it, summaries read it; nobody computes here.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace moire {

// An empty cell (monostate) is a missing value: null in JSON, nothing in CSV.
using Cell = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

// The number, or an empty cell for one that is not finite.
Cell finite_cell(double value);

// One row: cells in the order in which they were first set. Names carry their unit: time_render_ns.
class Row {
 public:
  void set(std::string_view name, Cell value);
  const Cell* find(std::string_view name) const;       // null when there is no such cell
  double number(std::string_view name) const;          // NaN when missing or not a number
  std::string_view text(std::string_view name) const;  // "" when missing or not text
  bool flag(std::string_view name) const;              // false when missing or not a truth value
  const std::vector<std::pair<std::string, Cell>>& cells() const { return cells_; }

 private:
  std::vector<std::pair<std::string, Cell>> cells_;
};

using Table = std::vector<Row>;

}  // namespace moire
