// N-rooks sampling (Latin hypercube): a random permutation puts one point in each of the N columns and N rows, anywhere
// inside both strata. P. Shirley, "Discrepancy as a quality measure for sample distributions", Eurographics 1991.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "patterns/area.h"
#include "patterns/pattern.h"
#include "patterns/strata.h"
#include "patterns/uniform.h"

namespace moire {
namespace {

// Numbers that are drawn at a time.
constexpr int kChunk = 256;

// Fisher-Yates, inside out: p becomes the permutation.
void permute(const Key& key, Axis order, int n, double* p) noexcept {
  std::array<std::uint64_t, kChunk> bits;
  for (int done = 0; done < n; done += kChunk) {
    const int count = std::min(kChunk, n - done);
    uniform_bits(key, order, static_cast<std::uint32_t>(done), {bits.data(), static_cast<std::size_t>(count)});
    for (int i = done; i < done + count; ++i) {
      p[i] = i;
      std::swap(p[i], p[uniform_below(bits[static_cast<std::size_t>(i - done)], static_cast<std::uint32_t>(i) + 1)]);
    }
  }
}

// n rooks on the unit square.
void place_rooks(const Key& key, Axis order, Axis position, int n, double* __restrict x,
                 double* __restrict y) noexcept {
  const Strata strata(n);
  permute(key, order, n, y);
  std::array<double, kChunk> u, v;
  for (int done = 0; done < n; done += kChunk) {
    const int count = std::min(kChunk, n - done);
    uniform_points(key, position, static_cast<std::uint64_t>(done), count, u.data(), v.data());
    for (int i = 0; i < count; ++i) {
      x[done + i] = strata.place(done + i, strata.offset(u[static_cast<std::size_t>(i)]));
      y[done + i] = strata.place(y[done + i], strata.offset(v[static_cast<std::size_t>(i)]));
    }
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
