// Scan-time: jittered points that get their times in scanning order, each as far as possible from the points before it.
//
// DERIVED. D. P. Mitchell's "Ray tracing and irregularities of distribution" (1992) measures a pattern of this kind,
// from his "Spectrally optimal sampling for distribution ray tracing", Computer Graphics 25(4), 1991. The text of 1991
// was not available, so this algorithm is derived from its abstract: cells in raster order; in each, k random times,
// of which the one is kept whose distance to the nearest earlier point is greatest, on the unit torus in (x, y, t).
// The mean star discrepancies come near to the printed ones: .0467 (.0473) at N = 16, .00750 (.00721) at 256 and .00235
// (.00235) at 1600.
//
// Only points within 8 cells to each side, on the torus, are looked at: all of them up to N = 289. One set takes about
// 144 N k distances: 1.6 ms at N = 1600 with k = 10, 16 ms at 16384 (g++ 12 -O3).
#include <algorithm>
#include <array>
#include <cmath>

#include "patterns/jittered_grid.h"
#include "patterns/pattern.h"

namespace moire {
namespace {

constexpr int kReach = 8;  // cells to each side
constexpr int kMostCandidates = 256;

constexpr Param kParams[] = {integer("k", 10, 1, kMostCandidates,
                                     "random times of which each point takes the one farthest from earlier points")};

// |a - b| on the circle of length 1, for a and b in [0, 1).
double around(double a, double b) noexcept {
  const double d = std::abs(a - b);
  return std::min(d, 1 - d);
}

struct ScanTime {
  static constexpr bool kHasTime = true;
  JitteredGrid grid;
  std::uint32_t k;
  std::uint64_t draw;

  ScanTime(const Args& args, int n, Draw d)
      : grid(JitteredGrid::of_pixel(n, 1)),
        k(static_cast<std::uint32_t>(args.integer("k"))),
        draw(draw_hash(d.seed, d.trial)) {}

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    const auto n = static_cast<std::size_t>(grid.columns * grid.rows);
    for (std::size_t p = 0; p < run.size(); ++p) {
      const Points here = out.part(p * n, n);
      const Key key = pixel_key(draw, run[p]);
      grid.fill(key, here.x.data(), here.y.data());
      if (!here.t.empty()) scan(key, here);
    }
  }

  // Where no times are wanted these are the points of `jittered`.
  static constexpr int kLeastForCells = JitteredGrid::kLeastForCells;
  CellGrid cells(Pixel) const noexcept { return grid.cells(); }
  CellPoints take_cells(Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept {
    return grid.take_cells(pixel_key(draw, pixel), counted, filled, out);
  }

 private:
  // Candidate j of point i is part j of number i: with more candidates, the first ones stay the same.
  void scan(const Key& key, Points points) const noexcept {
    std::array<double, kMostCandidates> time, nearest2;
    std::size_t i = 0;
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column, ++i) {
        for (std::uint32_t j = 0; j < k; ++j) {
          const Words w = hash(key, static_cast<std::uint32_t>(i), Axis::scan, j);
          time[j] = unit(w.a, w.b);
        }
        measure(row, column, points, time.data(), nearest2.data());
        // The first one among equals; so also where there is no earlier point.
        points.t[i] =
            time[static_cast<std::size_t>(std::max_element(nearest2.begin(), nearest2.begin() + k) - nearest2.begin())];
      }
    }
  }

  // The squared distance from each candidate of a cell to the nearest earlier point.
  void measure(int row, int column, Points points, const double* __restrict time,
               double* __restrict nearest2) const noexcept {
    std::fill_n(nearest2, k, 1.0);  // more than any on the torus, 3/4
    const std::size_t own =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
    const double x = points.x[own], y = points.y[own];
    const int down = std::min(grid.rows, 2 * kReach + 1), across = std::min(grid.columns, 2 * kReach + 1);
    for (int a = 0, r = before(row, grid.rows); a < down; ++a, r = after(r, grid.rows)) {
      if (r > row) continue;
      for (int b = 0, c = before(column, grid.columns); b < across; ++b, c = after(c, grid.columns)) {
        const std::size_t other =
            static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(c);
        if (other >= own) continue;
        const double dx = around(x, points.x[other]), dy = around(y, points.y[other]), t = points.t[other];
        const double dxy2 = dx * dx + dy * dy;
        for (std::uint32_t j = 0; j < k; ++j) {
          const double dt = around(time[j], t), d2 = dxy2 + dt * dt;
          nearest2[j] = std::min(nearest2[j], d2);
        }
      }
    }
  }

  // The cell kReach before cell i of a ring of n, or on a smaller ring any cell; and the one after it.
  static int before(int i, int n) noexcept { return i >= kReach ? i - kReach : std::max(0, i - kReach + n); }
  static int after(int i, int n) noexcept { return i + 1 == n ? 0 : i + 1; }
};

}  // namespace

extern const PatternInfo scan_time_pattern;
constinit const PatternInfo scan_time_pattern = describe<ScanTime>(
    {.name = "scan-time",
     .title = "Jittered points at times far from earlier points; algorithm derived, not the original",
     .cite = "derived after Mitchell 1991",
     .varies = [](const Args&) { return Varies::by_trial; },
     .counts = square_count,
     .params = kParams});

}  // namespace moire
