// Zaremba-Hammersley points: (i/N, psi_2(i), psi_3(i)), radical inverses with folded digits, in base 2 every second one
// flipped, as in D. P. Mitchell, "Ray tracing and irregularities of distribution", Third Eurographics Workshop on
// Rendering, 1992, after T. T. Warnock, "Computational investigations of low-discrepancy point sets", in S. K. Zaremba
// (ed.), 1972.
#include "patterns/area.h"
#include "patterns/instance.h"
#include "patterns/pattern.h"
#include "patterns/radical_inverse.h"
#include "patterns/radical_inverse3.h"

namespace moire {
namespace {

// psi_2(i), correctly rounded. Digit k of i, k = 0 the least significant and the first after the point, becomes
// (digit + k) mod 2: the odd k are flipped, also the infinitely many leading zeros of i. They leave a tail: with A the
// first 32 digits, psi = A 2^-32 + 2^-32 (0.010101...) = (3 A + 1) / (3 * 2^32). Only the division rounds, since
// 3 A + 1 < 2^34. Mitchell's table 1 comes out only with the tail; without it T is off by 23% at N = 16.
double psi2(std::uint32_t i) {
  const std::uint32_t digits = radical_inverse32(i) ^ 0x55555555u;
  return (3.0 * digits + 1.0) / 3.0 * 0x1p-32;
}

PlainSet zaremba_set(int n, bool with_time) {
  PlainSet set;
  set.x.reserve(static_cast<std::size_t>(n));
  set.y.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    set.x.push_back(i / static_cast<double>(n));
    set.y.push_back(psi2(static_cast<std::uint32_t>(i)));
  }
  set.t.resize(with_time ? static_cast<std::size_t>(n) : 0);
  psi3(set.t);
  set.folding = ternary_folding();
  return set;
}

struct Zaremba {
  static constexpr bool kHasTime = true;
  Instances points;

  Zaremba(const Args& args, int n, Draw draw) : points(args, draw, zaremba_set(n, true), Instances::kWithCells) {}
  void fill(std::span<const Pixel> run, Points out) const noexcept { points.fill(run, out); }
  static constexpr int kLeastForCells = Instances::kLeastForCells;
  CellGrid cells(Pixel pixel) const noexcept { return points.cells(pixel); }
  CellPoints take_cells(Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept {
    return points.take_cells(pixel, counted, filled, out);
  }

  static constexpr auto area_count = any_area_count;
  static void fill_area(const Args& args, Grid area, Draw draw, Points out) {
    const Pixel whole{};
    Instances(args, draw, zaremba_set(static_cast<int>(out.x.size()), !out.t.empty())).fill({&whole, 1}, out);
    stretch(area, out);
  }
};

}  // namespace

extern const PatternInfo zaremba_pattern;
constinit const PatternInfo zaremba_pattern = describe<Zaremba>({.name = "zaremba",
                                                                 .title = "Hammersley points with folded digits",
                                                                 .cite = "Warnock 1972; Mitchell 1992",
                                                                 .varies = instance_varies,
                                                                 .counts = any_count,
                                                                 .params = kInstanceParams});

}  // namespace moire
