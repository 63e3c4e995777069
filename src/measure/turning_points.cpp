// Turning points and sign changes by bisection between samples that are denser than the series' nodes.
#include "measure/turning_points.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace moire {
namespace {

// The cosines of all multiples of pi / (2m).
class Cosines {
 public:
  explicit Cosines(int m) : m_(m), table_(static_cast<std::size_t>(4 * m)) {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      table_[i] = std::cos(std::numbers::pi * static_cast<double>(i) / (2.0 * m));
    }
  }
  double at(std::int64_t multiple) const { return table_[static_cast<std::size_t>(multiple % (4 * m_))]; }

 private:
  std::int64_t m_;
  std::vector<double> table_;
};

// Chebyshev coefficients on [-1, 1], t = 1 at x = b, of the slope of f with respect to t.
std::vector<double> slope_series(const std::function<double(double)>& f, int degree, double a, double b) {
  const int m = degree + 1;
  const Cosines cosine(m);
  std::vector<double> c(static_cast<std::size_t>(m), 0.0);
  for (int i = 0; i < m; ++i) {
    const double value = f(0.5 * (a + b) + 0.5 * (b - a) * cosine.at(2 * i + 1));
    for (int j = 0; j < m; ++j) {
      c[static_cast<std::size_t>(j)] += (j == 0 ? 1.0 : 2.0) / m * value * cosine.at(std::int64_t{j} * (2 * i + 1));
    }
  }
  // d_{j-1} = d_{j+1} + 2 j c_j, and half of that for d_0.
  std::vector<double> d(static_cast<std::size_t>(m) + 1, 0.0);
  for (std::size_t j = c.size(); j-- > 1;) d[j - 1] = d[j + 1] + 2.0 * static_cast<double>(j) * c[j];
  d[0] *= 0.5;
  d.resize(c.size());
  return d;
}

double evaluate(const std::vector<double>& c, double t) {
  double b1 = 0, b2 = 0;
  for (std::size_t j = c.size(); j-- > 1;) {
    const double b = c[j] + (2 * t * b1 - b2);
    b2 = b1;
    b1 = b;
  }
  return c[0] + (t * b1 - b2);
}

// Where f changes sign between `low`, where it is negative exactly if `low_negative`, and `high`.
template <class F>
double bisect(const F& f, double low, double high, bool low_negative) {
  for (;;) {
    const double mid = low + 0.5 * (high - low);
    if (mid <= low || mid >= high) return mid;
    const double value = f(mid);
    if (value == 0) return mid;
    ((value < 0) == low_negative ? low : high) = mid;
  }
}

}  // namespace

std::vector<double> turning_points(const std::function<double(double)>& f, int degree, double a, double b) {
  assert(degree >= 0 && a < b);
  std::vector<double> found;
  if (degree < 2) return found;
  const std::vector<double> slope = slope_series(f, degree, a, b);
  const auto at = [&](double t) { return evaluate(slope, t); };
  // A slope of exactly zero has no sign: the last one that had counts.
  const int samples = 4 * degree;
  double before = -1, value_before = at(-1);
  for (int i = 1; i <= samples; ++i) {
    const double t = i == samples ? 1.0 : -std::cos(std::numbers::pi * i / samples), value = at(t);
    if (value == 0) continue;
    if (value_before != 0 && (value < 0) != (value_before < 0)) {
      const double x = 0.5 * (a + b) + 0.5 * (b - a) * bisect(at, before, t, value_before < 0);
      if (x > a && x < b) found.push_back(x);
    }
    before = t;
    value_before = value;
  }
  return found;
}

std::vector<double> sign_changes(const std::function<double(double)>& f, int degree, double a, double b) {
  // Between turning points f is monotone: one change at most.
  std::vector<double> stops = turning_points(f, degree, a, b), found;
  stops.push_back(b);
  double before = a, value_before = f(a);
  for (const double x : stops) {
    const double value = f(x);
    if (value == 0) continue;
    if (value_before != 0 && (value < 0) != (value_before < 0)) {
      const double root = bisect(f, before, x, value_before < 0);
      if (root > a && root < b) found.push_back(root);
    }
    before = x;
    value_before = value;
  }
  return found;
}

}  // namespace moire
