#include "engine/sign_stretches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace moire {
namespace {

class Halving {
 public:
  explicit Halving(const EvaluatedPolynomial& p) : p_(p) {
    const double n = p.degree, half = 0.5 * (p.end - p.begin);
    // V. A. Markov: on [-1, 1] the second derivative is at most n^2 (n^2 - 1) / 3 times the polynomial.
    curvature_ = 1.01 * p.largest * n * n * (n * n - 1) / 3 / (half * half);
    const std::size_t points = 4 * (static_cast<std::size_t>(p.degree) + 1);
    for (std::size_t i = 0; i < points; ++i) {
      const double angle = std::numbers::pi * (2 * static_cast<double>(i) + 1) / (2 * static_cast<double>(points));
      unit_.push_back(std::cos(angle));
    }
    x_.resize(points);
    value_.resize(points);
  }

  std::vector<SignStretch> stretches() {
    visit(p_.begin, p_.end, at(p_.begin), at(p_.end));
    if (found_.empty()) return found_;
    found_.front().begin = p_.begin;
    found_.back().end = p_.end;
    return found_;
  }

 private:
  double at(double x) const {
    double value = 0;
    p_.at({&x, 1}, &value);
    return value;
  }

  // Left to right; what is left open between two stretches of one sign is taken to have it.
  void append(double begin, double end, int sign) {
    if (!found_.empty() && found_.back().sign == sign) {
      found_.back().end = end;
      return;
    }
    if (!found_.empty()) begin = found_.back().end = zero_between(found_.back().end, begin, sign);
    found_.push_back({begin, end, sign});
  }

  // Where the sign becomes `after`, to the last bit that counts.
  double zero_between(double left, double right, int after) const {
    while (right - left > 0x1p-54 * (p_.end - p_.begin)) {
      const double middle = 0.5 * (left + right);
      if (middle <= left || middle >= right) break;
      (at(middle) * after >= 0 ? right : left) = middle;
    }
    return right;
  }

  void visit(double left, double right, double at_left, double at_right) {
    const double width = right - left, low = std::min(std::fabs(at_left), std::fabs(at_right));
    const bool same = (at_left > 0) == (at_right > 0);
    // The chord misses it by at most width^2 / 8 times the curvature, and its slope the derivative by width times it.
    if (same && low > 0.125 * width * width * curvature_ + p_.error) return append(left, right, sign_of(at_left));
    if (std::fabs(at_right - at_left) > width * width * curvature_ + 2 * p_.error) {
      // Monotone. A zero at an end of the whole is no change of sign, whatever rounding makes of it.
      const bool from_zero = left == p_.begin && std::fabs(at_left) <= p_.error;
      const bool to_zero = right == p_.end && std::fabs(at_right) <= p_.error;
      if (same || from_zero || to_zero) {
        return append(left, right, sign_of(std::fabs(at_left) > std::fabs(at_right) ? at_left : at_right));
      }
      const double zero = zero_between(left, right, sign_of(at_right));
      append(left, zero, sign_of(at_left));
      return append(zero, right, sign_of(at_right));
    }
    const double middle = 0.5 * (left + right);
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = middle + 0.5 * width * unit_[i];
    p_.at(x_, value_.data());
    double least = HUGE_VAL, most = 0;
    for (const double v : value_) {
      least = std::min(least, v * sign_of(value_[0]));
      most = std::max(most, std::fabs(v));
    }
    // All of it is below 1 / cos(pi / 8) < 1.09 times the most, and so below 6 times the error.
    if (1.09 * most <= 4 * p_.error) return;
    // A trigonometric polynomial of degree n < points / 4 changes, from an angle to the nearest of angles that are
    // pi / points apart, by less than (pi / 8) 1.09 most < 0.43 most (S. N. Bernstein).
    if (least > 0.44 * most + 1.5 * p_.error) return append(left, right, sign_of(value_[0]));
    if (width < kNarrowest * (p_.end - p_.begin)) return;
    const double at_middle = at(middle);
    visit(left, middle, at_left, at_middle);
    visit(middle, right, at_middle, at_right);
  }

  static int sign_of(double value) { return value > 0 ? 1 : -1; }

  const EvaluatedPolynomial& p_;
  double curvature_ = 0;  // bound on the second derivative
  std::vector<double> unit_, x_, value_;
  std::vector<SignStretch> found_;
};

}  // namespace

std::vector<SignStretch> sign_stretches(const EvaluatedPolynomial& polynomial) {
  return Halving(polynomial).stretches();
}

}  // namespace moire
