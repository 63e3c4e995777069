// The rest of the sum from x_K = X on, term by term of the Fourier series E_j(y) = 2 Re sum over odd n > 0 of
// 2 (i pi n)^-(j+1) exp(i pi n y). With theta = pi (n step + 1) modulo 2 pi, |theta| <= pi, and A = X / spacing a
// harmonic is X^-P times
//
//   S_P(theta) = sum over k >= 0 of exp(i theta k) (1 + k / A)^-P
//              = mean over s of w(i theta - s / A),   w(z) = 1 / (1 - exp(z)),
//
// s > 0 weighed by s^(P-1) e^-s / (P-1)!, whose moments are P (P+1) ... (P+j-1). w has poles at 2 pi i times the
// integers; -1/z, that at 0, gives A L_P(A theta), L_P the integral in oscillating_tail.h. What is left, or w itself
// where theta is away from 0, is expanded at i theta (Euler and Maclaurin, Boole). After M terms the remainder is at
// most P ... (P+M-1) / A^M times the largest |derivative number M| / M! on the way, which is the sum over the poles a
// of |z - a|^-(M+1): |theta|^-(M+1) for the pole at 0, together at most 2 pi^-(M+1) (1 + 3^-(M+1) + ...) < 2.2
// pi^-(M+1) for the others.
#include "testimages/jump_sum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rounding.h"
#include "core/sum.h"
#include "testimages/euler_polynomials.h"
#include "testimages/oscillating_tail.h"

namespace moire {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Terms per factor e of x before the rest is expanded: the expansions' small parameter is p / kDense.
constexpr double kDense = 2000;
// |theta| / pi up to which the pole at 0 is taken apart.
constexpr double kNear = 1.0 / 6;
// Nanoseconds of a term and of a harmonic, roughly.
constexpr double kTermTime = 12, kHarmonicTime = 100;

// x modulo 2 in [-1, 1], nothing lost; |x| < 2^50.
Dd turned(Dd x) {
  x.hi -= 2 * ((0.5 * x.hi + 0x1.8p52) - 0x1.8p52);
  return quick_two_sum(x.hi, x.lo);
}

double power(double x, int n) {
  double out = 1;
  for (; n > 0; --n) out *= x;
  return out;
}

struct Complex {
  double re, im;
};

// S_P(theta) for theta away from 0, with h = cot(theta / 2) / 2: w = 1/2 + i h, and its derivatives from w' = w^2 - w.
Complex far_sum(double P, double A, double h) {
  const double g = -0.25 - h * h, a = 1 / A;
  const double second = P * (P + 1) / 2 * a * a, third = second * (P + 2) / 3 * a, fourth = third * (P + 3) / 4 * a;
  return {0.5 - P * a * g - third * g * (2 * g - 4 * h * h),
          h + second * 2 * h * g + fourth * 8 * h * g * (2 * g - h * h)};
}
constexpr int kFarTerms = 5;

// The same near 0 without the pole there: w(i theta) - i / theta = 1/2 + i c(theta), c the odd series below
// (coefficients |B_2j| / (2j)!, B_2j Bernoulli numbers; the next is below 2^-54 at kNear).
Complex near_sum(double P, double A, double theta) {
  constexpr double kC[] = {-1.0 / 12,           -1.0 / 720,      -1.0 / 30240,
                           -1.0 / 1209600,      -1.0 / 47900160, -691.0 / 1307674368000.0,
                           -1.0 / 74724249600.0};
  const double tt = theta * theta, a = 1 / A;
  double c = 0, c1 = 0, c2 = 0;  // c / theta, c', c'' / theta
  for (int j = 6; j >= 0; --j) {
    const double k = kC[j], n = 2 * j + 1;
    c = c * tt + k;
    c1 = c1 * tt + n * k;
    if (j > 0) c2 = c2 * tt + n * (n - 1) * k;
  }
  return {0.5 - P * a * c1, theta * (c - P * (P + 1) / 2 * a * a * c2)};
}
constexpr int kNearTerms = 3;

class Summation {
 public:
  Summation(const JumpSum& in, double goal) : in_(in), goal_(goal) {}

  Tail operator()() {
    const auto order = static_cast<std::size_t>(in_.order);
    choose();
    direct();
    if (harmonics_ > 0) fourier();
    // Phases, and the rounding of polynomials and powers, for all terms together.
    const double all = largest(in_.x) * kEuler.size[order] / kEuler.sup[order];
    const double phases = largest(in_.x) * kEuler.sup[order - 1] / kEuler.sup[order] *
                          (in_.phase_error + (direct_ + 1) * (in_.step_error + 0x1p-102) + 4 * kUnit);
    return {sum_.value(), error_ + phases + (10 * in_.p + 4 * in_.order + 40) * kUnit * all};
  }

 private:
  // Bounds on the sum of |weight[i]| x_k^(-p - i) over x_k >= X, without and with sup|E|.
  double mass(double X) const { return weights(X) * power(1 / X, in_.p) * (1 + X / in_.spacing / (in_.p - 1)); }
  double largest(double X) const { return kEuler.sup[static_cast<std::size_t>(in_.order)] * mass(X); }
  double weights(double X) const {
    double sum = 0;
    for (std::size_t i = in_.weight.size(); i-- > 0;) sum = in_.weight[i] + sum / X;
    return sum;
  }
  // Bound on what harmonics beyond the odd number n leave out, per unit of mass: the sum over odd m > n of the convex
  // function 4 / (pi m)^(order + 1), at most half its integral from n + 1.
  double beyond(double n) const { return 2 / (in_.order * std::pow(kPi, in_.order + 1) * std::pow(n + 1, in_.order)); }

  // How many terms to add as they are, and how many harmonics of the rest.
  void choose() {
    start_ = in_.x;
    if (largest(in_.x) <= goal_ / 2) return;
    double best = HUGE_VAL, best_time = HUGE_VAL;
    for (double dense = kDense;; dense *= 2) {
      const double terms = std::max(0.0, std::ceil(dense - in_.x / in_.spacing));
      if (terms > kMaxDirect) break;
      const double X = in_.x + terms * in_.spacing;
      double n = 0, left = largest(X);
      if (left > goal_ / 2) {
        const double share = goal_ / 4 / mass(X);
        n = share > 0 ? std::ceil(std::pow(beyond(0) / share, 1.0 / in_.order)) : kMaxHarmonics;
        n = 2 * std::floor(std::min(n, kMaxHarmonics) / 2) + 1;
        left = beyond(n) * mass(X);
      }
      left = std::max(left, goal_ / 2);
      const double time = kTermTime * terms + kHarmonicTime * n / 2;
      if (left < best || (left == best && time < best_time)) {
        best = left, best_time = time;
        direct_ = terms;
        harmonics_ = n;
        start_ = X;
      }
    }
  }

  void direct() {
    Dd phase = turned(in_.phase), step = in_.step;
    double sign = 1;
    for (double k = 0; k < direct_; ++k, sign = -sign) {
      const double r = 1 / (in_.x + k * in_.spacing);
      // phase is in [-1, 1]: the square below 0 counts as odd.
      const double t = (phase.hi < 0 ? phase.hi + 0.5 : phase.hi - 0.5) + phase.lo;
      double value = 0, factor = phase.hi < 0 ? -sign : sign;
      for (std::size_t i = in_.weight.size(); i-- > 0;) {
        const auto j = static_cast<std::size_t>(in_.order) + i;
        const auto& c = kEuler.coefficient[j];
        const double tt = t * t;
        double e = 0;
        for (std::size_t d = j + 2; d >= 2;) d -= 2, e = e * tt + c[d];
        if (j % 2 == 1) e *= t;
        value = in_.weight[i] * e + r * value;
      }
      sum_.add(factor * value * power(r, in_.p));
      phase = turned(phase + step);
    }
    start_phase_ = phase;
    start_sign_ = sign;
    if (harmonics_ == 0) error_ += largest(start_);
  }

  void fourier() {
    const double scale = power(1 / start_, in_.p);
    error_ += beyond(harmonics_) * mass(start_);
    const double tolerance = goal_ / 4 / harmonics_ / scale;
    Dd y = start_phase_, turn = turned(in_.step + Dd(1));
    const Dd y_step = turned(y + y), turn_step = turned(in_.step + in_.step);
    const double w = weights(start_), A = start_ / in_.spacing;
    double skipped = 0;
    for (double n = 1; n <= harmonics_; n += 2) {
      // |S_P| <= 1 / |sin theta|, or 1: the distance of 1 from the ray through exp(i theta).
      const double angle = std::fabs(turn.hi);
      const double size = std::min(1 + A / (in_.p - 1), std::max(1.0, 0.51 / angle));
      const double bound = 4 / power(kPi * n, in_.order + 1) * w * size;
      if (bound < tolerance) {
        skipped += bound;
      } else {
        harmonic(n, y.value(), turn.value(), A, scale, tolerance);
      }
      y = turned(y + y_step);
      turn = turned(turn + turn_step);
    }
    error_ += 1.001 * skipped * scale;
  }

  // One harmonic: y is its phase and turn = theta / pi, both from -1 to 1.
  void harmonic(double n, double y, double turn, double A, double scale, double tolerance) {
    const double theta = kPi * turn, angle = std::fabs(turn);
    const bool near = angle <= kNear;
    // Errors of turn and y beyond rounding.
    const double turn_error = n * (in_.step_error + 0x1p-102);
    const double y_error = n * (in_.phase_error + (direct_ + 1) * (in_.step_error + 0x1p-102)) + 2 * kUnit;
    const double outer = 4 / power(kPi * n, in_.order + 1);
    OscillatingTail tail{0, 0, 0};
    double h = 0;
    if (near) {
      tail = oscillating_tail(in_.p, A * theta);
      // L changes by |omega L'| <= 1 / (P - 1) times a relative error of omega, by 1 / ((P - 1) (P - 2)) times an
      // absolute one, for P = 2 by d (1 + log(1 + 2 / d)).
      const double d = kPi * A * turn_error;
      tail.error += 12 * kUnit + (in_.p > 2 ? d : d > 0 ? d * (1 + std::log(1 + 2 / d)) : 0);
    } else {
      h = 0.5 / std::tan(0.5 * theta);
    }
    Complex z{0, 0};
    double error = 0, magnitude = 0, power_n = 1;  // power_n: (pi n X)^-i
    for (std::size_t i = 0; i < in_.weight.size(); ++i) {
      const double P = in_.p + static_cast<double>(i), factor = in_.weight[i] * power_n;
      Complex s = near ? near_sum(P, A, theta) : far_sum(P, A, h);
      const int terms = near ? kNearTerms : kFarTerms;
      double remainder =
          near ? 2.2 / power(kPi, terms + 1) : 2.2 / power(kPi, terms + 1) + 1 / power(kPi * angle, terms + 1);
      for (int m = 0; m < terms; ++m) remainder *= (P + m) / A;
      // Rounding, and turn_error where the slope |w'| <= 1/4 + h^2.
      remainder += 40 * kUnit * (1 + std::fabs(h)) + kPi * turn_error * (1 + h * h);
      if (near) {
        s.re += A * tail.re;
        s.im += A * tail.im;
        remainder += A * (tail.error + 8 * kUnit * (std::fabs(tail.re) + std::fabs(tail.im)));
      }
      // Divided by i^i.
      const Complex turned_s = i % 4 == 0   ? s
                               : i % 4 == 1 ? Complex{s.im, -s.re}
                               : i % 4 == 2 ? Complex{-s.re, -s.im}
                                            : Complex{-s.im, s.re};
      z.re += factor * turned_s.re;
      z.im += factor * turned_s.im;
      error += factor * remainder;
      magnitude += factor * (std::fabs(s.re) + std::fabs(s.im));
      power_n /= kPi * n * start_;
      if (i + 1 == in_.weight.size()) break;
      // The others, each below 1/8 of the one before and their sums no larger.
      const double next = 1.2 * in_.weight[i + 1] * power_n * std::min(1 + A / P, std::max(1.0, 0.51 / angle));
      if (outer * next < tolerance / 4) {
        error += next;
        break;
      }
      if (near) {
        // L_(P+1) = (1 + i omega L_P) / P.
        const double omega = A * theta;
        tail = {(1 - omega * tail.im) / P, omega * tail.re / P, (std::fabs(omega) * tail.error + 8 * kUnit) / P};
      }
    }
    // 2 Re 2 (i pi n)^-(order + 1) exp(i pi y) z.
    const double c = std::cos(kPi * y), s = std::sin(kPi * y);
    const double re = c * z.re - s * z.im, im = c * z.im + s * z.re;
    const int quarter = (in_.order + 1) % 4;
    const double value = quarter == 0 ? re : quarter == 1 ? im : quarter == 2 ? -re : -im;
    sum_.add(start_sign_ * scale * outer * value);
    error_ += scale * outer * (error + magnitude * (kPi * y_error + 24 * kUnit));
  }

  const JumpSum& in_;
  double goal_;
  double direct_ = 0, harmonics_ = 0, start_ = 1;  // start_: X
  Dd start_phase_;
  double start_sign_ = 1;
  Sum sum_;
  double error_ = 0;
};

}  // namespace

Tail jump_sum(const JumpSum& sum, double goal) { return Summation(sum, goal)(); }

}  // namespace moire
