// The table of filters and their metrics.
#include "reports/filter_table.h"

#include <fmt/format.h>

#include <cmath>

#include "reports/text_table.h"

namespace moire {
namespace {

// A column: its head, the row's cell, how it is written.
struct Column {
  const char *head, *cell, *format, *meaning;
};
constexpr Column kColumns[] = {
    {"R px", "radius", "{:.4g}", "radius of the support"},
    {"I", "integral", "{:.4f}",
     "integral of the kernel as its source defines it (radial filters: over the plane); the rest is for the kernel "
     "divided by I"},
    {"ripple", "ripple", "{:.3g}",
     "largest |sum of the weights - 1| over a flat field, along one axis (radial filters: in the plane); 0 (below "
     "1e-14): partition of unity"},
    {"var px^2", "variance", "{:.4f}", "second moment about the mean, along any axis: blur"},
    {"H(1/2)", "nyquist_response", "{:.3f}", "frequency response at Nyquist, along an axis"},
    {"L1", "l1_gain", "{:.3f}",
     "integral of |k| along one axis (radial filters: over the plane); 1: no negative lobes"},
    {"over %", "overshoot_percent", "{:.2f}", "overshoot of a step"},
    {"S", "smoothing", "{:.3f}",
     "smoothing: what |H|^2 lacks inside the Nyquist square (Marschner and Lobb 1994, in 2-D)"},
    {"P", "postaliasing", "{:.4f}", "postaliasing: integral of |H|^2 outside the Nyquist square (the same)"},
    {"E", "noise_gain_1d", "{:.3f}",
     "noise gain: integral of k^2 along one axis (radial filters: the root of that over the plane); N independent "
     "samples per pixel, scattered without regard to pixels, leave a flat field the variance E^2 / N"},
    {"edge px", "edge_alias_energy", "{:.3g}", "alias energy of an edge: what it keeps above Nyquist"},
    {"aniso", "anisotropy", "{:.4f}",
     "anisotropy: largest less smallest |H| over the directions at Nyquist; 0 for radial filters"},
};

// Rounding alone makes partitions of unity ripple by some 1e-16.
constexpr double kRounding = 1e-14;

std::string number_text(const Row& row, const Column& column) {
  const double value = row.number(column.cell);
  if (!std::isfinite(value)) return "-";
  if (std::string_view(column.cell) == "ripple" && value < kRounding) return "0";
  const std::string text = fmt::format(fmt::runtime(column.format), value);
  // -0.000 is a number that rounds to zero, not a sign.
  return text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos ? text.substr(1) : text;
}

}  // namespace

std::vector<std::vector<std::string>> filter_cells(const Table& filters) {
  std::vector<std::vector<std::string>> lines(1, {"filter"});
  for (const Column& column : kColumns) lines[0].emplace_back(column.head);
  for (const Row& row : filters) {
    lines.push_back({std::string(row.text("filter"))});
    for (const Column& column : kColumns) lines.back().push_back(number_text(row, column));
  }
  return lines;
}

std::vector<ColumnMeaning> filter_columns() {
  std::vector<ColumnMeaning> meanings;
  for (const Column& column : kColumns) meanings.push_back({column.head, column.meaning});
  return meanings;
}

std::string filter_text(const Table& filters) {
  if (filters.empty()) return {};
  TextLines lines;
  for (const auto& cells : filter_cells(filters)) {
    lines.emplace_back();
    for (const std::string& cell : cells) lines.back().push_back({cell, std::nan("")});
  }
  std::string text = text_table(lines, false) + "\n";
  for (const ColumnMeaning& column : filter_columns()) {
    text += fmt::format("  {:<9} {}\n", column.head, column.meaning);
  }
  return text;
}

}  // namespace moire
