// Integration by parts in full. f and g are the phases of the faster and the slower family, b and a their slopes times
// T, F and S the degrees of their polynomials (0 and q, or q and 0), x = t / T. With h = E_S(g) x^-p and S + M = J
// steps
//
//   integral from 1 of E_F(f) h dx = - sum over j < J of (-1)^j b^-(j+1) E_(F+j+1)(f) h^(j) at x = 1
//     - sum over S <= j < J of (-1)^j b^-(j+1) sum over the slower lines x_k of E_(F+j+1)(f_k) [jump of h^(j)]
//     + (-1)^J b^-J integral of E_(F+J)(f) h^(J) dx,
//
//   h^(j) = sum over i <= j, S of C(j,i) a^i E_(S-i)(g) (-1)^(j-i) p ... (p+j-i-1) x^(-p-j+i),
//
// the last integral between lines. Of E_S(g) only derivative number S jumps, by 2 a^S (-1)^l at the line g = l.
#include "testimages/square_wave_tail.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/double_double.h"
#include "core/rounding.h"
#include "core/sum.h"
#include "curve/quadrature.h"
#include "testimages/euler_polynomials.h"
#include "testimages/jump_sum.h"

namespace moire {
namespace {

constexpr int kMaxSteps = 6;  // M
constexpr int kMaxDegree = 10, kMaxPower = 16;
static_assert(kMaxDegree + kMaxSteps <= kMaxTerms);
// Lines per factor e of t from which integration by parts is of use; up to there pieces between lines are integrated.
constexpr double kEnough = 300;
constexpr int kMaxPieces = 5000;

double sup(int j) { return kEuler.sup[static_cast<std::size_t>(j)]; }

double power(double x, int n) {
  double out = 1;
  for (; n > 0; --n) out *= x;
  return out;
}

// x modulo 2 in [-1, 1], nothing lost but beyond 2^-104 of x.
Dd turned(Dd x) {
  const auto rest = [](double d) { return d - 2 * std::nearbyint(d / 2); };
  const Dd r = two_sum(rest(x.hi), rest(x.lo));
  return quick_two_sum(rest(r.hi), r.lo);
}

// The largest integer not above x.
double floor_of(Dd x) {
  const double k = std::floor(x.hi);
  return k == x.hi && x.lo < 0 ? k - 1 : k;
}

// E_j(u) for any u, to within 2u sup|E_(j-1)| + 40u size.
double euler(int j, Dd u) {
  const double k = floor_of(u), t = (u.hi - k - 0.5) + u.lo;
  const auto& c = kEuler.coefficient[static_cast<std::size_t>(j)];
  double e = 0;
  for (int i = j; i >= 0; --i) e = e * t + c[static_cast<std::size_t>(i)];
  return k == 2 * std::floor(k / 2) ? e : -e;
}

// Bound on how much I changes where the phases are off by the line's errors, in units of T^(1-p).
double phase_doubt(int q, int p, const TailLine& line) {
  const double inf = HUGE_VAL;
  // The integral over x of min(1, n d) x^-p, d = constant + slope (x - 1), times 1 / n; a bound.
  const auto mean = [p](double constant, double slope, double n) {
    if (p > 2) return constant / (p - 1) + slope / ((p - 1.0) * (p - 2));
    return constant + (slope > 0 ? slope * (1 + std::log1p(1 / (n * slope))) : 0);
  };
  // |E_q(u + d) - E_q(u)| <= sup|E_(q-1)| d, and 2 sup|E_q|.
  double out = sup(q - 1) * mean(line.u_error, line.du_error * line.T, sup(q - 1) / (2 * sup(q)));
  const double constant = line.v_error, slope = line.dv_error * line.T, b = std::fabs(line.dv) * line.T;
  if (constant == 0 && slope == 0) return out;
  // s(v) may be wrong where v is within d of a line, which is for |x - x_l| <= 2 d(x_l) / b around its place x_l if d
  // grows by less than half of v's speed. The weight x^-p is there at most 1.4 x_l^-p if that is within x_l / (4 p).
  // The sum over lines of a function with one hump is at most its largest value plus b times its integral; x^-p and
  // (x - 1) x^-p <= 1/4 are such.
  const double before = line.v - std::floor(line.v), ahead = line.dv < 0 ? before : 1 - before;
  const bool behind = std::min(before, 1 - before) <= 2 * constant;  // the last line passed, or the next, is in doubt
  if (b == 0) return behind || slope > 0 ? inf : out;
  const double x = behind ? 1 : 1 + ahead / b;
  if (constant / (b * x) + slope / b > 1.0 / (16 * p)) return inf;
  const double first = (constant * power(1 / x, p) + slope / 4) / b;
  out += 2 * sup(q) * 5.6 * ((behind ? 2 : 1) * first + mean(constant, slope, 5.6));
  return out;
}

class Ray {
 public:
  Ray(int q, int p, const TailLine& line) : p_(p), T_(line.T) {
    const double du = std::fabs(line.du), dv = std::fabs(line.dv);
    // E_j(-u) = (-1)^(j+1) E_j(u).
    if (line.du < 0 && q % 2 == 0) sign_ = -sign_;
    if (line.dv < 0) sign_ = -sign_;
    const Dd u = line.du < 0 ? -line.u : line.u, v = line.dv < 0 ? -line.v : line.v;
    u_fast_ = du > dv;
    F_ = u_fast_ ? q : 0, S_ = u_fast_ ? 0 : q;
    f_ = turned(u_fast_ ? u : v), g_ = turned(u_fast_ ? v : u);
    df_ = std::max(du, dv), dg_ = std::min(du, dv);
  }

  Tail integral(double goal) {
    if (df_ == 0) {
      const double value = euler(F_, f_) * euler(S_, g_) * scale() / (p_ - 1);
      return {sign_ * value, (64 + 4 * p_) * kUnit * size() * scale()};
    }
    if (!(df_ * T_ >= kEnough)) pieces(goal / 4);
    if (left_) {
      const double unit = scale();
      by_parts(goal / 2 / unit);
      sum_.add(parts_.value() * unit);
      error_ += parts_error_ * unit * (1 + 0x1p-40);
    }
    return {sign_ * sum_.value(), error_ * (1 + 0x1p-40) + kUnit * std::fabs(sum_.value())};
  }

 private:
  double scale() const { return std::pow(T_, 1 - p_) * (1 + 0x1p-50); }
  double size() const { return kEuler.size[static_cast<std::size_t>(F_)] * kEuler.size[static_cast<std::size_t>(S_)]; }

  // Integrates piece by piece between lines, until kEnough lines pass while t doubles; left_ = false where the rest
  // is in the error.
  void pieces(double goal);
  // All of the rest, in units of T^(1-p).
  void by_parts(double goal);
  void jumps(int steps, double goal);

  int p_, F_, S_;
  double T_, df_, dg_, sign_ = 1;
  Dd f_, g_;
  bool u_fast_, left_ = true;
  Sum sum_, parts_;
  double error_ = 0, parts_error_ = 0;
};

// On the Bernstein ellipse rho = 6 (semi-axes 37/12, 35/12) of a piece with ends t0, t1 <= 1.5 t0 inside one square of
// both families |t| >= 5 - 37/12 half lengths, t0 being 4 at least: |t^-p| <= (4 / 1.9)^p t0^-p, and the polynomials'
// argument is within 2.1 of the middle of their square.
void Ray::pieces(double goal) {
  constexpr int kNodes = 14;
  constexpr std::size_t kRho6 = 5;
  static_assert(kEllipses[kRho6] == 6);
  const Rule rule = gauss_legendre(kNodes);
  const double largest = sup(F_ + S_) * 1.001;
  const double ellipse = gauss_remainder(kRho6, kNodes) * std::pow(4 / 1.9, p_) * size() * std::pow(4.2, F_ + S_);
  const double last = kEnough / df_ * (1 + 0x1p-40) - T_;  // t - T
  double kf = 0, kg = 0;                                   // lines passed
  const double f0 = floor_of(f_), g0 = floor_of(g_);
  const double f = (f_.hi - f0) + f_.lo, g = (g_.hi - g0) + g_.lo;  // in the first square
  double y = 0;
  for (int n = 0; y < last; ++n) {
    const double t = T_ + y, rest = largest * std::pow(t, 1 - p_) / (p_ - 1);
    if (rest <= goal || n == kMaxPieces) {
      error_ += rest * (1 + 0x1p-40);
      left_ = false;
      return;
    }
    const double next_f = (kf + 1 - f) / df_, next_g = dg_ > 0 ? (kg + 1 - g) / dg_ : HUGE_VAL;
    const double end = std::max(y, std::min({next_f, next_g, last, 0.49 * T_ + 1.49 * y}));
    const double half = 0.5 * (end - y), mid = 0.5 * (end + y);
    double piece = 0;
    for (int i = 0; i < kNodes; ++i) {
      const auto node = static_cast<std::size_t>(i);
      const double at = mid + half * rule.node[node];
      // Inside their squares, kf and kg even as far as their sign is taken apart.
      const double ef = euler(F_, Dd(std::clamp(f + (df_ * at - kf), 0.0, 0x1.fffffffffffffp-1)));
      const double eg = euler(S_, Dd(std::clamp(g + (dg_ * at - kg), 0.0, 0x1.fffffffffffffp-1)));
      piece += rule.weight[node] * ef * eg * std::pow(T_ + at, -p_);
    }
    const double odd = std::fmod(kf + kg + f0 + g0, 2.0);
    sum_.add((odd == 0 ? half : -half) * piece);
    const double top = std::pow(t, -p_);
    // Remainder; rounding of phases, of polynomials and of powers; the place of the line at the end, which is where
    // one of the two polynomials jumps or has a kink.
    const double at = 6 * kUnit * (2 + kf + kg);
    error_ += 2 * half * top * (ellipse + at * sup(std::max(F_ + S_ - 1, 0)) + (6 * p_ + 60) * kUnit * size());
    error_ += 2 * size() * top * 6 * kUnit * (end + (end == next_f ? 1 / df_ : end == next_g ? 1 / dg_ : 0));
    if (end == next_f) ++kf;
    if (end == next_g) ++kg;
    y = end;
  }
  const double t = T_ + y;
  const Dd by = two_sum(t, -T_);
  f_ = turned(f_ + Dd(df_) * by);
  g_ = turned(g_ + Dd(dg_) * by);
  T_ = t;
}

void Ray::by_parts(double goal) {
  const double a = dg_ * T_, b = df_ * T_;
  // Bound on the remainder after S + M steps.
  const auto remainder = [&](int steps) {
    const int J = S_ + steps;
    double sum = 0, choose = 1, slope = 1;  // C(J,i), (a/b)^i
    for (int i = 0; i <= S_; ++i) {
      double rising = 1;  // p ... over b^(J-i)
      for (int m = 0; m < J - i; ++m) rising *= (p_ + m) / b;
      sum += choose * slope * sup(S_ - i) * rising / (p_ + J - i - 1);
      choose *= static_cast<double>(J - i) / (i + 1);
      slope *= a / b;
    }
    return sum * sup(F_ + J);
  };
  int steps = 1;
  while (steps < kMaxSteps && remainder(steps) > goal / 8) ++steps;
  parts_error_ += remainder(steps) * 1.001;

  // At x = 1.
  double over = -1 / b;  // - (-1)^j b^-(j+1)
  for (int j = 0; j < S_ + steps; ++j, over /= -b) {
    double sum = 0, absolute = 0, choose = 1, a_power = 1;
    for (int i = 0; i <= std::min(j, S_); ++i) {
      double rising = 1;
      for (int m = 0; m < j - i; ++m) rising *= -(p_ + m);
      const double factor = choose * a_power * rising;
      sum += factor * euler(S_ - i, g_);
      absolute +=
          std::fabs(factor) * (kEuler.size[static_cast<std::size_t>(S_ - i)] * 96 + 2 * sup(std::max(S_ - i - 1, 0)));
      choose *= static_cast<double>(j - i) / (i + 1);
      a_power *= a;
    }
    const auto d = static_cast<std::size_t>(F_ + j + 1);
    parts_.add(over * sum * euler(F_ + j + 1, f_));
    parts_error_ += std::fabs(over) * kUnit * absolute * (4 * kEuler.size[d] + sup(F_ + j));
  }
  if (a > 0) jumps(steps, goal / 2);
}

void Ray::jumps(int steps, double goal) {
  const double a = dg_ * T_, b = df_ * T_;
  const double line = floor_of(g_) + 1;  // of the slower family, the next
  const Dd ahead = Dd(line) - g_;
  const Dd slope = Dd(df_) / Dd(dg_);
  JumpSum in{};
  in.order = F_ + S_ + 1;
  in.p = p_;
  in.x = 1 + ahead.value() / a;
  in.spacing = 1 / a;
  // Every crossing has its own sign and, beyond 2^50 lines of the other family in between, a phase that is not known.
  const Dd first = slope * ahead;
  in.phase = turned(f_ + first);
  in.step = turned(slope);
  in.phase_error = 0x1p-98 * (2 + std::fabs(first.hi));
  in.step_error = slope.hi * 0x1p-102;
  std::array<double, kMaxSteps> weight{1};
  for (int i = 1; i < steps; ++i) {
    const auto at = static_cast<std::size_t>(i);
    weight[at] = weight[at - 1] * static_cast<double>(S_ + i) / i * (p_ + i - 1) / b;
  }
  in.weight = std::span(weight).first(static_cast<std::size_t>(steps));
  // - (-1)^S 2 (a/b)^S / b, and the sign of the first line.
  double factor = 2 * power(a / b, S_) / b;
  if (S_ % 2 == 0) factor = -factor;
  if (std::fmod(line, 2.0) != 0) factor = -factor;
  if (!(slope.hi < 0x1p90) || factor == 0 || !std::isfinite(in.spacing)) {
    // Then lines are so far apart that their share does not count.
    parts_error_ += 1.01 * (std::fabs(factor) * sup(in.order) * (std::pow(in.x, -p_) + a / (p_ - 1)));
    return;
  }
  const Tail jumps = jump_sum(in, goal / std::fabs(factor));
  parts_.add(factor * jumps.value);
  parts_error_ += std::fabs(factor) * (jumps.bound + (10 + 3 * p_ + 2 * S_) * kUnit * std::fabs(jumps.value));
}

}  // namespace

Tail square_wave_tail(int q, int p, const TailLine& line, double goal) {
  const double size = q >= 0 && q <= kMaxTerms ? sup(q) : 1.3 * std::pow(3.14, -q);
  const double simple = size * std::pow(line.T, 1 - p) / (p - 1) * (1 + 0x1p-45);
  if (!(goal < simple) || q < 1 || q > kMaxDegree || p < 2 || p > kMaxPower) return {0, simple};
  for (const double x : {line.u, line.v, line.du, line.dv}) {
    if (!(std::fabs(x) < 0x1p500)) return {0, simple};
  }
  const double doubt = phase_doubt(q, p, line) * std::pow(line.T, 1 - p) * (1 + 0x1p-40);
  if (!(doubt < simple)) return {0, simple};
  Tail tail = Ray(q, p, line).integral(std::max(goal - doubt, simple * 0x1p-50));
  tail.bound += doubt;
  return tail.bound < simple ? tail : Tail{0, simple};
}

}  // namespace moire
