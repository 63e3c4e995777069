// Jittered sampling: one random point in each cell of an m x m grid. Its error falls as N^-3/4 at edges.
// R. L. Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986.
#include <cmath>

#include "patterns/pattern.h"
#include "patterns/strata.h"
#include "patterns/uniform.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    number("amount", 1, 0, 1, "size of the jitter as a fraction of the cell; 0 is the regular grid")};

struct Jittered {
  int n, m;  // n = m * m points, cell (i % m, i / m) holds point i
  double amount;
  Strata strata;
  std::uint64_t draw;

  Jittered(const Args& args, int count, Draw d)
      : n(count),
        m(static_cast<int>(std::lround(std::sqrt(count)))),
        amount(args.number("amount")),
        strata(m),
        draw(draw_hash(d.seed, d.trial)) {}

  // The offset in the cell after shrinking towards its middle. Rounding is monotone and the extreme offsets are
  // doubles, so the result stays between them for every amount in [0, 1].
  double jitter(double u) const noexcept { return 0.5 + amount * (strata.offset(u) - 0.5); }

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    double* __restrict x = out.x.data(), * __restrict y = out.y.data();
    for (const Pixel& pixel : run) {
      uniform_points(pixel_key(draw, pixel), Axis::xy, 0, n, x, y);
      for (int row = 0; row < m; ++row) {
        for (int column = 0; column < m; ++column) x[column] = strata.place(column, jitter(x[column]));
        for (int column = 0; column < m; ++column) y[column] = strata.place(row, jitter(y[column]));
        x += m;
        y += m;
      }
    }
  }
};

}  // namespace

extern const PatternInfo jittered_pattern;
constinit const PatternInfo jittered_pattern = describe<Jittered>(
    {.name = "jittered",
     .title = "One random point in each cell of a square grid",
     .cite = "Cook 1986",
     .varies = [](const Args& args) { return args.number("amount") > 0 ? Varies::by_trial : Varies::never; },
     .counts = square_count,
     .params = kParams});

}  // namespace moire
