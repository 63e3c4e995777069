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
// Half lengths around the rectangle: where weights are bounded, the first for short stretches.
constexpr double kNearby[] = {1, 2, 4, 8};

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

namespace {

// What the integral over a stretch, and the doubt in it, start from.
class Stretch {
 public:
  explicit Stretch(const HorizonStretch& h);

  const HorizonStretch& h;
  double start, w0, w1, rise;  // W at the start, there or 0, at the end; by how much it grows along the side
  bool ends;                   // in front of the horizon
  double from_horizon, reach;  // length from there, in tau and in half lengths
  double x0;                   // w0 / w1
  double size;                 // bound on the sum of the terms at w1
  int terms;                   // that are interpolated
  std::size_t n;               // powers of W

  // False: too short, or hardly falling, so that t has no room.
  bool usable() const { return h.end < 1 && w0 < w1 && rise > 4 * h.noise.w; }
  // What is known without integrals.
  double nothing() const { return size * h.integral_of_w * (1 + 0x1p-20); }
  // What is left out before W is 0.
  double before_horizon() const { return ends ? 0 : size * start * start / rise; }
  // Bound on the integral of term j per unit of its weight, and on that of what its interpolation is off by.
  double simple(int j) const;
  double doubt(int j) const;

 private:
  double missed(int j, std::size_t powers) const;
  double lost(int j, std::size_t powers) const;
  std::size_t best_powers() const;
};

Stretch::Stretch(const HorizonStretch& stretch)
    : h(stretch),
      start((h.side.w0 + Dd(h.start) * (h.side.w1 - h.side.w0)).value()),
      w0(std::max(start, 0.0)),
      w1((h.side.w0 + Dd(h.end) * (h.side.w1 - h.side.w0)).value()),
      rise((h.side.w1 - h.side.w0).value()),
      ends(start > 0),
      from_horizon(h.end - (ends ? h.start : -h.side.w0.value() / rise)),
      reach(from_horizon * h.weight.extent),
      x0(w0 / w1),
      size(0),
      terms(std::min(h.terms.count, kMostTerms)) {
  double power = 1;
  for (int j = 0; j < h.terms.count; ++j, power *= std::max(w1, 0.0) / h.terms.deepest) {
    size += kEuler.sup[static_cast<std::size_t>(j + 1)] * h.terms.top[static_cast<std::size_t>(j)] * power;
  }
  n = usable() ? best_powers() : 1;
}

double Stretch::simple(int j) const {
  return std::pow(h.terms.deepest, -j) / rise * kEuler.sup[static_cast<std::size_t>(j + 1)] * std::pow(w1, j + 1) *
         std::min(w1 / (j + 2), w1 - w0);
}

// What a polynomial through that many values misses of g_j: its derivative of that order over the order's factorial is
// at most the weight's size in a disk of radius r, over r to that power, in units of the stretch (Cauchy).
double Stretch::missed(int j, std::size_t powers) const {
  if (static_cast<std::size_t>(h.weight.degree) < powers) return 0;
  double least = HUGE_VAL;
  for (const double r : kNearby) {
    const double bound = power_of(reach / r, powers) * interpolation(powers).product * h.weight.top_nearby(j, r);
    if (bound < least) least = bound;
    if (reach <= kTailLength) break;  // good enough
  }
  return least;
}

double Stretch::lost(int j, std::size_t powers) const {
  const auto term = static_cast<std::size_t>(j);
  return missed(j, powers) +
         interpolation(powers).gain * gain_of(x0, powers) * (h.terms.error[term] + 32 * kUnit * h.terms.top[term]);
}

double Stretch::doubt(int j) const {
  const auto term = static_cast<std::size_t>(j);
  return simple(j) * (j < terms ? lost(j, n) : h.terms.top[term] + h.terms.error[term]);
}

// All that there are, where W falls by enough; else those that leave the least of the first term in doubt.
std::size_t Stretch::best_powers() const {
  const std::size_t most = std::min(static_cast<std::size_t>(h.weight.degree + 1), kTailPowers);
  if (w0 <= 1.01 * largest_tail_start(h.weight.degree) * w1) return most;
  std::size_t best = 1;
  double least = HUGE_VAL;
  for (std::size_t powers = 1; powers <= most; ++powers) {
    const double with = lost(0, powers);
    if (with < least) least = with, best = powers;
  }
  return best;
}

}  // namespace

double tail_doubt(const HorizonStretch& h) {
  const Stretch stretch(h);
  if (!stretch.usable()) return stretch.nothing();
  double doubt = stretch.before_horizon();
  for (int j = 0; j < h.terms.count; ++j) doubt += stretch.doubt(j);
  return std::min(doubt, stretch.nothing());
}

Bounded horizon_tail(const HorizonStretch& h, double goal) {
  const Stretch stretch(h);
  const Bounded nothing{0, stretch.nothing()};
  if (!stretch.usable() || nothing.error <= goal / 16) return nothing;

  const TailLine ray = ray_from(h, h.end);
  const TailLine end = stretch.ends ? ray_from(h, h.start) : ray;
  const double T = ray.T, x0 = stretch.x0;
  double value = 0, error = stretch.before_horizon();
  for (int j = 0; j < h.terms.count; ++j) error += stretch.doubt(j);
  const std::size_t n = stretch.n;
  const Interpolation& through = interpolation(n);
  double g[kTailPowers][kMaxTerms];
  for (std::size_t l = 0; l < n; ++l) {
    h.weight.at(h.end - stretch.from_horizon * (1 - Interpolation::node(n, l)), stretch.terms, g[l]);
  }
  for (int j = 0; j < stretch.terms; ++j) {
    const auto term = static_cast<std::size_t>(j);
    const double scale = std::pow(h.terms.deepest, -j) / stretch.rise;
    double c[kTailPowers] = {};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t l = 0; l < n; ++l) c[i] += through.coefficient[i][l] * g[l][term];
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
      if (stretch.ends) take(end, -1);
    }
  }
  return {value, error * (1 + 0x1p-20) + 16 * kUnit * std::fabs(value)};
}

}  // namespace moire
