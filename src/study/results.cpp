// Rows of named cells.
#include "study/results.h"

#include <cmath>

#include <limits>

namespace moire {

Cell finite_cell(double value) { return std::isfinite(value) ? Cell(value) : Cell(); }

void Row::set(std::string_view name, Cell value) {
  for (auto& [known, cell] : cells_) {
    if (known == name) {
      cell = std::move(value);
      return;
    }
  }
  cells_.emplace_back(std::string(name), std::move(value));
}

const Cell* Row::find(std::string_view name) const {
  for (const auto& [known, cell] : cells_) {
    if (known == name) return &cell;
  }
  return nullptr;
}

double Row::number(std::string_view name) const {
  const Cell* cell = find(name);
  if (cell != nullptr) {
    if (const auto* d = std::get_if<double>(cell)) return *d;
    if (const auto* i = std::get_if<std::int64_t>(cell)) return static_cast<double>(*i);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string_view Row::text(std::string_view name) const {
  const Cell* cell = find(name);
  const auto* text = cell == nullptr ? nullptr : std::get_if<std::string>(cell);
  return text == nullptr ? std::string_view() : *text;
}

bool Row::flag(std::string_view name) const {
  const Cell* cell = find(name);
  const bool* value = cell == nullptr ? nullptr : std::get_if<bool>(cell);
  return value != nullptr && *value;
}

}  // namespace moire
