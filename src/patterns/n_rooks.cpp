// N-rooks sampling (Latin hypercube): a random permutation puts one point in each of the N columns and N rows, anywhere
// inside both strata. P. Shirley, "Discrepancy as a quality measure for sample distributions", Eurographics 1991.
#include <utility>

#include "patterns/area.h"
#include "patterns/pattern.h"
#include "patterns/strata.h"
#include "patterns/uniform.h"

namespace moire {
namespace {

// Fisher-Yates, inside out and in place: y becomes the permutation, x holds the draws it is made from.
void permute(const Key& key, Axis order, int n, double* __restrict x, double* __restrict y) noexcept {
  for (int i = 0; i < n; ++i) {
    const Words w = hash(key, static_cast<std::uint32_t>(i), order);
    x[i] = uniform_below(w.a, w.b, static_cast<std::uint32_t>(i) + 1);
  }
  for (int i = 0; i < n; ++i) {
    y[i] = i;
    std::swap(y[i], y[static_cast<std::int32_t>(x[i])]);
  }
}

// n rooks on the unit square.
void place_rooks(const Key& key, Axis order, Axis position, int n, double* __restrict x,
                 double* __restrict y) noexcept {
  const Strata strata(n);
  permute(key, order, n, x, y);
  for (int i = 0; i < n; ++i) {
    const Words w = hash(key, static_cast<std::uint32_t>(i), position);
    x[i] = strata.place(i, strata.offset(unit(w.a, w.b)));
    y[i] = strata.place(y[i], strata.offset(unit(w.c, w.d)));
  }
}

struct NRooks {
  int n;
  std::uint64_t draw;

  NRooks(const Args&, int count, Draw d) : n(count), draw(draw_hash(d.seed, d.trial)) {}

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    double* __restrict x = out.x.data(), * __restrict y = out.y.data();
    for (const Pixel& pixel : run) {
      place_rooks(pixel_key(draw, pixel), Axis::order, Axis::xy, n, x, y);
      x += n;
      y += n;
    }
  }

  static constexpr auto area_count = any_area_count;
  static void fill_area(const Args&, Grid area, Draw d, Points out) {
    place_rooks(pixel_key(draw_hash(d.seed, d.trial), {}), Axis::area_order, Axis::area, static_cast<int>(out.x.size()),
                out.x.data(), out.y.data());
    stretch(area, out);
  }
};

}  // namespace

extern const PatternInfo n_rooks_pattern;
constinit const PatternInfo n_rooks_pattern = describe<NRooks>({.name = "n-rooks",
                                                                .title = "One random point in each row and each column",
                                                                .cite = "Shirley 1991",
                                                                .varies = [](const Args&) { return Varies::by_trial; },
                                                                .counts = any_count,
                                                                .params = {}});

}  // namespace moire
