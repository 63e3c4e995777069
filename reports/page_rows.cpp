// What a page asks of the rows of a results file.
#include "reports/page_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>

#include "core/error.h"
#include "study/row_keys.h"

namespace moire {
namespace {

constexpr std::array<std::string_view, 4> kImageNames = {"scene", "pattern", "filter", "estimator"};
constexpr std::array<std::string_view, 2> kSetNames = {"pattern", "measure"};
// Columns by their beginnings that hold numbers alone: what is summarised, ranked and drawn.
constexpr std::string_view kNumbers[] = {"time_",       "rmse_",   "mse_",    "mae_",       "bias_",    "max_",
                                         "p50_",        "p90_",    "p95_",    "p99_",       "p995_",    "discrepancy",
                                         "n_pi",        "pixels_", "width",   "height",     "samples_", "seed",
                                         "error_bound", "peak_fx", "peak_fy", "noise_power"};

std::string place_of(const std::string& path, std::size_t row) { return fmt::format("{}:{}", path, row + 2); }

// An integer of at least `least`.
void check_count(const Row& row, std::string_view name, std::int64_t least, const std::string& place) {
  const Cell* cell = row.find(name);
  const auto* value = cell == nullptr ? nullptr : std::get_if<std::int64_t>(cell);
  if (value == nullptr || *value < least)
    throw Error(place, fmt::format("\"{}\" must be an integer from {} on", name, least));
}

bool holds_numbers(std::string_view name) {
  return std::any_of(std::begin(kNumbers), std::end(kNumbers), [&](std::string_view s) { return name.starts_with(s); });
}

enum class Kind : std::uint8_t { none, flag, number, text };

Kind kind_of(const Cell& cell) {
  constexpr Kind kKinds[] = {Kind::none, Kind::flag, Kind::number, Kind::number, Kind::text};
  return kKinds[cell.index()];
}

void check_key(const Row& row, bool of_sets, const std::string& place) {
  const auto check = [&](std::string_view name) {
    if (row.text(name).empty()) throw Error(place, fmt::format("\"{}\" must be a text; mend or remove the line", name));
  };
  if (of_sets) {
    std::for_each(kSetNames.begin(), kSetNames.end(), check);
    for (const std::string_view name : {"n", "dims"}) check_count(row, name, 1, place);
  } else {
    std::for_each(kImageNames.begin(), kImageNames.end(), check);
    check_count(row, "spp", 1, place);
  }
  check_count(row, "trial", 0, place);
}

}  // namespace

void check_rows(const Table& rows, const std::string& path) {
  const bool of_sets = !rows.empty() && is_set_row(rows.front());
  std::unordered_map<std::string, std::size_t> first;  // where a key stands
  std::unordered_map<std::string, Kind> kinds;         // of the columns so far
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string place = place_of(path, i);
    check_key(rows[i], of_sets, place);
    for (const auto& [name, cell] : rows[i].cells()) {
      const Kind kind = kind_of(cell);
      if (kind == Kind::none) continue;
      const Kind wanted = kinds.emplace(name, holds_numbers(name) ? Kind::number : kind).first->second;
      if (kind == wanted) continue;
      if (wanted == Kind::number) throw Error(place, fmt::format("\"{}\" must be a number or null", name));
      throw Error(place, fmt::format("\"{}\" is of another type than in the lines above", name));
    }
    std::string key = of_sets ? set_row_key(rows[i]) : image_row_key(rows[i]);
    const auto [at, is_new] = first.emplace(std::move(key), i);
    if (!is_new) {
      throw Error(place,
                  fmt::format("\"{}\" stands in line {} already; remove one of them", at->first, at->second + 2));
    }
  }
  check_names(rows, path);
}

void check_names(const Table& rows, const std::string& path) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::string_view name : {"scene", "pattern", "filter", "estimator", "measure"}) {
      if (rows[i].text(name).find('|') == std::string_view::npos) continue;
      throw Error(place_of(path, i), fmt::format("the {} \"{}\" has a '|', which a page cannot have in names; give it "
                                                 "another name",
                                                 name, rows[i].text(name)));
    }
  }
}

}  // namespace moire
