// Inverse distributions: the integral of |k| is that of k over stretches between the kernel's zeros, which are sought
// by bisection of the published formula.
#include "stress/inverse_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/inverse_distribution.h"
#include "oracle/quad.h"
#include "stress/ball_kernel.h"

namespace moire::stress {
namespace {

using oracle::Quad;

// The true distribution of |k| over the support, or over the disk.
class AbsoluteDistribution {
 public:
  explicit AbsoluteDistribution(const Filter& filter)
      : kernel_(filter), radial_(filter.is_radial()), whole_(radial_ ? kernel_.G(kernel_.radius()).value : 1) {
    find_zeros();
    Quad mass = 0;
    for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
      before_.push_back(mass);
      mass += oracle::abs(signed_up_to(ends_[i + 1]) - signed_up_to(ends_[i]));
    }
    total_ = mass;
  }

  Quad total() const { return total_; }
  double radius() const { return kernel_.radius(); }
  Enclosed k(double x) const { return kernel_.k(x); }
  // Where k changes its sign, and the support's ends; the masses before them.
  const std::vector<double>& ends() const { return ends_; }
  Quad before(std::size_t end) const { return before_[end]; }
  Quad up_to(double x) {
    const auto after = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, x);
    const auto i = static_cast<std::size_t>(after - ends_.begin()) - 1;
    return before_[i] + oracle::abs(signed_up_to(x) - signed_up_to(ends_[i]));
  }
  // On the integrals so far. A zero that is an ulp off moves P by the square of that, times the slope: nothing.
  double error() const { return error_; }

 private:
  Quad signed_up_to(double x) {
    const Enclosed e = radial_ ? kernel_.G(x) : kernel_.K(x);
    error_ =
        std::max(error_, 4.0 * static_cast<double>(ends_.size()) * (e.error / static_cast<double>(whole_) + 0x1p-105));
    return e.value / whole_;
  }

  // Of x >= 0; kernels are even. 256 steps a radius are far closer than the zeros of these kernels are to each other.
  void find_zeros() {
    constexpr int kSteps = 256;
    const double r = kernel_.radius();
    std::vector<double> zeros;
    double last = 0, last_sign = 0;
    for (int i = 0; i <= kSteps; ++i) {
      double x = i < kSteps ? r * (i + 0.3) / kSteps : std::nextafter(r, 0.0);
      const double sign = sign_of(x);
      if (sign == 0) continue;
      if (last_sign != 0 && sign != last_sign) {
        double lo = last, hi = x;
        while (std::nextafter(lo, hi) < hi) {
          const double middle = 0.5 * (lo + hi);
          (sign_of(middle) == last_sign ? lo : hi) = middle;
        }
        zeros.push_back(hi);
      }
      last = x;
      last_sign = sign;
    }
    if (!radial_) {
      ends_.push_back(-r);
      for (std::size_t i = zeros.size(); i-- > 0;) ends_.push_back(-zeros[i]);
    } else {
      ends_.push_back(0);
    }
    ends_.insert(ends_.end(), zeros.begin(), zeros.end());
    ends_.push_back(r);
  }
  double sign_of(double x) const {
    const Enclosed k = kernel_.k(x);
    if (static_cast<double>(oracle::abs(k.value)) <= k.error) return 0;
    return k.value < 0 ? -1 : 1;
  }

  BallKernel kernel_;
  bool radial_;
  Quad whole_;
  std::vector<double> ends_;
  std::vector<Quad> before_;
  Quad total_ = 0;
  double error_ = 0;
};

std::vector<double> hard_arguments(Chance& chance, const AbsoluteDistribution& truth) {
  constexpr double kLast = 1 - 0x1p-53;
  std::vector<double> u{0, 0x1p-1074, 0x1p-53, 0.5, kLast, chance.unit(), chance.decades(1e-300, 1)};
  for (std::size_t i = 1; i + 1 < truth.ends().size(); ++i) {
    const double share = static_cast<double>(truth.before(i) / truth.total());
    u.insert(u.end(), {std::nextafter(share, 0.0), share, std::nextafter(share, 1.0)});
  }
  for (double& v : u) v = std::clamp(v, 0.0, kLast);
  std::sort(u.begin(), u.end());
  return u;
}

}  // namespace

ManyValues inverse_case(Chance& chance, const Filter& filter) {
  const InverseDistribution inverse(filter);
  AbsoluteDistribution truth(filter);
  const Quad all = truth.total();
  ManyValues c;
  c.text = fmt::format("the inverse distribution of --filter {} --estimator importance", filter.text());
  c.severity = std::max(1.0, static_cast<double>(all));
  const auto see = [&](std::string_view quantity, double at, double computed, Quad wanted, Quad error) {
    Measured m;
    m.quantity = quantity;
    m.at = at;
    m.computed = computed;
    m.wanted = static_cast<double>(wanted);
    m.error = static_cast<double>(oracle::abs(error));
    m.bound = inverse.error();
    m.oracle_error = truth.error();
    c.worst.see(m);
  };
  see("absolute integral", 1, inverse.absolute_integral(), all, oracle::widen(inverse.absolute_integral()) - all);
  double last = filter.is_radial() ? 0 : -truth.radius();
  for (const double u : hard_arguments(chance, truth)) {
    const InverseDistribution::Point point = inverse.at(u);
    // Also of NaN.
    if (!(point.x >= last && point.x < truth.radius())) {
      c.worst.fault(fmt::format("{:.17g} at u = {:.17g} falls or leaves the support", point.x, u));
      break;
    }
    last = point.x;
    const Quad wanted = oracle::widen(u) * all, got = truth.up_to(point.x);
    see("P at u =", u, static_cast<double>(got), wanted, got - wanted);
    if (inverse.sign(u) != point.sign) c.worst.fault(fmt::format("sign() and at() differ at u = {:.17g}", u));
    // The sign may be that beyond a zero where no more than the error lies between.
    const auto& ends = truth.ends();
    const bool at_change = std::any_of(ends.begin() + 1, ends.end() - 1, [&](double zero) {
      return oracle::abs(truth.up_to(zero) - got) <= oracle::widen(2 * (inverse.error() + truth.error()));
    });
    const Quad k = truth.k(point.x).value;
    if (!at_change && k != 0 && (k < 0) != (point.sign < 0)) {
      c.worst.fault(fmt::format("the sign at u = {:.17g} is not that of k({:.17g})", u, point.x));
    }
  }
  return c;
}

}  // namespace moire::stress
