// Hammersley points: (i/N, phi_2(i), phi_3(i)), phi_b the radical inverse in base b. J. M. Hammersley, "Monte Carlo
// methods for solving multivariable problems", Ann. New York Acad. Sci. 86, 1960.
#include "patterns/area.h"
#include "patterns/instance.h"
#include "patterns/pattern.h"
#include "patterns/radical_inverse.h"
#include "patterns/radical_inverse3.h"

namespace moire {
namespace {

PlainSet hammersley_set(int n, bool with_time) {
  PlainSet set;
  set.x.reserve(static_cast<std::size_t>(n));
  set.y.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    set.x.push_back(i / static_cast<double>(n));
    set.y.push_back(radical_inverse32(static_cast<std::uint32_t>(i)) * 0x1p-32);
  }
  set.t.resize(with_time ? static_cast<std::size_t>(n) : 0);
  phi3(set.t);
  return set;
}

struct Hammersley {
  static constexpr bool kHasTime = true;
  Instances points;

  Hammersley(const Args& args, int n, Draw draw) : points(args, draw, hammersley_set(n, true), Instances::kWithCells) {}
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
    Instances(args, draw, hammersley_set(static_cast<int>(out.x.size()), !out.t.empty())).fill({&whole, 1}, out);
    stretch(area, out);
  }
};

}  // namespace

extern const PatternInfo hammersley_pattern;
constinit const PatternInfo hammersley_pattern =
    describe<Hammersley>({.name = "hammersley",
                          .title = "Hammersley points, radical inverses in bases 2 and 3",
                          .cite = "Hammersley 1960",
                          .varies = instance_varies,
                          .counts = any_count,
                          .params = kInstanceParams});

}  // namespace moire
