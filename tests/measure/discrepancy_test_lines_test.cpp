// Random lines against their laws, and the areas above them against clipping. All seeds are fixed; each test says how
// often it would fail for other seeds.
#include "measure/discrepancy/test_lines.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "patterns/variants.h"

using namespace moire;
using moire::test::PointSet;
using moire::test::set_of;

namespace {

__extension__ using Quad = __float128;
constexpr double kPi = std::numbers::pi;
constexpr LineLaw kLaws[] = {LineLaw::isotropic, LineLaw::printed};

Key key_of(std::uint32_t trial) { return pixel_key(draw_hash(21, trial), {}); }

// Heights n.p - c of the corners, and the part of the square above, clipped and measured in 113 bits.
double clipped_area(const TestLine& line) {
  struct Corner {
    Quad x, y;
  };
  const Corner square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto height = [&](Corner p) {
    return static_cast<Quad>(line.nx) * p.x + static_cast<Quad>(line.ny) * p.y - static_cast<Quad>(line.c);
  };
  std::vector<Corner> above;
  for (std::size_t i = 0; i < 4; ++i) {
    const Corner a = square[i], b = square[(i + 1) % 4];
    const Quad ha = height(a), hb = height(b);
    if (ha >= 0) above.push_back(a);
    if ((ha >= 0) != (hb >= 0)) {
      const Quad s = ha / (ha - hb);
      above.push_back({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)});
    }
  }
  // A fan around the first corner: nothing but small triangles' areas is added for a small part.
  Quad twice = 0;
  for (std::size_t i = 1; i + 1 < above.size(); ++i) {
    const Corner o = above[0], a = above[i], b = above[i + 1];
    twice += (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
  }
  return static_cast<double>(twice / 2);
}

// Chi-square of counts against weights that sum to 1, in units of standard deviations from its mean. For 15 and more
// degrees of freedom it is beyond 4 with a chance below 5e-4.
double chi_square_excess(const std::vector<int>& counts, const std::vector<double>& weights) {
  double total = 0, chi = 0;
  for (const int c : counts) total += c;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double want = total * weights[i];
    chi += (counts[i] - want) * (counts[i] - want) / want;
  }
  const auto degrees = static_cast<double>(counts.size() - 1);
  return (chi - degrees) / std::sqrt(2 * degrees);
}

// The chance that a line separates two points: Crofton's formula, and for the printed law the mean of |dy - m dx| /
// (1 + |m|), the share of intercepts b between the two, over slopes m.
double separation(LineLaw law, double dx, double dy) {
  const double u = std::max(std::fabs(dx), std::fabs(dy)), v = std::min(std::fabs(dx), std::fabs(dy));
  if (u == 0) return 0;
  return law == LineLaw::isotropic ? std::hypot(dx, dy) / 2 : ((u - v) + (u + v) * std::log1p(v / u)) / 2;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the area above a line is that of the clipped square, to a few roundings of itself") {
    std::vector<TestLine> lines;
    // Along the axes, either side, near and through the corners.
    for (const double c : {0.0, 0x1p-1074, 1e-300, 1e-17, 0.25, 0.5, 1 - 0x1p-53, 1.0, 1.5})
      for (const auto& [nx, ny] : {std::pair{1.0, 0.0}, {0.0, 1.0}}) {
        lines.push_back({nx, ny, c});
        lines.push_back({-nx, -ny, -c});
      }
    // Through or very near to every corner in many directions, some nearly along an axis or the diagonal.
    for (const double angle : {0.0, 1e-300, 1e-200, 1e-17, 1e-9, 1e-3, 0.3, kPi / 4, kPi / 4 + 1e-16, 0.8, 1.5, 1.6,
                               2.0, 3.0, 3.2, 4.0, 5.0, 6.0})
      for (const double corner_x : {0.0, 1.0})
        for (const double corner_y : {0.0, 1.0})
          for (const double off : {0.0, 1e-17, 1e-16, -1e-16, 1e-12, -1e-12, 1e-6, -1e-6, 1e-3, -1e-3, 0.1, -0.1})
            for (const double length : {1.0, 1e-3, 1e5}) {
              const double nx = length * std::cos(angle), ny = length * std::sin(angle);
              lines.push_back({nx, ny, nx * corner_x + ny * corner_y + off * length});
            }
    for (const LineLaw law : kLaws)
      for (std::uint64_t i = 0; i < 5000; ++i) lines.push_back(test_line(law, key_of(1), i));
    for (const TestLine& line : lines) {
      CAPTURE(line.nx);
      CAPTURE(line.ny);
      CAPTURE(line.c);
      const double got = area_above(line), want = clipped_area(line);
      // The header's bound; the clipping's own roundings, 2^-113 of coordinates up to 1, come on top.
      CHECK(std::fabs(got - want) <= 0x1p-50 * want + 1e-32);
      CHECK(got >= 0);
      CHECK(got <= 1);
      CHECK(std::fabs(got + area_above({-line.nx, -line.ny, -line.c}) - 1) <= 0x1p-52);
    }
  }

  TEST_CASE("every random line has a unit normal and hits the square") {
    for (const LineLaw law : kLaws)
      for (std::uint64_t i = 0; i < 20000; ++i) {
        const TestLine line = test_line(law, key_of(2), i * 0x123456789u);  // indices beyond 32 bits among them
        CHECK(std::fabs(std::hypot(line.nx, line.ny) - 1) < 4 * 0x1p-53);
        // c is rounded: it may pass a corner by that much.
        CHECK(line.c >= std::min(line.nx, 0.0) + std::min(line.ny, 0.0) - 4 * 0x1p-53);
        CHECK(line.c <= std::max(line.nx, 0.0) + std::max(line.ny, 0.0) + 4 * 0x1p-53);
        if (law == LineLaw::printed) CHECK(line.ny >= 0);
      }
  }

  TEST_CASE("printed lines are the paper's slope and intercept, with the points above y = m x + b above") {
    for (std::uint32_t i = 0; i < 5000; ++i) {
      const Key key = key_of(3);
      const Words r = hash(key, i, Axis::test_line, 0), s = hash(key, i, Axis::test_line, 1);
      const double m = (unit(r.a, r.b) - 0.5) / (unit(r.c, r.d) - 0.5), u = unit(s.a, s.b);
      const double b = m < 0 ? (1 - m) * u : (-1 - m) * u + 1;
      const TestLine line = test_line(LineLaw::printed, key, i);
      // Each side has a handful of roundings, b those of terms as large as m.
      const double scale = 1 + std::fabs(m);
      CHECK(std::fabs(line.nx + m * line.ny) < 8 * 0x1p-53);
      CHECK(std::fabs(line.c - b * line.ny) < 8 * 0x1p-53 * scale * line.ny);
    }
  }

  TEST_CASE("the angles and offsets of random lines have their laws, by chi-square") {
    // Five chi-square values within 4 standard deviations: fails for less than one seed in 400.
    constexpr int kLines = 200000, kAngles = 24, kOffsets = 10;
    for (const LineLaw law : kLaws) {
      std::vector<int> joint(kAngles * kOffsets), folded(18), sides(16);
      for (int i = 0; i < kLines; ++i) {
        const TestLine line = test_line(law, key_of(4), static_cast<std::uint64_t>(i));
        double angle = std::atan2(line.ny, line.nx);  // of the normal
        if (angle < 0) angle += 2 * kPi;
        const double low = std::min(line.nx, 0.0) + std::min(line.ny, 0.0);
        const double offset = (line.c - low) / (std::fabs(line.nx) + std::fabs(line.ny));  // uniform for either law
        const auto bin = [](double share, int bins) { return std::clamp(static_cast<int>(share * bins), 0, bins - 1); };
        const double turn = law == LineLaw::isotropic ? 2 * kPi : kPi;  // printed normals have ny >= 0
        ++joint[static_cast<std::size_t>(bin(angle / turn, kAngles) * kOffsets + bin(offset, kOffsets))];
        const double to_axis = std::atan2(std::min(std::fabs(line.nx), std::fabs(line.ny)),
                                          std::max(std::fabs(line.nx), std::fabs(line.ny)));
        ++folded[static_cast<std::size_t>(bin(to_axis / (kPi / 4), 18))];
        ++sides[static_cast<std::size_t>(bin(angle / (2 * kPi), 16))];
      }
      // Integrals of the densities over angles: (|cos| + |sin|) / 8 and, over half a turn, sec^2 / 4 of the angle to
      // the nearer axis.
      const auto isotropic = [](double a, double b) {
        double sum = 0;  // Simpson's rule on 1/100 of the interval: bins end where |cos| and |sin| have their corners
        const double h = (b - a) / 100;
        const auto f = [](double x) { return (std::fabs(std::cos(x)) + std::fabs(std::sin(x))) / 8; };
        for (int k = 0; k < 100; ++k) sum += (f(a + k * h) + 4 * f(a + (k + 0.5) * h) + f(a + (k + 1) * h)) * h / 6;
        return sum;
      };
      const auto printed = [](double a, double b) {
        // tan runs from 0 to 1 over each octant; within one octant, folded to the axis.
        const auto tangent = [](double x) {
          const double octant = std::floor(x / (kPi / 4)), inside = x - octant * kPi / 4;
          const bool from_axis = std::fmod(octant, 2) == 0;
          return octant + (from_axis ? std::tan(inside) : 1 - std::tan(kPi / 4 - inside));
        };
        return (tangent(b) - tangent(a)) / 4;
      };
      std::vector<double> joint_weights, isotropic_folded, printed_folded;
      for (int a = 0; a < kAngles; ++a)
        for (int o = 0; o < kOffsets; ++o) {
          const double turn = law == LineLaw::isotropic ? 2 * kPi : kPi, from = a * turn / kAngles,
                       to = (a + 1) * turn / kAngles;
          joint_weights.push_back((law == LineLaw::isotropic ? isotropic(from, to) : printed(from, to)) / kOffsets);
        }
      for (int k = 0; k < 18; ++k) {
        const double from = k * kPi / 72, to = (k + 1) * kPi / 72;
        isotropic_folded.push_back(8 * isotropic(from, to));
        printed_folded.push_back(4 * printed(from, to));
      }
      CHECK(std::fabs(chi_square_excess(joint, joint_weights)) < 4);
      const double as_isotropic = chi_square_excess(folded, isotropic_folded),
                   as_printed = chi_square_excess(folded, printed_folded);
      // Each law is its own, and plainly not the other, though the paper takes the printed one for isotropic.
      CHECK(std::fabs(law == LineLaw::isotropic ? as_isotropic : as_printed) < 4);
      CHECK((law == LineLaw::isotropic ? as_printed : as_isotropic) > 300);
      if (law == LineLaw::isotropic) {
        std::vector<double> weights;
        for (int k = 0; k < 16; ++k) weights.push_back(isotropic(k * kPi / 8, (k + 1) * kPi / 8));
        CHECK(std::fabs(chi_square_excess(sides, weights)) < 4);
      }
    }
  }

  TEST_CASE("random lines separate two points as often as integral geometry says") {
    // 40 comparisons within 3.5 standard errors: fails for one seed in 50.
    constexpr int kLines = 100000;
    const PointSet a = set_of("random", 20, {31, 0}), b = set_of("random", 20, {31, 1});
    for (const LineLaw law : kLaws)
      for (std::size_t p = 0; p < 20; ++p) {
        int separated = 0;
        for (int i = 0; i < kLines; ++i) {
          const TestLine line =
              test_line(law, key_of(5 + static_cast<std::uint32_t>(p)), static_cast<std::uint64_t>(i));
          const bool first = line.nx * a.x[p] + line.ny * a.y[p] >= line.c;
          separated += first != (line.nx * b.x[p] + line.ny * b.y[p] >= line.c) ? 1 : 0;
        }
        const double want = separation(law, a.x[p] - b.x[p], a.y[p] - b.y[p]);
        CHECK(std::fabs(separated - kLines * want) < 3.5 * std::sqrt(kLines * want * (1 - want)));
      }
  }
}
