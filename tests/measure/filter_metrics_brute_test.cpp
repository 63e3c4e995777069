// Filter metrics over the whole catalogue against brute force in long double, which knows the kernels' formulas only
// (tests/oracle) and not their series.
#include "measure/filter_metrics.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "filters/filter.h"
#include "oracle/kernel.h"

namespace moire {
namespace {

using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

double distance(double got, Real want) { return static_cast<double>(std::fabs(static_cast<Real>(got) - want)); }

// The largest value of f, unimodal between low and high, by the golden section.
template <class F>
Real peak_between(const F& f, Real low, Real high) {
  const Real golden = (std::sqrt(5.0L) - 1) / 2;
  Real a = high - golden * (high - low), b = low + golden * (high - low), fa = f(a), fb = f(b);
  for (int step = 0; step < 80; ++step) {
    if (fa > fb) {
      high = b, b = a, fb = fa, a = high - golden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + golden * (high - low), fb = f(b);
    }
  }
  return std::max(fa, fb);
}

// The largest value of f on [low, high]: the best of n samples and its neighbourhood, ends included.
template <class F>
Real peak(const F& f, Real low, Real high, int n) {
  int best = 0;
  Real value = -HUGE_VALL;
  const auto at = [&](int i) {
    return i == n ? high : low + (high - low) * static_cast<Real>(i) / static_cast<Real>(n);
  };
  for (int i = 0; i <= n; ++i) {
    const Real here = f(at(i));
    if (here > value) value = here, best = i;
  }
  return std::max(value, peak_between(f, at(std::max(best - 1, 0)), at(std::min(best + 1, n))));
}

// The metrics of an even kernel from its values alone.
class Brute {
 public:
  explicit Brute(const std::string& text) : kernel_(text) {
    const oracle::Rule rule(28);
    for (std::size_t i = 0; i + 1 < kernel_.knots().size(); ++i) {
      const Real a = std::max(kernel_.knots()[i], 0.0L), b = kernel_.knots()[i + 1];
      if (b <= a) continue;
      // Half a pixel and shorter: at f = 8 a wave turns by 4 pi to each side, for which 28 nodes are good to 1e-19.
      const int parts = static_cast<int>(std::ceil(2 * (b - a)));
      const Real half = (b - a) / static_cast<Real>(2 * parts);
      for (int p = 0; p < parts; ++p) {
        const Real mid = a + half * static_cast<Real>(2 * p + 1);
        for (std::size_t n = 0; n < rule.x.size(); ++n) {
          const Real x = mid + half * rule.x[n];
          x_.push_back(x);
          mass_.push_back(2 * half * rule.w[n] * kernel_(x));
        }
      }
    }
  }

  const oracle::Kernel& kernel() const { return kernel_; }
  Real moment(int power) const {
    Real sum = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) sum += mass_[i] * std::pow(x_[i], static_cast<Real>(power));
    return sum;
  }
  Real square() const {
    Real sum = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) sum += mass_[i] * kernel_(x_[i]);
    return sum;
  }
  Real response(Real f) const {
    Real sum = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) sum += mass_[i] * std::cos(2 * kPi * f * x_[i]);
    return sum;
  }
  // Integral over [from, to] of g(f, H(f)).
  template <class G>
  Real over_band(Real from, Real to, const G& g) const {
    static const oracle::Rule rule(40);
    const int parts = static_cast<int>(std::ceil(2 * (to - from) * std::max(1.0L, kernel_.radius() / 4)));
    const Real half = (to - from) / static_cast<Real>(2 * parts);
    Real sum = 0;
    for (int p = 0; p < parts; ++p) {
      for (std::size_t n = 0; n < rule.x.size(); ++n) {
        const Real f = from + half * (static_cast<Real>(2 * p + 1) + rule.x[n]);
        sum += half * rule.w[n] * g(f, response(f));
      }
    }
    return sum;
  }
  // Of K (1 - K).
  Real spread() const {
    static const oracle::Rule rule(20);
    Real sum = 0, before = 0;
    for (std::size_t i = 0; i + 1 < kernel_.knots().size(); ++i) {
      const Real a = kernel_.knots()[i], half = (kernel_.knots()[i + 1] - a) / 2;
      for (std::size_t n = 0; n < rule.x.size(); ++n) {
        const Real K = before + kernel_.over(a, a + half * (1 + rule.x[n]));
        sum += half * rule.w[n] * K * (1 - K);
      }
      before += kernel_.over(a, a + 2 * half);
    }
    return sum;
  }
  Real ripple() const {
    std::vector<Real> phases;
    for (const Real knot : kernel_.knots()) phases.push_back(knot - std::floor(knot));
    std::sort(phases.begin(), phases.end());
    phases.push_back(phases.front() + 1);
    const Real r = kernel_.radius();
    const auto off = [&](Real phase) {
      Real sum = -1;
      for (Real x = phase - std::ceil(r) - 2; x < r; x += 1) sum += x > -r ? kernel_(x) : 0;
      return std::fabs(sum);
    };
    Real worst = 0;
    for (std::size_t i = 0; i + 1 < phases.size(); ++i) {
      constexpr Real kAway = 1e-16L;  // off a knot, to the side in question
      if (phases[i + 1] - phases[i] > 1e-12L) {
        worst = std::max(worst, peak(off, phases[i] + kAway, phases[i + 1] - kAway, 24));
      }
    }
    return worst;
  }
  // max K - 1.
  Real overshoot() const {
    Real best = 0, before = 0;
    for (std::size_t i = 0; i + 1 < kernel_.knots().size(); ++i) {
      const Real a = kernel_.knots()[i], b = kernel_.knots()[i + 1];
      best = std::max(best, peak([&](Real x) { return before + kernel_.over(a, x); }, a, b, 8) - 1);
      before += kernel_.over(a, b);
    }
    return best;
  }
  Real anisotropy() const {
    const auto product = [&](Real angle) {
      return std::fabs(response(std::cos(angle) / 2) * response(std::sin(angle) / 2));
    };
    const Real high = peak(product, 0, kPi / 4, 60);
    return high + peak([&](Real angle) { return -product(angle); }, 0, kPi / 4, 60);
  }
  // The total variation of k, jumps included, and a per cent more for what samples miss.
  Real variation() const {
    const Real r = kernel_.radius();
    Real sum = std::fabs(kernel_(r)), before = kernel_(0);
    for (int i = 1; i <= 2000; ++i) {
      const Real here = kernel_(r * static_cast<Real>(i) / 2000);
      sum += std::fabs(here - before);
      before = here;
    }
    return 2.02L * sum;
  }

 private:
  oracle::Kernel kernel_;
  std::vector<Real> x_, mass_;  // of the right half, doubled
};

// What filter_metrics.h promises, and for what grows as the square of a narrow kernel that share of it.
constexpr double kPromised = 1e-13;

TEST_SUITE("unit") {
  TEST_CASE("every filter's metrics agree with brute force in long double") {
    std::vector<std::string> texts = filter_variants(Symmetry::separable);
    for (const char* more : {"box:width=0.3", "box:width=1.7", "tent:radius=1.3", "bspline:order=0", "bspline:order=5",
                             "mitchell:b=1.5,c=-0.25", "gaussian:sigma=0.05,radius=0.15", "gaussian:sigma=2,radius=5",
                             "lanczos:a=2", "lanczos:a=7", "blackman-harris:width=2.5"}) {
      texts.emplace_back(more);
    }
    for (const std::string& text : texts) {
      CAPTURE(text);
      const FilterMetrics m = filter_metrics(Filter(parse_spec(text, "test")).kernel());
      const Brute brute(text);
      const Real E = brute.square();
      const double share = std::max(1.0, static_cast<double>(E * E)) * kPromised;
      CHECK(distance(m.radius, brute.kernel().radius()) < 1e-15 * m.radius);
      CHECK(std::fabs(m.mean) < kPromised);
      CHECK(distance(m.variance, brute.moment(2)) < kPromised);
      CHECK(distance(m.nyquist_response, brute.response(0.5L)) < kPromised);
      CHECK(distance(m.l1_gain, brute.kernel().gain()) < kPromised);
      CHECK(distance(m.overshoot_percent, 100 * brute.overshoot()) < 100 * kPromised);
      CHECK(distance(m.ripple, brute.ripple()) < share);
      CHECK(distance(m.noise_gain_1d, E) < share);
      CHECK(distance(m.noise_gain, E * E) < share);
      CHECK(distance(m.anisotropy, brute.anisotropy()) < kPromised);

      const auto power = [](Real, Real h) { return h * h; };
      const Real band = 2 * brute.over_band(0, 0.5L, power);
      CHECK(distance(m.smoothing, 1 - band * band) < kPromised);
      CHECK(distance(m.postaliasing, E * E - band * band) < share);

      // Beyond f = F a kernel of total variation V has |H| <= V / (2 pi f): what the integrals below leave out.
      constexpr Real kFar = 8;
      const Real v = brute.variation() / (2 * kPi);
      const Real outside = 2 * brute.over_band(0.5L, kFar, power), left = 2 * v * v / kFar;
      const Real low = (band + outside) * (band + outside) - band * band;
      const Real high = (band + outside + left) * (band + outside + left) - band * band;
      CHECK(static_cast<Real>(m.postaliasing + share) >= low);
      CHECK(static_cast<Real>(m.postaliasing - share) <= high);

      const auto edge = [](Real f, Real h) { return h * h / (4 * kPi * kPi * f * f); };
      const Real near = 2 * brute.over_band(0.5L, kFar, edge);
      CHECK(static_cast<Real>(m.edge_alias_energy + kPromised) >= near);
      CHECK(static_cast<Real>(m.edge_alias_energy - kPromised) <=
            near + 2 * v * v / (12 * kPi * kPi * std::pow(kFar, 3.0L)));
      // The same identity as the product's to more digits; (1 - H^2) / f^2 loses 2 * 5e-20 / f^2, f >= 4e-4.
      const auto lost = [](Real f, Real h) { return (1 - h * h) / (4 * kPi * kPi * f * f); };
      const Real identity = 1 / (kPi * kPi) - brute.spread() + 2 * brute.over_band(0, 0.5L, lost);
      CHECK(distance(m.edge_alias_energy, identity) < kPromised);
    }
  }
}

}  // namespace
}  // namespace moire
