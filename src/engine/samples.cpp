// Where the samples of an image come from.
#include "engine/samples.h"

#include <array>
#include <cassert>
#include <string>

#include "core/error.h"
#include "core/names.h"

namespace moire {
namespace {

constexpr auto kLayoutNames = std::to_array<std::string_view>({"pixel", "image"});

}  // namespace

std::span<const std::string_view> layout_names() { return kLayoutNames; }

std::string_view name_of(Layout layout) { return kLayoutNames[static_cast<std::size_t>(layout)]; }

Layout find_layout(std::string_view name, std::string_view place) {
  for (std::size_t i = 0; i < kLayoutNames.size(); ++i) {
    if (kLayoutNames[i] == name) return static_cast<Layout>(i);
  }
  throw Error(std::string(place), unknown_name("layout", name, kLayoutNames));
}

bool Samples::same_in_all_pixels() const noexcept { return pattern() != nullptr && !pattern()->varies(); }

double Samples::density() const noexcept {
  if (const auto* pattern = std::get_if<const Pattern*>(&source_)) return (*pattern)->n();
  return std::get<const AreaPoints*>(source_)->density();
}

std::int64_t Samples::total(Grid grid, int apron) const noexcept {
  if (const auto* pattern = std::get_if<const Pattern*>(&source_)) {
    return (*pattern)->n() * (grid.width + 2 * std::int64_t{apron}) * (grid.height + 2 * std::int64_t{apron});
  }
  const AreaPoints& points = *std::get<const AreaPoints*>(source_);
  assert(points.fits(grid, apron));
  return points.count();
}

std::int64_t Samples::count(int x0, int x1, int y) const noexcept {
  if (const auto* pattern = std::get_if<const Pattern*>(&source_)) return std::int64_t{(*pattern)->n()} * (x1 - x0);
  const auto row = std::get<const AreaPoints*>(source_)->points(x0, x1, y);
  return static_cast<std::int64_t>(row.first.back() - row.first.front());
}

bool Samples::has_time() const noexcept {
  if (const auto* pattern = std::get_if<const Pattern*>(&source_)) return (*pattern)->has_time();
  return std::get<const AreaPoints*>(source_)->has_time();
}

void Samples::get(int x0, int x1, int y, RowSamples& out, bool with_time) const {
  assert(!with_time || has_time());
  out.first.assign(1, 0);
  out.t.clear();
  out.pixels.clear();
  if (const auto* pattern = std::get_if<const Pattern*>(&source_)) {
    const auto n = static_cast<std::size_t>((*pattern)->n());
    for (int x = x0; x < x1; ++x) {
      out.pixels.push_back({x, y});
      out.first.push_back(out.first.back() + n);
    }
    out.x.resize(out.first.back());
    out.y.resize(out.first.back());
    if (with_time) out.t.resize(out.first.back());
    (*pattern)->fill(out.pixels, {out.x, out.y, out.t});
    return;
  }
  const auto row = std::get<const AreaPoints*>(source_)->points(x0, x1, y);
  const auto begin = static_cast<std::ptrdiff_t>(row.first.front()),
             end = static_cast<std::ptrdiff_t>(row.first.back());
  out.x.assign(row.x.begin() + begin, row.x.begin() + end);
  out.y.assign(row.y.begin() + begin, row.y.begin() + end);
  if (with_time) out.t.assign(row.t.begin() + begin, row.t.begin() + end);
  for (int x = x0; x < x1; ++x) {
    const auto i = static_cast<std::size_t>(x - x0);
    out.first.push_back(row.first[i + 1] - row.first.front());
    out.pixels.insert(out.pixels.end(), row.first[i + 1] - row.first[i], Pixel{x, y});
  }
}

}  // namespace moire
