// The oracle's definitions against the tables of polynomials that are usually printed for them, and its rules against
// far finer ones.
#include "oracle/shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "filter_list.h"
#include "oracle/kernel.h"

namespace moire::oracle {
namespace {

using Real = long double;

HalfKernel half(const std::string& text) { return half_kernel(parse_spec(text, "test")); }

// The largest difference of the two shapes of |x| <= radius, of 1000 points; both of the same scale.
Real gap(const std::string& text, const std::function<Real(Real)>& printed) {
  const HalfKernel k = half(text);
  Real worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const Real x = k.breaks.back() * static_cast<Real>(i) / 1000;
    worst = std::max(worst, std::fabs(k.shape(x) - printed(x)));
  }
  return worst;
}

// Polynomials up to degree 9 and quotients of them, sizes up to about 10: a few tens of long double ulps.
constexpr Real kRounding = 0x1p-58L;

// Filters at and beyond the ends of the parameters that the program may allow: short and long, blunt and sharp.
std::vector<std::string> extreme_kernels() {
  return {"box:width=1e-3",
          "tent:radius=16",
          "lagrange:order=9",
          "lagrange:order=8",
          "keys:a=-3",
          "mitchell:b=3,c=-2,radius=0.25",
          "gaussian:sigma=0.02,radius=1",
          "gaussian:sigma=50,radius=4",
          "blackman-harris:width=0.1",
          "blackman-harris:width=32",
          "lanczos:a=1",
          "lanczos:a=16",
          "lanczos:a=2,blur=0.2",
          "pbrt-sinc:radius=16,tau=1",
          "pbrt-sinc:radius=1,tau=16",
          "windowed-sinc:window=kaiser,radius=1,beta=40",
          "windowed-sinc:window=kaiser,radius=16,beta=0",
          "windowed-sinc:window=blackman-harris,radius=1",
          "windowed-sinc:window=parzen,radius=16",
          "sinc:radius=16"};
}

std::vector<std::string> every_kernel() {
  std::vector<std::string> all = test::separable_texts();
  for (std::string& text : extreme_kernels()) all.push_back(std::move(text));
  return all;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("definitions give the polynomials that are printed for them") {
    CHECK(gap("lagrange", [](Real x) { return x < 1 ? (1 - x * x) * (2 - x) / 2 : (1 - x) * (2 - x) * (3 - x) / 6; }) <
          kRounding);
    CHECK(gap("lagrange:order=2", [](Real x) { return x < 0.5L ? 1 - x * x : (1 - x) * (2 - x) / 2; }) < kRounding);
    CHECK(gap("lagrange:order=1", [](Real x) { return 1 - x; }) < kRounding);
    CHECK(gap("o-moms", [](Real x) {
            return x < 1 ? ((x / 2 - 1) * x + 1.0L / 14) * x + 13.0L / 21
                         : ((-x / 6 + 1) * x - 85.0L / 42) * x + 29.0L / 21;
          }) < kRounding);
    CHECK(gap("cubic-spline:lobes=2", [](Real x) {
            const Real s = x - std::floor(x);
            return x < 1 ? ((s - 9 / 5.0L) * s - 1 / 5.0L) * s + 1 : ((-s / 3 + 4 / 5.0L) * s - 7 / 15.0L) * s;
          }) < kRounding);
    CHECK(gap("cubic-spline:lobes=3", [](Real x) {
            const Real s = x - std::floor(x);
            if (x < 1) return ((13 / 11.0L * s - 453 / 209.0L) * s - 3 / 209.0L) * s + 1;
            if (x < 2) return ((-6 / 11.0L * s + 270 / 209.0L) * s - 156 / 209.0L) * s;
            return ((1 / 11.0L * s - 45 / 209.0L) * s + 26 / 209.0L) * s;
          }) < kRounding);
    CHECK(gap("cubic-spline:lobes=4", [](Real x) {
            const Real s = x - std::floor(x);
            if (x < 1) return ((49 / 41.0L * s - 6387 / 2911.0L) * s - 3 / 2911.0L) * s + 1;
            if (x < 2) return ((-24 / 41.0L * s + 4032 / 2911.0L) * s - 2328 / 2911.0L) * s;
            if (x < 3) return ((6 / 41.0L * s - 1008 / 2911.0L) * s + 582 / 2911.0L) * s;
            return ((-1 / 41.0L * s + 168 / 2911.0L) * s - 97 / 2911.0L) * s;
          }) < kRounding);
    CHECK(gap("magic-kernel-sharp:version=2013", [](Real x) {
            if (x < 0.5L) return 17 / 16.0L - 7 / 4.0L * x * x;
            if (x < 1.5L) return (1 - x) * (7 / 4.0L - x);
            return -(2.5L - x) * (2.5L - x) / 8;
          }) < kRounding);
    CHECK(gap("magic-kernel-sharp", [](Real x) {
            if (x < 0.5L) return 577 / 576.0L - 239 / 144.0L * x * x;
            if (x < 1.5L) return 35 / 36.0L * (x - 1) * (x - 239 / 140.0L);
            if (x < 2.5L) return (x - 2) * (65 / 24.0L - x) / 6;
            if (x < 3.5L) return (x - 3) * (x - 15 / 4.0L) / 36;
            return -(x - 4.5L) * (x - 4.5L) / 288;
          }) < kRounding);
    // Parzen's window, up to its peak, times the sinc of radius 3.
    CHECK(gap("windowed-sinc:window=parzen", [](Real x) {
            const Real t = x / 3,
                       sinc = x == 0 ? 1 : std::sin(std::numbers::pi_v<Real> * x) / std::numbers::pi_v<Real> / x;
            return 2 / 3.0L * sinc * (t < 0.5L ? 1 - 6 * t * t * (1 - t) : 2 * (1 - t) * (1 - t) * (1 - t));
          }) < kRounding);
  }

  TEST_CASE("cubics have one definition under their several names") {
    const auto same = [](const std::string& a, const std::string& b) {
      CAPTURE(a);
      CHECK(gap(a, half(b).shape) < kRounding);
    };
    for (const std::string a : {"-0.5", "-0.75", "-1"}) same("keys:a=" + a, "mitchell:b=0,c=" + a.substr(1));
    same("catmull-rom", "keys");
    same("simon", "keys:a=-0.75");
    same("rifman", "keys:a=-1");
    same("hermite", "mitchell:b=0,c=0");
    same("bspline", "mitchell:b=1,c=0");
    same("notch", "mitchell:b=1.5,c=-0.25");
    same("windowed-sinc:window=kaiser,beta=0", "sinc:radius=3");
    same("lanczos", "pbrt-sinc:radius=3,tau=3");
  }

  TEST_CASE("Kaiser's window is that of the standard library's Bessel function") {
    for (const double beta : {0.5, 6.5, 20.0}) {
      const auto b = static_cast<Real>(beta);
      const auto window = [b](Real x) {
        const Real sinc = x == 0 ? 1 : std::sin(std::numbers::pi_v<Real> * x) / (std::numbers::pi_v<Real> * x);
        return sinc * std::cyl_bessel_il(0, b * std::sqrt(1 - x * x / 9)) / std::cyl_bessel_il(0, b);
      };
      CHECK(gap("windowed-sinc:window=kaiser,beta=" + shortest(beta), window) < 4 * kRounding);
    }
  }

  TEST_CASE("values of kernels are those of their definitions and masses those of far finer rules") {
    const Rule fine(32);
    for (const std::string& text : every_kernel()) {
      CAPTURE(text);
      const HalfKernel h = half(text);
      const Kernel k(text);
      REQUIRE(k.radius() == h.breaks.back());
      // Thirty-two nodes on an eighth of what the kernel's own rule spans.
      const auto integral = [&](Real a, Real b) {
        Real sum = 0;
        for (std::size_t i = 0; i + 1 < h.breaks.size(); ++i) {
          const Real lo = std::max(a, h.breaks[i]), hi = std::min(b, h.breaks[i + 1]);
          if (lo >= hi) continue;
          const int parts = static_cast<int>(std::ceil((hi - lo) * std::max(h.type, 1.0L) * 2));
          const Real length = (hi - lo) / static_cast<Real>(parts) / 2;
          for (int p = 0; p < parts; ++p)
            for (std::size_t n = 0; n < fine.x.size(); ++n)
              sum += length * fine.w[n] * h.shape(lo + length * (static_cast<Real>(2 * p + 1) + fine.x[n]));
        }
        return sum;
      };
      const Real r = k.radius(), whole = 2 * integral(0, r);
      Real peak = 0, worst_value = 0, worst_mass = 0;
      for (int i = 0; i < 200; ++i) {
        const Real x = r * static_cast<Real>(i) / 200;
        peak = std::max(peak, std::fabs(k(x)));
        worst_value = std::max(worst_value, std::fabs(k(x) - h.shape(x) / whole));
        if (i % 8 == 3)
          worst_mass =
              std::max(worst_mass, std::fabs(k.over(-r / 7, x) - (integral(0, r / 7) + integral(0, x)) / whole));
      }
      CHECK(worst_value < 1e-17L * peak);
      CHECK(worst_mass < 1e-17L);
    }
  }

  TEST_CASE("the gain is the integral of |k| wherever k changes its sign") {
    // Catmull-Rom: 1 + 4 times its outer lobe's area of 1/24. A box and a tent have no lobes.
    CHECK(std::fabs(Kernel("catmull-rom").gain() - 7 / 6.0L) < 1e-17L);
    CHECK(std::fabs(Kernel("box").gain() - 1) < 1e-18L);
    CHECK(std::fabs(Kernel("tent").gain() - 1) < 1e-18L);
    for (const std::string& text : every_kernel()) {
      CAPTURE(text);
      const Kernel k(text);
      // The midpoint rule is off by the kernel's total change of slope times h^2 / 24, kinks at zeros included, and by
      // a cell at each jump; 1e-3 of the gain is far above that and far below what one missed lobe would leave.
      constexpr int kCells = 40000;
      Real sum = 0;
      for (int i = 0; i < kCells; ++i)
        sum += std::fabs(k(k.radius() * (static_cast<Real>(i) + 0.5L) / kCells)) * 2 * k.radius() / kCells;
      CHECK(std::fabs(sum / k.gain() - 1) < 1e-3L);
    }
  }

  TEST_CASE("a kernel of one's own is integrated like the others") {
    // A house: straight walls of height 1 up to 1/2, then a roof down to 0 at 3/2. Its integral is 2.
    const Kernel house(HalfKernel{{0, 0.5L, 1.5L}, [](Real x) { return x < 0.5L ? 1 : 1.5L - x; }, 1});
    CHECK(house.radius() == 1.5L);
    CHECK(std::fabs(house(0) - 0.5L) < 1e-19L);
    CHECK(std::fabs(house.over(-0.25L, 1.5L) - 0.625L) < 1e-18L);
    CHECK(std::fabs(house.gain() - 1) < 1e-18L);
  }
}

}  // namespace moire::oracle
