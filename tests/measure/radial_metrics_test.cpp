// Metrics of radial filters against closed forms, and over the whole catalogue against brute force in long double that
// knows the kernels' formulas only (tests/oracle) and takes other ways: rings, and the library's Bessel function.
#include "measure/radial_metrics.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "filter_list.h"
#include "filters/filter.h"
#include "measure/radial_projection.h"
#include "measure/radial_ripple.h"
#include "oracle/rings.h"

namespace moire {
namespace {

using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

// What radial_metrics.h promises; times the noise gain where that is above 1.
constexpr double kPromised = 1e-13;

double distance(double got, Real want) { return static_cast<double>(std::fabs(static_cast<Real>(got) - want)); }
Filter filter_of(const std::string& text) { return Filter(parse_spec(text, "test")); }
FilterMetrics metrics_of(const std::string& text) { return filter_metrics(filter_of(text).radial_kernel()); }

// The metrics of a radial kernel from its values alone.
class Brute {
 public:
  explicit Brute(const std::string& text) : kernel_(text) {
    const oracle::Rule rule(40);
    for (std::size_t p = 0; p + 1 < kernel_.breaks().size(); ++p) {
      const Real a = kernel_.breaks()[p], half = (kernel_.breaks()[p + 1] - a) / (2 * kParts);
      for (int part = 0; part < kParts; ++part) {
        for (std::size_t i = 0; i < rule.x.size(); ++i) {
          const Real r = a + half * (static_cast<Real>(2 * part + 1) + rule.x[i]);
          r_.push_back(r);
          mass_.push_back(2 * kPi * half * rule.w[i] * r * kernel_(r));
        }
      }
    }
    for (int i = 0; i <= kTerms; ++i) chebyshev_.push_back(hankel(place(i)));
  }

  const oracle::RingKernel& kernel() const { return kernel_; }
  Real moment(int power) const {
    Real sum = 0;
    for (std::size_t i = 0; i < r_.size(); ++i) sum += mass_[i] * std::pow(r_[i], static_cast<Real>(power));
    return sum;
  }
  Real square() const {
    Real sum = 0;
    for (std::size_t i = 0; i < r_.size(); ++i) sum += mass_[i] * kernel_(r_[i]);
    return sum;
  }
  Real hankel(Real f) const {
    Real sum = 0;
    for (std::size_t i = 0; i < r_.size(); ++i) sum += mass_[i] * std::cyl_bessel_j(0.0L, 2 * kPi * f * r_[i]);
    return sum;
  }
  // The same for 0 <= f <= kEnd from its values at Chebyshev points of the second kind (the barycentric formula).
  Real H(Real f) const {
    Real above = 0, below = 0;
    for (int i = 0; i <= kTerms; ++i) {
      const Real gap = f - place(i);
      if (gap == 0) return chebyshev_[static_cast<std::size_t>(i)];
      const Real w = (i % 2 == 0 ? 1 : -1) * (i == 0 || i == kTerms ? 0.5L : 1.0L) / gap;
      above += w * chebyshev_[static_cast<std::size_t>(i)];
      below += w;
    }
    return above / below;
  }
  Real band_power() const {
    const oracle::Rule rule(40);
    Real sum = 0;
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) sum += 2 * rule.w[i] * rule.w[j] * power(rule.x[i], rule.x[j]);
      sum += rule.w[i] * rule.w[i] * power(rule.x[i], rule.x[i]);
    }
    return sum / 4;  // four quarters, each an integral over [-1, 1]^2 scaled by 1/16
  }
  Real lost_edge() const {
    const oracle::Rule rule(40);
    Real sum = 0;
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      const Real f = (1 + rule.x[i]) / 4, h = H(f);
      sum += rule.w[i] / 4 * 2 * (1 - h * h) / (4 * kPi * kPi * f * f);
    }
    return sum;
  }
  // What an edge at distance x cuts off: of the ring of radius r the share acos(x / r) / pi.
  Real beyond(Real x) const {
    static const oracle::RulePair rules = {oracle::Rule(20), oracle::Rule(28)};
    Real sum = 0;
    for (std::size_t p = 0; p + 1 < kernel_.breaks().size(); ++p) {
      const Real a = std::max(kernel_.breaks()[p], x), b = kernel_.breaks()[p + 1];
      if (b <= a) continue;
      sum += oracle::integrate<Real>(
                 rules,
                 [&](Real s) {
                   const Real r = a + (b - a) * s * s;
                   return 2 * kernel_(r) * r * std::acos(std::min(x / r, 1.0L)) * 2 * (b - a) * s;
                 },
                 0.0L, 1.0L)
                 .value;
    }
    return sum;
  }
  // Of |k| over the plane.
  Real gain() const {
    static const oracle::RulePair rules = {oracle::Rule(20), oracle::Rule(28)};
    Real sum = 0;
    for (std::size_t p = 0; p + 1 < kernel_.breaks().size(); ++p) {
      const Real a = kernel_.breaks()[p], length = (kernel_.breaks()[p + 1] - a) / kParts;
      for (int part = 0; part < kParts; ++part) {
        const Real from = a + length * static_cast<Real>(part);
        const auto ring = [&](Real r) { return 2 * kPi * r * std::fabs(kernel_(r)); };
        sum += oracle::integrate<Real>(rules, ring, from, from + length).value;
      }
    }
    return sum;
  }
  // Of beyond (1 - beyond), by the tanh-sinh rule between breaks, which takes whatever the ends are like: at step 1/8
  // and over half a pixel and less its error is far below what is promised.
  Real spread() const {
    Real sum = 0;
    for (std::size_t p = 0; p + 1 < kernel_.breaks().size(); ++p) {
      const Real whole = kernel_.breaks()[p + 1] - kernel_.breaks()[p];
      const int parts = static_cast<int>(std::ceil(2 * whole));
      const Real length = whole / static_cast<Real>(parts);
      for (int part = 0; part < parts; ++part) {
        const Real a = kernel_.breaks()[p] + length * static_cast<Real>(part);
        for (int i = -28; i <= 28; ++i) {
          const Real t = static_cast<Real>(i) / 8, u = kPi / 2 * std::sinh(t), share = 1 / (1 + std::exp(-2 * u));
          const Real weight = kPi / 16 * std::cosh(t) / (std::cosh(u) * std::cosh(u)) / 2;
          const Real x = a + length * share;
          if (x <= a || x >= a + length) continue;
          const Real out = beyond(x);
          sum += 2 * length * weight * out * (1 - out);
        }
      }
    }
    return sum;
  }
  // The best of many places and, between its neighbours, by a search in ever smaller steps.
  Real overshoot() const {
    const Real R = kernel_.radius();
    constexpr int kPlaces = 48;
    Real best = 0, at = 0;
    for (int i = 1; i < kPlaces; ++i) {
      const Real x = R * static_cast<Real>(i) / kPlaces, here = -beyond(x);
      if (here > best) best = here, at = x;
    }
    if (best == 0) return 0;
    for (Real step = R / kPlaces; step > 1e-8L * R;) {
      const Real left = -beyond(at - step), right = at + step < R ? -beyond(at + step) : 0;
      if (std::max(left, right) > best) {
        at += left > right ? -step : step;
        best = std::max(left, right);
      } else {
        step /= 2;
      }
    }
    return best;
  }
  Real ripple_at(Real x, Real y) const {
    Real sum = -1;
    const Real R = kernel_.radius();
    const int reach = static_cast<int>(std::ceil(R)) + 1;
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        const Real r = std::hypot(x + static_cast<Real>(i), y + static_cast<Real>(j));
        if (r < R) sum += kernel_(r);
      }
    }
    return std::fabs(sum);
  }
  // The largest of a fine grid over an eighth of the pixel; from it uphill in steps that shrink, in directions that
  // turn, so that one of them leads along the circles where the sum bends.
  Real ripple(int places) const {
    struct Place {
      Real value, x, y;
    };
    std::vector<Place> found;
    for (int i = 0; i <= places; ++i) {
      for (int j = 0; j <= i; ++j) {
        const Real x = static_cast<Real>(i) / (2 * static_cast<Real>(places));
        const Real y = static_cast<Real>(j) / (2 * static_cast<Real>(places));
        found.push_back({ripple_at(x, y), x, y});
      }
    }
    std::sort(found.begin(), found.end(), [](const Place& a, const Place& b) { return a.value > b.value; });
    Place best = found.front();
    Real turned = 0;
    for (Real step = 0.5L / static_cast<Real>(places); step > 1e-14L;) {
      const Place here = best;
      for (int i = 0; i < 40; ++i) {
        const Real angle = turned + kPi * static_cast<Real>(i) / 20;
        const Real x = here.x + step * std::cos(angle), y = here.y + step * std::sin(angle);
        const Real value = ripple_at(x, y);
        if (value > best.value) best = {value, x, y};
      }
      turned += 1;
      if (best.value == here.value) step *= 0.8L;
    }
    return best.value;
  }

 private:
  static constexpr int kParts = 4, kTerms = 72;
  static constexpr Real kEnd = 0.7072L;  // beyond the corner of the Nyquist square

  static Real place(int i) { return kEnd / 2 * (1 + std::cos(kPi * static_cast<Real>(i) / static_cast<Real>(kTerms))); }
  Real power(Real x, Real y) const {
    const Real h = H(std::hypot(1 + x, 1 + y) / 4);
    return h * h;
  }

  oracle::RingKernel kernel_;
  std::vector<Real> r_, mass_, chebyshev_;
};

bool has_jumps(const RadialKernel& kernel) { return kernel.jump_max() > 1e-12 * kernel.k_max(); }

TEST_SUITE("unit") {
  TEST_CASE("a disk's metrics are those of its closed forms") {
    for (const double R : {0.0625, 0.5, 1.25, 4.0, 16.0}) {
      CAPTURE(R);
      const FilterMetrics m = metrics_of("disk:radius=" + shortest(R));
      const auto r = static_cast<Real>(R);
      const auto H = [r](Real f) { return 2 * std::cyl_bessel_j(1.0L, 2 * kPi * f * r) / (2 * kPi * f * r); };
      const Real noise = 1 / (kPi * r * r);
      const double share = std::max(1.0, static_cast<double>(noise)) * kPromised;
      CHECK(m.radius == R);
      CHECK(m.mean == 0);
      CHECK(m.anisotropy == 0);
      CHECK(m.overshoot_percent == 0);
      // Relative to a number that grows as the radius squared.
      CHECK(distance(m.integral, kPi * r * r) < kPromised * std::max(1.0, R * R));
      CHECK(distance(m.variance, r * r / 4) < kPromised * std::max(1.0, R * R));
      CHECK(distance(m.l1_gain, 1) < kPromised);
      CHECK(distance(m.noise_gain, noise) < share);
      CHECK(distance(m.noise_gain_1d, std::sqrt(noise)) < share);
      CHECK(distance(m.nyquist_response, H(0.5L)) < kPromised);
      // The spread, integral of beyond (1 - beyond), is the mean distance of two points of the disk, 128 R / 45 pi,
      // over pi: the projected distance of a pair is 2 / pi of it, and half of that the spread.
      CHECK(distance(RadialProjection(filter_of("disk:radius=" + shortest(R)).radial_kernel()).spread(),
                     128 * r / (45 * kPi * kPi)) < kPromised * std::max(1.0, R));
    }
    // The circle of radius 1/2 leaves corners to no pixel, and holds one centre elsewhere.
    CHECK(metrics_of("disk").ripple == 1);
  }

  TEST_CASE("a disk's ripple is that of the fewest or the most pixel centres that it can hold") {
    // Counted on a grid of 1/512 pixel, off its circles: the closed forms pi r^2 of circle and lattice.
    for (const double R : {0.0625, 0.5, 0.7, 0.75, 1.0, 1.25, 1.5, 2.3, 3.75}) {
      CAPTURE(R);
      int fewest = 1 << 30, most = 0;
      for (int i = 0; i <= 256; ++i) {
        for (int j = 0; j <= i; ++j) {
          const double x = (i + 0.31) / 512, y = (j + 0.17) / 512;
          int held = 0;
          for (int a = -6; a <= 6; ++a) {
            for (int b = -6; b <= 6; ++b) held += std::hypot(x + a, y + b) < R;
          }
          fewest = std::min(fewest, held);
          most = std::max(most, held);
        }
      }
      const double area = std::numbers::pi * R * R;
      const double want = std::max(std::fabs(fewest / area - 1), std::fabs(most / area - 1));
      const double got = radial_ripple(filter_of("disk:radius=" + shortest(R)).radial_kernel());
      CHECK(std::fabs(got - want) < kPromised * std::max(1.0, 1 / area));
    }
  }

  TEST_CASE("a cone's metrics are those of its closed forms") {
    for (const double R : {0.25, 1.0, 2.5}) {
      CAPTURE(R);
      const FilterMetrics m = metrics_of("cone:radius=" + shortest(R));
      const auto r = static_cast<Real>(R);
      // k = 3 (1 - s / R) / (pi R^2); integral of k^2 2 pi s ds = 9 / (pi^2 R^4) 2 pi R^2 / 12.
      const Real noise = 3 / (2 * kPi * r * r);
      CHECK(distance(m.integral, kPi * r * r * r / 3) < kPromised);
      CHECK(distance(m.variance, 3 * r * r / 20) < kPromised);
      CHECK(distance(m.noise_gain, noise) < std::max(1.0, static_cast<double>(noise)) * kPromised);
      CHECK(distance(m.l1_gain, 1) < kPromised);
      // P(0) = 3 / (pi R).
      const Filter filter = filter_of("cone:radius=" + shortest(R));
      CHECK(distance(RadialProjection(filter.radial_kernel()).P(1e-9 * R), 3 / (kPi * r)) < kPromised / R);
    }
  }

  TEST_CASE("a radial Gaussian that is cut far out is the separable one") {
    // Beyond 9 sigma lies exp(-40.5) = 3e-18 of it.
    const FilterMetrics radial = metrics_of("radial-gaussian:sigma=0.5,radius=4.5,cut=cut");
    const FilterMetrics separable = filter_metrics(filter_of("gaussian:sigma=0.5,radius=4.5,cut=cut").kernel());
    for (const auto field :
         {&FilterMetrics::variance, &FilterMetrics::nyquist_response, &FilterMetrics::l1_gain,
          &FilterMetrics::overshoot_percent, &FilterMetrics::smoothing, &FilterMetrics::postaliasing,
          &FilterMetrics::noise_gain_1d, &FilterMetrics::noise_gain, &FilterMetrics::edge_alias_energy}) {
      CHECK(std::fabs(radial.*field - separable.*field) < kPromised);
    }
    // In the plane a flat field is the product of two.
    const double sum = 1 + separable.ripple;
    CHECK(std::fabs(radial.ripple - (sum * sum - 1)) < kPromised);
    // As they stand, shapes have the value 1 at the centre: the integral over the plane is the square of that over an
    // axis.
    CHECK(std::fabs(radial.integral - separable.integral * separable.integral) < kPromised);
  }

  TEST_CASE("the edge alias energy lies between a partial sum of its definition and that with a bound on the rest") {
    for (const char* text : {"disk", "disk:radius=1.25", "cone", "cone:radius=2", "radial-gaussian"}) {
      CAPTURE(text);
      const Brute brute(text);
      const oracle::Rule rule(40);
      constexpr int kFar = 8;
      Real near = 0;
      for (int part = 1; part < 2 * kFar; ++part) {
        for (std::size_t i = 0; i < rule.x.size(); ++i) {
          const Real f = (static_cast<Real>(2 * part + 1) + rule.x[i]) / 4, h = brute.hankel(f);
          near += rule.w[i] / 4 * 2 * h * h / (4 * kPi * kPi * f * f);
        }
      }
      // P falls from its middle to either side: |H| <= 2 P(0) / (2 pi f).
      Real middle = 0;
      for (std::size_t p = 0; p + 1 < brute.kernel().breaks().size(); ++p) {
        const Real a = brute.kernel().breaks()[p], half = (brute.kernel().breaks()[p + 1] - a) / 2;
        for (std::size_t i = 0; i < rule.x.size(); ++i) {
          middle += 2 * half * rule.w[i] * brute.kernel()(a + half * (1 + rule.x[i]));
        }
      }
      const Real v = middle / kPi, rest = 2 * v * v / (4 * kPi * kPi * 3 * std::pow(static_cast<Real>(kFar), 3.0L));
      const double got = metrics_of(text).edge_alias_energy;
      CHECK(static_cast<Real>(got) >= near - static_cast<Real>(kPromised));
      CHECK(static_cast<Real>(got) <= near + rest + static_cast<Real>(kPromised));
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("every radial filter's metrics agree with brute force in long double") {
    for (const std::string& text : test::radial_texts()) {
      CAPTURE(text);
      const Filter filter = filter_of(text);
      const FilterMetrics m = filter_metrics(filter.radial_kernel());
      const Brute brute(text);
      const Real noise = brute.square(), band = brute.band_power();
      const double share = std::max(1.0, static_cast<double>(noise)) * kPromised;
      CHECK(m.radius == filter.radius());
      CHECK(m.mean == 0);
      CHECK(m.anisotropy == 0);
      CHECK(distance(m.variance, brute.moment(2) / 2) < kPromised);
      CHECK(distance(m.nyquist_response, brute.hankel(0.5L)) < kPromised);
      CHECK(distance(m.l1_gain, brute.gain()) < kPromised);
      CHECK(distance(m.overshoot_percent, 100 * brute.overshoot()) < 100 * kPromised);
      CHECK(distance(m.noise_gain, noise) < share);
      CHECK(distance(m.noise_gain_1d, std::sqrt(noise)) < share);
      CHECK(distance(m.smoothing, 1 - band) < kPromised);
      CHECK(distance(m.postaliasing, noise - band) < share);
      const Real edge = 1 / (kPi * kPi) - brute.spread() + brute.lost_edge();
      CHECK(distance(m.edge_alias_energy, edge) < kPromised);
    }
  }

  TEST_CASE("every radial filter's ripple is the largest that a finer search finds") {
    for (const std::string& text : test::radial_texts()) {
      CAPTURE(text);
      const Filter filter = filter_of(text);
      const RadialKernel& kernel = filter.radial_kernel();
      const double got = radial_ripple(kernel);
      const auto found = static_cast<double>(Brute(text).ripple(100));
      const double share = std::max(1.0, kernel.k_max()) * kPromised;
      const double ahead = got - found;
      CAPTURE(ahead);
      CHECK(ahead >= -share);
      // One-sided limits at jumps a search over points comes near, to its last step or to a cell that it met nowhere;
      // without jumps it finds the same, as flat as it is there.
      if (!has_jumps(kernel)) CHECK(ahead <= share);
      if (has_jumps(kernel)) CHECK(ahead <= 1e-5);
    }
  }
}

}  // namespace
}  // namespace moire
