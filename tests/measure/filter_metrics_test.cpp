// Filter metrics against closed forms, printed tables, and kernels that are not even.
#include "measure/filter_metrics.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/dd_math.h"
#include "filters/filter.h"

namespace moire {
namespace {

using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

FilterMetrics metrics_of(const std::string& text) { return filter_metrics(Filter(parse_spec(text, "test")).kernel()); }

double distance(double got, Real want) { return static_cast<double>(std::fabs(static_cast<Real>(got) - want)); }

// A kernel given by hand. `shape` is that of the piece between knots; polynomials of `degree`.
Kernel polynomial_kernel(std::vector<double> knots, int degree, std::function<Dd(int, Dd)> shape) {
  KernelShape s;
  s.knots = std::move(knots);
  s.degree = degree;
  s.shape = std::move(shape);
  s.ellipse_bound = [](int, double) { return 0.0; };
  return Kernel(s);
}

// Mitchell's kernel, its middle at `shift` (a multiple of 1/4, so that knots stay exact), in a support that is even.
Kernel shifted_mitchell(double shift) {
  const double radius = 2 + std::fabs(shift);
  std::vector<double> knots{-radius};
  for (int i = -2; i <= 2; ++i) {
    if (i + shift > -radius && i + shift < radius) knots.push_back(i + shift);
  }
  knots.push_back(radius);
  return polynomial_kernel(knots, 3, [shift, knots](int piece, Dd x) {
    const auto i = static_cast<std::size_t>(piece);
    const double middle = 0.5 * (knots[i] + knots[i + 1]) - shift;
    const Dd t = dd_abs(x - Dd(shift));
    if (std::fabs(middle) > 2) return Dd(0.0);
    if (std::fabs(middle) > 1) return ((Dd(-7.0) * t + Dd(36.0)) * t - Dd(60.0)) * t + Dd(32.0);
    return (Dd(21.0) * t - Dd(36.0)) * t * t + Dd(16.0);
  });
}

// What filter_metrics.h promises.
constexpr double kPromised = 1e-13;

TEST_SUITE("unit") {
  // Some tables in circulation print the band integrals (smoothing, postaliasing, edge) of these filters a unit or more
  // of the last digit lower, as from integrals over f that were cut short (box .400, .400 and 9.6e-3); these digits are
  // those of filter_metrics_brute_test.cpp, which integrates in f and bounds what it leaves out, and of the closed form
  // for the box.
  TEST_CASE("the metrics of well-known filters, to three digits") {
    struct Printed {
      std::string text;
      // Decimals as written say how far they reach: half a unit of the last digit.
      std::string integral, ripple, variance, noise, l1, overshoot, nyquist, smoothing, postaliasing, edge;
    };
    const Printed table[] = {
        {"box", "1", "0", ".0833", "1", "1", "0", ".637", ".401", ".401", "9.7e-3"},
        {"tent", "1", "0", ".167", ".667", "1", "0", ".405", ".599", ".043", "2.5e-3"},
        {"bspline", "1", "0", ".333", ".479", "1", "0", ".164", ".773", ".003", "2.5e-4"},
        {"mitchell", "1", "0", ".111", ".681", "1.070", "1.75", ".383", ".565", ".029", "1.8e-3"},
        {"catmull-rom", "1", "0", "0", ".814", "1.167", "4.17", ".493", ".398", ".061", "3.1e-3"},
        {"lanczos", ".99706", "3e-3", "0", ".894", "1.358", "7.31", ".502", ".247", ".045", "2.2e-3"},
        {"windowed-sinc:window=kaiser", ".99943", "7e-4", "-.0085", ".853", "1.260", "5.8", ".500", ".325", ".053",
         "2.7e-3"},
        {"blackman-harris", "1.435", "0", ".307", ".501", "1", "0", ".197", ".754", ".005", "4.0e-4"},
        {"gaussian", "1.2166", "2.1e-2", ".229", ".580", "1", "0", ".305", ".682", ".018", "1.3e-3"},
        {"notch", "1", "0", ".5", ".383", "1", "0", "0.000", ".853", "4e-4", "3.4e-5"},
    };
    // The digits' last place is printed by rounding: half a unit, and a hair for a tie in binary.
    const auto agrees = [](double value, const std::string& printed) {
      const std::size_t exponent = std::min(printed.find('e'), printed.size()), point = printed.find('.');
      const double decimals = point == std::string::npos ? 0 : static_cast<double>(exponent - point - 1);
      const double power = exponent == printed.size() ? 0 : std::stod(printed.substr(exponent + 1));
      // A plain 0 or 1 is meant to be exact.
      const double unit = point == std::string::npos && power == 0 ? 1e-13 : 0.5001 * std::pow(10.0, power - decimals);
      return std::fabs(value - std::stod(printed)) <= unit;
    };
    for (const Printed& row : table) {
      CAPTURE(row.text);
      const FilterMetrics m = metrics_of(row.text);
      CHECK(agrees(m.integral, row.integral));
      CHECK(agrees(m.ripple, row.ripple));
      CHECK(agrees(m.variance, row.variance));
      CHECK(agrees(m.noise_gain_1d, row.noise));
      CHECK(agrees(m.l1_gain, row.l1));
      CHECK(agrees(m.overshoot_percent, row.overshoot));
      CHECK(agrees(m.nyquist_response, row.nyquist));
      CHECK(agrees(m.smoothing, row.smoothing));
      CHECK(agrees(m.postaliasing, row.postaliasing));
      CHECK(agrees(m.edge_alias_energy, row.edge));
    }
  }

  TEST_CASE("the filters that systems call gaussian differ as they are known to") {
    struct Printed {
      std::string preset;
      double variance, nyquist, ripple, unit;  // of the last digit of variance
    };
    for (const Printed& row :
         {Printed{"oiio", .435, .040, 3.2e-2, 1e-3}, Printed{"mitsuba", .2486, .291, 1.4e-2, 1e-4},
          Printed{"imagemagick", .2497, .291, 1.4e-2, 1e-4}, Printed{"ospray", .243, .291, 2.1e-2, 1e-3},
          Printed{"pbrt", .2295, .305, 2.1e-2, 1e-4}, Printed{"renderman", .193, .341, 5.1e-2, 1e-3},
          Printed{"cycles", .141, .500, .125, 1e-3}, Printed{"oiio-sharp", .120, .546, .166, 1e-3}}) {
      CAPTURE(row.preset);
      const FilterMetrics m = metrics_of("gaussian:preset=" + row.preset);
      CHECK(std::fabs(m.variance - row.variance) <= 0.501 * row.unit);
      CHECK(std::fabs(m.nyquist_response - row.nyquist) <= 0.501e-3);
      CHECK(std::fabs(m.ripple - row.ripple) <= 0.501e-3);
    }
  }

  TEST_CASE("the box has closed forms for everything") {
    const FilterMetrics m = metrics_of("box");
    const double pi = std::numbers::pi, si_pi = 1.8519370519824661703;  // the sine integral at pi
    const double band = 2 / pi * (si_pi - 2 / pi);                      // integral of sinc^2 over [-1/2, 1/2]
    CHECK(distance(m.variance, 1.0L / 12) < kPromised);
    CHECK(distance(m.nyquist_response, 2 / kPi) < kPromised);
    CHECK(m.noise_gain == doctest::Approx(1).epsilon(kPromised));
    CHECK(m.ripple < kPromised);
    CHECK(m.smoothing == doctest::Approx(1 - band * band).epsilon(kPromised));
    CHECK(m.postaliasing == doctest::Approx(1 - band * band).epsilon(kPromised));
    // By parts: integral over u > pi / 2 of sin^2 u / u^4 is 8 / (3 pi^3) - 2 / (3 pi) - 2 / 3 (pi / 2 - Si(pi)).
    const double edge = (8 / (3 * pi * pi * pi) - 2 / (3 * pi) - 2.0 / 3 * (pi / 2 - si_pi)) / (2 * pi);
    CHECK(m.edge_alias_energy == doctest::Approx(edge).epsilon(kPromised / edge));
    // H falls from 2 / pi on the axis to sinc^2(sqrt(1/8)) on the diagonal, or rises.
    const double s = pi * std::sqrt(0.125), diagonal = std::sin(s) / s * std::sin(s) / s;
    CHECK(m.anisotropy == doctest::Approx(std::fabs(diagonal - 2 / pi)).epsilon(1e-12));
    // Twice as wide: four times the variance, half the noise, and a response of 0 at Nyquist.
    const FilterMetrics wide = metrics_of("box:width=2");
    CHECK(distance(wide.variance, 4.0L / 12) < kPromised);
    CHECK(distance(wide.noise_gain_1d, 0.5L) < kPromised);
    CHECK(std::fabs(wide.nyquist_response) < kPromised);
    // Half a pixel wide: a flat field loses every second phase, and counts the others twice.
    CHECK(metrics_of("box:width=0.5").ripple == doctest::Approx(1).epsilon(kPromised));
  }

  TEST_CASE("B-splines are powers of the box: variance, response and noise gain follow from their order") {
    // Integral of the square: the middle value of the B-spline of degree 2 n + 1.
    constexpr Real kNoise[] = {1, 2.0L / 3, 11.0L / 20, 151.0L / 315, 15619.0L / 36288, 655177.0L / 1663200};
    for (int n = 0; n <= 5; ++n) {
      CAPTURE(n);
      const FilterMetrics m = metrics_of("bspline:order=" + std::to_string(n));
      CHECK(distance(m.variance, (static_cast<Real>(n) + 1) / 12) < kPromised);
      CHECK(distance(m.nyquist_response, std::pow(2 / kPi, static_cast<Real>(n) + 1)) < kPromised);
      CHECK(distance(m.noise_gain_1d, kNoise[n]) < kPromised);
      CHECK(m.ripple < kPromised);
      CHECK(std::fabs(m.l1_gain - 1) < kPromised);
      CHECK(m.overshoot_percent < 100 * kPromised);
    }
  }

  TEST_CASE("every BC cubic is a partition of unity, and where b + 2 c = 1 its variance is b / 3") {
    // The line that Mitchell and Netravali recommend runs from the cubic B-spline to Catmull-Rom's kernel.
    for (const double b : {0.0, 0.25, 0.5, 1.0, 1.5}) {
      for (const double c : {-0.25, 0.0, 0.25, 0.375, 0.5}) {
        CAPTURE(b);
        CAPTURE(c);
        const FilterMetrics m = metrics_of("mitchell:b=" + std::to_string(b) + ",c=" + std::to_string(c));
        CHECK(m.ripple < kPromised);
        CHECK(std::fabs(m.integral - 1) < kPromised);
        if (b + 2 * c == 1) CHECK(std::fabs(m.variance - b / 3) < kPromised);
      }
    }
    // Catmull-Rom's negative lobe is 1/24 of its integral.
    const FilterMetrics rom = metrics_of("catmull-rom");
    CHECK(distance(rom.overshoot_percent, 100.0L / 24) < 100 * kPromised);
    CHECK(distance(rom.l1_gain, 7.0L / 6) < kPromised);
  }

  TEST_CASE("a Gaussian that is not cut in earnest is as round as numbers get") {
    // Cut at 10 sigma: exp(-50) is nothing; what is left is rounding.
    const FilterMetrics m = metrics_of("gaussian:sigma=0.25,radius=2.5,cut=cut");
    CHECK(m.anisotropy < kPromised);
    CHECK(std::fabs(m.variance - 0.0625) < kPromised);
    // Poisson's sum at its worst phase: 2 exp(-2 pi^2 sigma^2 n^2) over n >= 1; the term of n = 7 is 1e-26.
    Real ripple = 0;
    for (int n = 1; n <= 7; ++n) ripple += 2 * std::exp(-2 * kPi * kPi * 0.0625L * static_cast<Real>(n * n));
    CHECK(distance(m.ripple, ripple) < kPromised);
  }

  TEST_CASE("a kernel in one long piece of high degree is measured as well as one in short pieces") {
    KernelShape s;
    s.knots = {-1.5, 1.5};
    s.shape = [](int, Dd x) { return dd_exp(Dd(-8.0) * x * x); };
    // |exp(-8 z^2)| <= exp(8 y^2), y the ellipse's height above a piece of half length 3/2.
    s.ellipse_bound = [](int, double rho) { return std::exp(8 * std::pow(0.75 * (rho - 1 / rho), 2)); };
    const Kernel long_piece(s);
    CHECK(long_piece.degree() > 30);
    const FilterMetrics one = filter_metrics(long_piece), many = metrics_of("gaussian:sigma=0.25,radius=1.5,cut=cut");
    for (const auto field :
         {&FilterMetrics::integral, &FilterMetrics::ripple, &FilterMetrics::variance, &FilterMetrics::nyquist_response,
          &FilterMetrics::l1_gain, &FilterMetrics::smoothing, &FilterMetrics::postaliasing, &FilterMetrics::noise_gain,
          &FilterMetrics::edge_alias_energy, &FilterMetrics::anisotropy}) {
      CHECK(std::fabs(one.*field - many.*field) < 2 * kPromised + 4 * long_piece.k_error());
    }
  }

  TEST_CASE("a shift changes the mean and nothing else") {
    const FilterMetrics even = metrics_of("mitchell");
    for (const double shift : {0.25, -0.5, 1.0, -3.75}) {
      CAPTURE(shift);
      const FilterMetrics m = filter_metrics(shifted_mitchell(shift));
      CHECK(m.radius == 2 + std::fabs(shift));
      CHECK(std::fabs(m.mean - shift) < kPromised);
      CHECK(m.ripple < kPromised);
      for (const auto field :
           {&FilterMetrics::variance, &FilterMetrics::nyquist_response, &FilterMetrics::l1_gain,
            &FilterMetrics::smoothing, &FilterMetrics::postaliasing, &FilterMetrics::noise_gain_1d,
            &FilterMetrics::noise_gain, &FilterMetrics::edge_alias_energy, &FilterMetrics::anisotropy}) {
        CHECK(std::fabs(m.*field - even.*field) < kPromised);
      }
      CHECK(std::fabs(m.overshoot_percent - even.overshoot_percent) < 100 * kPromised);
    }
  }

  TEST_CASE("a lopsided kernel overshoots as much as its mirror image, and both have the closed forms of a ramp") {
    // (1 + x) / 2 on [-1, 1]: mean 1/3, variance 1/3 - 1/9, square 2/3, and a flat field becomes phi + 1/2.
    const auto ramp = [](double sign) {
      return filter_metrics(polynomial_kernel({-1, 1}, 1, [sign](int, Dd x) { return Dd(1.0) + Dd(sign) * x; }));
    };
    const FilterMetrics up = ramp(1), down = ramp(-1);
    CHECK(distance(up.mean, 1.0L / 3) < kPromised);
    CHECK(distance(down.mean, -1.0L / 3) < kPromised);
    CHECK(distance(up.variance, 2.0L / 9) < kPromised);
    CHECK(distance(up.noise_gain_1d, 2.0L / 3) < kPromised);
    CHECK(distance(up.ripple, 0.5L) < kPromised);
    // 1 + 4 x^3 goes below zero at one end only: K leaves [0, 1] below, its mirror image above.
    const auto cubic = [](double sign) {
      return filter_metrics(
          polynomial_kernel({-1, 1}, 3, [sign](int, Dd x) { return Dd(1.0) + Dd(4 * sign) * x * x * x; }));
    };
    const FilterMetrics left = cubic(-1), right = cubic(1);
    CHECK(left.overshoot_percent > 1);
    for (const auto field : {&FilterMetrics::ripple, &FilterMetrics::variance, &FilterMetrics::nyquist_response,
                             &FilterMetrics::l1_gain, &FilterMetrics::smoothing, &FilterMetrics::postaliasing,
                             &FilterMetrics::edge_alias_energy, &FilterMetrics::anisotropy}) {
      CHECK(std::fabs(left.*field - right.*field) < kPromised);
    }
    CHECK(std::fabs(left.overshoot_percent - right.overshoot_percent) < 100 * kPromised);
  }
}

}  // namespace
}  // namespace moire
