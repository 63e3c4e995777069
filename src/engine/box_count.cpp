// Samples inside a scene, pixel by pixel; see box_count.h.
#include "engine/box_count.h"

#include <algorithm>
#include <cassert>

#include "engine/count_inside.h"

namespace moire {
namespace {

// Points generated and tested at a time, unless one pixel has more.
constexpr std::size_t kBatch = 1024;

// Cells grow by this much of a column before they are compared: well above what rounding does to positions (2^-52
// times up to 2^24 columns) and to points at the sides of their cells.
constexpr double kColumnGrowth = 0x1p-20;

// Blocks of cells are halved down to this many to a side: a look at a block costs as much as testing some 16 points.
constexpr int kBlock = 4;
// Samples a pixel from which halving pays, and how many it must save for one look: it is given up after one look for so
// many. Scenes that know strips have cheap tests, 1 to 2 ns a point, against some 50 ns for a look; without strips, as
// on a board, a test costs 2 to 13 ns and a look 10 to 30. With AVX-512, a board's pixels of 256 jittered points take
// 2.3 us by halving and 1.5 where all are tested, of 1024 4.0 and 5.9 (tests/bench/box_count.cpp).
struct Halving {
  int least, samples_a_look;
};
constexpr Halving kWithStrips{16384, 64}, kWithoutStrips{1024, 8};

// Calls of cover() that a pixel of n samples is worth.
int looks(const TestImage& scene, int n) {
  const Halving& halving = scene.has_strips() ? kWithStrips : kWithoutStrips;
  return n < halving.least ? 0 : n / halving.samples_a_look;
}

}  // namespace

BoxCounter::BoxCounter(const TestImage& scene, const Pattern& pattern)
    : scene_(scene),
      pattern_(pattern),
      n_(static_cast<std::size_t>(pattern.n())),
      looks_(looks(scene, pattern.n())),
      has_cells_(pattern.has_cells() && (scene.has_strips() || looks_ > 0)) {
  assert(!scene.moves());
  const std::size_t room = std::max(n_, kBatch);
  x_ = std::make_unique_for_overwrite<double[]>(room);
  y_ = std::make_unique_for_overwrite<double[]>(room);
  inside_ = std::make_unique_for_overwrite<std::uint8_t[]>(room);
}

void BoxCounter::test_all(int x0, int x1, int y, std::span<std::int64_t> inside) {
  const int together = static_cast<int>(std::max(std::size_t{1}, kBatch / n_));
  for (int x = x0; x < x1;) {
    const int end = std::min(x1, x + together);
    run_.clear();
    for (int i = x; i < end; ++i) run_.push_back({i, y});
    const std::size_t count = run_.size() * n_;
    pattern_.fill(run_, {{x_.get(), count}, {y_.get(), count}});
    scene_.contains(run_, {x_.get(), count}, {y_.get(), count}, {inside_.get(), count});
    for (std::size_t p = 0; p < run_.size(); ++p) {
      inside[static_cast<std::size_t>(x - x0) + p] = count_inside({inside_.get() + p * n_, n_});
    }
    x = end;
  }
}

BoxCounter::Count BoxCounter::test_crossed(Pixel pixel) {
  const CellGrid grid = pattern_.cells(pixel);
  if (grid.columns == 0 || !find_cells(pixel, grid)) {
    Count count{0, static_cast<std::int64_t>(n_)};
    test_all(static_cast<int>(pixel.x), static_cast<int>(pixel.x) + 1, static_cast<int>(pixel.y), {&count.inside, 1});
    return count;
  }
  const CellPoints points = pattern_.take_cells(pixel, whole_, crossed_, {{x_.get(), n_}, {y_.get(), n_}});
  const std::span<std::uint8_t> inside(inside_.get(), points.filled);
  if (points.filled > 0) {
    scene_.contains({&pixel, 1}, {x_.get(), points.filled}, {y_.get(), points.filled}, inside);
  }
  return {points.counted + count_inside(inside), static_cast<std::int64_t>(points.filled)};
}

// Sorts the pixel's cells into whole and crossed ones, and none; false where neither way knows.
bool BoxCounter::find_cells(Pixel pixel, const CellGrid& grid) {
  if (!(grid == grid_)) {
    grid_ = grid;
    sides_.resize(static_cast<std::size_t>(grid.seen_rows()) + 1);
    for (std::size_t j = 0; j < sides_.size(); ++j) sides_[j] = grid.side(static_cast<int>(j));
    strips_.resize(4 * sides_.size());
    columns_.resize(sides_.size());
  }
  whole_.clear();
  crossed_.clear();
  if (find_by_strips(pixel)) return true;
  if (looks_ == 0) return false;
  whole_.clear();
  crossed_.clear();
  looks_left_ = looks_;
  const int first_column = grid.right > 0, first_row = grid.down > 0;
  // What lies in two parts is tested.
  if (first_row > 0) crossed_.push_back({0, 0, grid.columns});
  for (int row = first_row; first_column > 0 && row < grid.rows; ++row) crossed_.push_back({row, 0, 1});
  return halve(pixel, first_column, grid.columns, first_row, grid.rows);
}

bool BoxCounter::find_by_strips(Pixel pixel) {
  const std::size_t count = sides_.size() - 1;
  const auto numbers = [&](std::size_t i) { return std::span<double>(strips_.data() + i * count, count); };
  const Strips strips{numbers(0), numbers(1), numbers(2), numbers(3)};
  if (!scene_.strips(pixel, sides_, strips)) return false;
  const double scale = grid_.columns, low = grid_.right - kColumnGrowth, high = grid_.right + kColumnGrowth + 1;
  const double last = grid_.seen_columns();
  // Conversion cuts off the fraction: a column that is touched begins there, one that is whole ends there. One more is
  // the end of those touched, and where a whole one begins.
  const auto column = [=](double v) { return static_cast<std::int32_t>(std::min(std::max(v, 0.0), last)); };
  for (std::size_t j = 0; j < count; ++j) {
    columns_[j] = {column(strips.outer_begin[j] * scale + low), column(strips.outer_end[j] * scale + high),
                   column(strips.inner_begin[j] * scale + high), column(strips.inner_end[j] * scale + low)};
  }
  if (grid_.down == 0) {
    for (std::size_t j = 0; j < count; ++j) add_row(static_cast<int>(j), columns_[j]);
    return true;
  }
  const Cover upper = cover_of(columns_[0]), lower = cover_of(columns_[count - 1]);
  const CellSpan seam{0, 0, grid_.columns};
  if (upper != lower || upper == Cover::partial) {
    crossed_.push_back(seam);
  } else if (upper == Cover::all) {
    whole_.push_back(seam);
  }
  for (std::size_t j = 1; j + 1 < count; ++j) add_row(static_cast<int>(j), columns_[j]);
  return true;
}

Cover BoxCounter::cover_of(const Columns& c) const noexcept {
  if (c.begin >= c.end) return Cover::none;
  return c.whole_begin == 0 && c.whole_end == grid_.seen_columns() ? Cover::all : Cover::partial;
}

void BoxCounter::add_row(std::int32_t row, Columns c) {
  if (c.begin >= c.end) return;
  if (c.whole_begin >= c.whole_end) c.whole_begin = c.whole_end = c.end;
  if (grid_.right > 0) {
    // Column 0 in two parts, the same as with a row. The others remain.
    const std::int32_t last = grid_.columns;
    const bool all_left = c.whole_begin == 0 && c.whole_end > 0, all_right = c.whole_end > last;
    const bool none_left = c.begin > 0, none_right = c.end <= last;
    if (all_left && all_right) {
      whole_.push_back({row, 0, 1});
    } else if (!none_left || !none_right) {
      crossed_.push_back({row, 0, 1});
    }
    for (std::int32_t* v : {&c.begin, &c.end, &c.whole_begin, &c.whole_end}) *v = std::clamp(*v, 1, last);
  }
  if (c.begin < c.whole_begin) crossed_.push_back({row, c.begin, c.whole_begin});
  if (c.whole_begin < c.whole_end) whole_.push_back({row, c.whole_begin, c.whole_end});
  if (c.whole_end < c.end) crossed_.push_back({row, c.whole_end, c.end});
}

bool BoxCounter::halve(Pixel pixel, int x0, int x1, int y0, int y1) {
  if (x0 == x1 || y0 == y1) return true;
  if (looks_left_-- == 0) return false;
  const auto x = [&](int column) { return (column - grid_.right) / grid_.columns; };
  const double growth = kColumnGrowth / grid_.columns;
  const Cover cover = scene_.cover(pixel, {{x(x0) - growth, sides_[static_cast<std::size_t>(y0)]},
                                           {x(x1) + growth, sides_[static_cast<std::size_t>(y1)]}});
  if (cover == Cover::none) return true;
  const int width = x1 - x0, height = y1 - y0;
  if (cover == Cover::all || (width <= kBlock && height <= kBlock)) {
    for (int row = y0; row < y1; ++row) (cover == Cover::all ? whole_ : crossed_).push_back({row, x0, x1});
    return true;
  }
  if (width >= height) {
    const int middle = x0 + width / 2;
    return halve(pixel, x0, middle, y0, y1) && halve(pixel, middle, x1, y0, y1);
  }
  const int middle = y0 + height / 2;
  return halve(pixel, x0, x1, y0, middle) && halve(pixel, x0, x1, middle, y1);
}

}  // namespace moire
