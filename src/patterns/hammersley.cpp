// Hammersley points: (i/N, phi_2(i)), phi_2 the radical inverse in base 2. J. M. Hammersley, "Monte Carlo methods for
// solving multivariable problems", Ann. New York Acad. Sci. 86, 1960.
#include "patterns/area.h"
#include "patterns/instance.h"
#include "patterns/pattern.h"
#include "patterns/radical_inverse.h"

namespace moire {
namespace {

PlainSet hammersley_set(int n) {
  PlainSet set;
  set.x.reserve(static_cast<std::size_t>(n));
  set.y.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    set.x.push_back(i / static_cast<double>(n));
    set.y.push_back(radical_inverse32(static_cast<std::uint32_t>(i)) * 0x1p-32);
  }
  return set;
}

struct Hammersley {
  Instances points;

  Hammersley(const Args& args, int n, Draw draw) : points(args, draw, hammersley_set(n)) {}
  void fill(std::span<const Pixel> run, Points out) const noexcept { points.fill(run, out); }

  static constexpr auto area_count = any_area_count;
  static void fill_area(const Args& args, Grid area, Draw draw, Points out) {
    const Pixel whole{};
    Instances(args, draw, hammersley_set(static_cast<int>(out.x.size()))).fill({&whole, 1}, out);
    stretch(area, out);
  }
};

}  // namespace

extern const PatternInfo hammersley_pattern;
constinit const PatternInfo hammersley_pattern = describe<Hammersley>({.name = "hammersley",
                                                                       .title = "Hammersley points in base 2",
                                                                       .cite = "Hammersley 1960",
                                                                       .varies = instance_varies,
                                                                       .counts = any_count,
                                                                       .params = kInstanceParams});

}  // namespace moire
