// On the stretch W is linear in tau, and S / W and J / W are linear in t = 1 / W. The weights g_j are interpolated by
// polynomials in W, so that everything is a sum of integrals of E_(j+1)(u(t)) s(v(t)) t^-p, p = 3 + i + j for W^i; each
// is at most sup|E_(j+1)| T^(1-p) / (p - 1), which falls quickly with i + j: only the first few are worth more than
// that.
#include "testimages/horizon_tail.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "testimages/square_wave_tail.h"

namespace moire {
namespace {

constexpr int kMostTerms = 8;  // j below that are interpolated; of the others only the size is known
constexpr double kNearby = 1;  // half lengths around the rectangle: where weights are bounded

// Polynomials through values at n equal steps of [0, 1].
struct Interpolation {
  double coefficient[kTailPowers][kTailPowers] = {};  // of s^i, for a value 1 at node l
  double gain = 0;                                    // sum of their absolute values
  double product = 1;                                 // bound on the product of the distances to all nodes
  static double node(std::size_t n, std::size_t l) {
    return n == 1 ? 1 : static_cast<double>(l) / static_cast<double>(n - 1);
  }
  explicit Interpolation(std::size_t n) {
    for (std::size_t l = 0; l < n; ++l) {
      double c[kTailPowers] = {1};
      std::size_t degree = 0;
      for (std::size_t k = 0; k < n; ++k) {
        if (k == l) continue;
        const double scale = 1 / (node(n, l) - node(n, k));
        ++degree;
        for (std::size_t i = degree + 1; i-- > 0;)
          c[i] = scale * ((i > 0 ? c[i - 1] : 0) - node(n, k) * (i < degree ? c[i] : 0));
      }
      for (std::size_t i = 0; i < n; ++i) {
        coefficient[i][l] = c[i];
        gain += std::fabs(c[i]);
      }
      // At s between two nodes: distances of at most 1 / (n - 1), 1 / (n - 1), 2 / (n - 1), 3 / (n - 1) and so on.
      if (l > 0) product *= static_cast<double>(std::max<std::size_t>(l, 1)) / static_cast<double>(n - 1);
    }
    if (n > 1) product /= static_cast<double>(n - 1);
  }
};

const Interpolation& interpolation(std::size_t n) {
  static const std::array<Interpolation, kTailPowers> tables{Interpolation(1), Interpolation(2), Interpolation(3),
                                                             Interpolation(4), Interpolation(5), Interpolation(6),
                                                             Interpolation(7), Interpolation(8)};
  return tables[n - 1];
}

// What powers of s = (W - w0) / (w1 - w0) gain as powers of x = W / w1: s = (x - x0) / (1 - x0), x0 = w0 / w1.
double gain_of(double x0, std::size_t n) { return std::pow((1 + x0) / (1 - x0), static_cast<double>(n - 1)); }
constexpr double kMostGain = 1e4;

double power_of(double x, std::size_t n) { return std::pow(x, static_cast<double>(n)); }

// F / W modulo 2, in [0, 2), and a bound on its error.
Bounded phase(Dd f, Dd w, double f_noise, double w_noise) {
  const Dd q = f / w;
  const Dd rest = q - Dd(2 * std::floor(q.hi / 2));
  double value = rest.value();
  if (value < 0) value += 2;
  if (value >= 2) value -= 2;
  const double size = std::fabs(q.hi);
  return {value, 1.1 * (f_noise + size * w_noise) / w.hi + 0x1p-98 * size + 4 * kUnit};
}

// The ray from tau on towards smaller W.
TailLine ray_from(const HorizonStretch& h, double tau) {
  const BoardSide& side = h.side;
  const Dd t = tau, rise = side.w1 - side.w0;
  const Dd w = side.w0 + t * rise;
  const Bounded u = phase(side.s0 + t * (side.s1 - side.s0), w, h.noise.s, h.noise.w),
                v = phase(side.j0 + t * (side.j1 - side.j0), w, h.noise.j, h.noise.w);
  // Slopes: along_s and along_j, the rise and the quotient.
  const double rise_error = (2 * h.noise.w + 2 * kUnit * rise.hi) / rise.hi;
  const auto slope_error = [&](const Bounded& along) {
    return 1.01 * (along.error + std::fabs(along.value) * (rise_error + 2 * kUnit)) / rise.hi;
  };
  return {.T = 1 / w.value(),
          .u = u.value,
          .v = v.value,
          .du = -side.along_s.value / rise.value(),
          .dv = -side.along_j.value / rise.value(),
          .u_error = u.error,
          .v_error = v.error,
          .du_error = slope_error(side.along_s),
          .dv_error = slope_error(side.along_j)};
}

}  // namespace

double largest_tail_start(int degree) {
  const double gain = degree > 0 ? std::pow(kMostGain, 1.0 / std::min(degree, static_cast<int>(kTailPowers) - 1)) : 99;
  return std::min((gain - 1) / (gain + 1), 0.9);
}

Bounded horizon_tail(const HorizonStretch& h, double goal) {
  const BoardSide& side = h.side;
  const double w0 = std::max(side.w0.value(), 0.0), rise = (side.w1 - side.w0).value();
  const double w1 = (side.w0 + Dd(side.from) * (side.w1 - side.w0)).value();
  double size = 0, power = 1;
  for (int j = 0; j < h.terms.count; ++j, power *= w1 / h.terms.deepest) {
    size += kEuler.sup[static_cast<std::size_t>(j + 1)] * h.terms.top[static_cast<std::size_t>(j)] * power;
  }
  const Bounded nothing{0, size * side.left_out * (1 + 0x1p-20)};
  // Too short, or hardly falling: t has no room.
  if (side.from >= 1 || !(w0 <= 1.01 * largest_tail_start(h.weight.degree) * w1) || !(rise > 4 * h.noise.w) ||
      nothing.error <= goal / 16)
    return nothing;

  const TailLine ray = ray_from(h, side.from);
  const bool ends = side.w0.value() > 0;  // in front of the horizon
  const TailLine end = ends ? ray_from(h, 0) : ray;
  const double T = ray.T, x0 = w0 / w1;
  // Of W between w0, or 0, and the end of the stretch; besides |W| dtau before W is 0.
  double value = 0, error = 0;
  if (!ends) error += size * side.w0.value() * side.w0.value() / rise;
  const double from_horizon = side.from - (ends ? 0 : -side.w0.value() / rise);
  const int terms = std::min(h.terms.count, kMostTerms);
  const auto n = std::min(static_cast<std::size_t>(h.weight.degree + 1), kTailPowers);
  const Interpolation& through = interpolation(n);
  double g[kTailPowers][kMaxTerms];
  for (std::size_t l = 0; l < n; ++l) {
    h.weight.at(side.from - from_horizon * (1 - Interpolation::node(n, l)), terms, g[l]);
  }
  for (int j = 0; j < h.terms.count; ++j) {
    const auto term = static_cast<std::size_t>(j);
    const double scale = std::pow(h.terms.deepest, -j) / rise;
    const double simple = scale * kEuler.sup[term + 1] * std::pow(w1, j + 2) / (j + 2);  // per unit of the weight
    if (j >= terms) {
      error += simple * (h.terms.top[static_cast<std::size_t>(j)] + h.terms.error[static_cast<std::size_t>(j)]);
      continue;
    }
    double c[kTailPowers] = {};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t l = 0; l < n; ++l) c[i] += through.coefficient[i][l] * g[l][term];
    // What the polynomial misses: the n-th derivative over n! is at most the weight's size in a disk of radius r, over
    // r^n, in units of the stretch (Cauchy).
    const double reach = from_horizon * h.weight.extent / kNearby;
    const double missed = static_cast<std::size_t>(h.weight.degree) < n
                              ? 0
                              : power_of(reach, n) * through.product * h.weight.top_nearby(j, kNearby);
    error += simple * (missed + through.gain * gain_of(x0, n) *
                                    (h.terms.error[static_cast<std::size_t>(j)] +
                                     32 * kUnit * h.terms.top[static_cast<std::size_t>(j)]));
    // From powers of s to those of x.
    for (std::size_t i = 0; i < n; ++i) {
      double d = 0, binomial = 1;
      for (std::size_t l = i; l < n; ++l) {
        d += c[l] * binomial * power_of(-x0, l - i) / power_of(1 - x0, l);
        binomial *= static_cast<double>(l + 1) / static_cast<double>(l + 1 - i);
      }
      const int q = j + 1, p = 3 + j + static_cast<int>(i);
      const double factor = d * scale * power_of(T, i), sup = kEuler.sup[term + 1];
      const double most = sup * std::pow(T, 1 - p) / (p - 1);
      if (std::fabs(factor) * most <= goal / 32) {
        error += std::fabs(factor) * most;
        continue;
      }
      const double ask = goal / (32 * std::fabs(factor));
      const auto take = [&](const TailLine& line, double sign) {
        const double all = sup * std::pow(line.T, 1 - p) / (p - 1);
        const Tail tail = all > ask ? square_wave_tail(q, p, line, ask) : Tail{0, all};
        value += sign * factor * tail.value;
        error += std::fabs(factor) * (tail.bound + 0x1p-44 * all);  // the second for T itself, and powers
      };
      take(ray, 1);
      if (ends) take(end, -1);
    }
  }
  return {value, error * (1 + 0x1p-20) + 16 * kUnit * std::fabs(value)};
}

}  // namespace moire
