// The reconstruction kernels by their published formulas, for any type of number: balls, to enclose the truth, and
// plain doubles, to see what the formulas lose.
//
// Sources as in oracle/shapes.cpp, where each is written for long double. T has + - * / with itself, is made of a
// double, and the functions of the first lines below.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "filters/filter.h"

namespace moire::stress {

// The textbook's functions in double arithmetic.
inline double pi_of(double) { return std::numbers::pi; }
inline double sin_pi(double x) { return std::sin(std::numbers::pi * x); }
inline double cos_pi(double x) { return std::cos(std::numbers::pi * x); }
inline double exp_of(double x) { return std::exp(x); }
inline double sinc_of(double x) { return x == 0 ? 1 : std::sin(x) / x; }
inline double sinc_pi(double x) { return sinc_of(std::numbers::pi * x); }
inline double bessel_i0_of_root(double s) { return std::cyl_bessel_i(0.0, std::sqrt(std::fmax(s, 0.0))); }
inline double jinc(double x) {
  return x == 0 ? 1 : 2 * std::cyl_bessel_j(1.0, std::numbers::pi * x) / (std::numbers::pi * x);
}

// The right half of an even kernel, or a radial one, on no particular scale: entire between its breaks, the first 0 and
// the last the radius. shape(piece, x) between breaks[piece] and the next.
template <class T>
struct Form {
  std::vector<double> breaks;
  std::function<T(int piece, const T& x)> shape;
};

// --- Piecewise polynomials ---

// The B-spline of that degree by the recurrence of de Boor and Cox, on the cell that `middle` lies in.
template <class T>
T bspline_value(int degree, const T& x, double middle) {
  const double r = 0.5 * (degree + 1);
  if (std::fabs(middle) >= r) return T(0.0);
  const T s = T(r) - (middle < 0 ? T(0.0) - x : x);
  const int cell = static_cast<int>(r - std::fabs(middle));
  std::vector<T> b(static_cast<std::size_t>(degree) + 2, T(0.0));
  b[static_cast<std::size_t>(cell)] = T(1.0);
  for (int d = 1; d <= degree; ++d) {
    for (int i = 0; i <= degree - d; ++i) {
      const auto at = static_cast<std::size_t>(i);
      b[at] = ((s - T(i)) * b[at] + (T(i + d + 1) - s) * b[at + 1]) / T(d);
    }
  }
  return b[0];
}

inline double middle_of(const std::vector<double>& breaks, int piece) {
  const auto i = static_cast<std::size_t>(piece);
  return 0.5 * (breaks[i] + breaks[i + 1]);
}

// 0, first, first + 1, ..., radius.
inline std::vector<double> unit_steps(double first, double radius) {
  std::vector<double> breaks{0};
  for (double x = first; x <= radius; ++x) breaks.push_back(x);
  return breaks;
}

template <class T>
Form<T> bspline_form(int degree) {
  Form<T> f{unit_steps(degree % 2 == 0 ? 0.5 : 1.0, 0.5 * (degree + 1)), {}};
  f.shape = [degree, breaks = f.breaks](int piece, const T& x) {
    return bspline_value(degree, x, middle_of(breaks, piece));
  };
  return f;
}

// Mitchell and Netravali 1988, eq. 8.
template <class T>
Form<T> bc_form(const T& b, const T& c, double radius) {
  const auto shape = [b, c, radius](int piece, const T& at) {
    const T x = at * T(2.0) / T(radius);
    if (piece == 0) {
      return (((T(12.0) - T(9.0) * b - T(6.0) * c) * x + (T(12.0) * b + T(6.0) * c - T(18.0))) * x * x + T(6.0) -
              T(2.0) * b) /
             T(6.0);
    }
    return ((((T(0.0) - b - T(6.0) * c) * x + (T(6.0) * b + T(30.0) * c)) * x - (T(12.0) * b + T(48.0) * c)) * x +
            T(8.0) * b + T(24.0) * c) /
           T(6.0);
  };
  return {{0, radius / 2, radius}, shape};
}

// An exact 1/3 is understood for the double nearest to it (bc_cubic.h).
template <class T>
T bc_parameter(double v) {
  return v == 1.0 / 3 ? T(1.0) / T(3.0) : T(v);
}

template <class T>
Form<T> lagrange_form(int n) {
  const double first = n % 2 == 0 ? 0.5 : 1.0;
  Form<T> f{unit_steps(first, 0.5 * (n + 1)), {}};
  f.shape = [n](int piece, const T& x) {
    T product(1.0);
    for (int node = piece - n / 2; node <= piece - n / 2 + n; ++node) {
      if (node != 0) product = product * (x - T(node)) / T(-node);
    }
    return product;
  };
  return f;
}

// Blu, Thevenaz and Unser 2001: beta + beta'' / 42, beta the cubic B-spline.
template <class T>
Form<T> o_moms_form() {
  return {{0, 1, 2}, [](int piece, const T& x) {
            const T bend = piece == 0 ? T(3.0) * x - T(2.0) : T(2.0) - x;
            return bspline_value(3, x, piece + 0.5) + bend / T(42.0);
          }};
}

// What the datum at 0 contributes to the natural cubic spline through 2 n data, between its middle two.
template <class T>
Form<T> cubic_spline_form(int n) {
  const auto shape = [n](int piece, const T& x) {
    const auto size = static_cast<std::size_t>(2 * n - 2);
    const auto datum = [&](int i) { return piece - n + 1 + i == 0 ? 1 : 0; };
    std::vector<T> diagonal(size, T(4.0)), bend(size);
    for (std::size_t i = 0; i < size; ++i) {
      const int at = static_cast<int>(i);
      bend[i] = T(6 * (datum(at) - 2 * datum(at + 1) + datum(at + 2)));
    }
    for (std::size_t i = 1; i < size; ++i) {
      diagonal[i] = diagonal[i] - T(1.0) / diagonal[i - 1];
      bend[i] = bend[i] - bend[i - 1] / diagonal[i - 1];
    }
    for (std::size_t i = size; i-- > 0;) {
      if (i + 1 < size) bend[i] = bend[i] - bend[i + 1];
      bend[i] = bend[i] / diagonal[i];
    }
    const auto left = static_cast<std::size_t>(n) - 2;
    const T s = x - T(piece), t = T(1.0) - s;
    return T(datum(n - 1)) * t + T(datum(n)) * s +
           (bend[left] * (t * t - T(1.0)) * t + bend[left + 1] * (s * s - T(1.0)) * s) / T(6.0);
  };
  return {unit_steps(1, n), shape};
}

// Costella 2021: the quadratic B-spline under a row of weights over 144 or 4, the middle one first.
template <class T>
Form<T> magic_form(bool newer) {
  const std::vector<double> weights = newer ? std::vector<double>{204, -35, 6, -1} : std::vector<double>{6, -1};
  Form<T> f{unit_steps(0.5, newer ? 4.5 : 2.5), {}};
  f.shape = [weights, over = newer ? 144.0 : 4.0, breaks = f.breaks](int piece, const T& x) {
    const double middle = middle_of(breaks, piece);
    T sum = T(weights[0]) * bspline_value(2, x, middle);
    for (std::size_t i = 1; i < weights.size(); ++i) {
      const auto shift = static_cast<double>(i);
      sum = sum + T(weights[i]) *
                      (bspline_value(2, x - T(shift), middle - shift) + bspline_value(2, x + T(shift), middle + shift));
    }
    return sum / T(over);
  };
  return f;
}

// --- Bells, sincs and windows ---

template <class T>
Form<T> gaussian_form(double sigma, double radius, bool lowered) {
  const T w = T(2.0) * T(sigma) * T(sigma);
  const auto bell = [w](const T& x) { return exp_of(T(0.0) - x * x / w); };
  const T foot = lowered ? bell(T(radius)) : T(0.0);
  return {{0, radius}, [bell, foot](int, const T& x) { return bell(x) - foot; }};
}

// Harris 1978; the coefficients are the doubles nearest to the published ones.
template <class T>
T cosines(const std::vector<double>& a, const T& t) {
  T sum(a[0]);
  for (std::size_t m = 1; m < a.size(); ++m) sum = sum + T(a[m]) * cos_pi(T(static_cast<double>(m)) * t);
  return sum;
}
inline std::vector<double> blackman_harris_terms() { return {0.35875, 0.48829, 0.14128, 0.01168}; }

template <class T>
T window_value(std::string_view name, double beta, const T& t, bool outer) {
  if (name == "hann") return cosines({0.5, 0.5}, t);
  if (name == "hamming") return cosines({0.54, 0.46}, t);
  if (name == "blackman") return cosines({0.42, 0.5, 0.08}, t);
  if (name == "blackman-harris") return cosines(blackman_harris_terms(), t);
  if (name == "kaiser") {
    const T square = T(beta) * T(beta);
    return bessel_i0_of_root(square * (T(1.0) - t * t)) / bessel_i0_of_root(square);
  }
  if (name == "welch") return T(1.0) - t * t;
  if (name == "bohman") return (T(1.0) - t) * cos_pi(t) + sin_pi(t) / pi_of(t);
  if (name == "cosine") return cos_pi(t / T(2.0));
  if (name == "bartlett") return T(1.0) - t;
  if (name == "parzen") return bspline_value(3, T(2.0) * t, outer ? 1.5 : 0.5);
  throw std::invalid_argument("no form of window " + std::string(name));
}

template <class T>
Form<T> windowed_sinc_form(const std::string& window, double radius, double beta) {
  Form<T> f{{0, radius}, {}};
  if (window == "parzen") f.breaks = {0, radius / 2, radius};
  f.shape = [window, radius, beta](int piece, const T& x) {
    return sinc_pi(x) * window_value(window, beta, x / T(radius), piece > 0);
  };
  return f;
}

// sinc(x / blur) sinc(x / (blur a)), cut at `radius`.
template <class T>
Form<T> lanczos_form(double a, double blur, double radius) {
  return {{0, radius}, [a, blur](int, const T& x) {
            const T lobe = x / T(blur);
            return sinc_pi(lobe) * sinc_pi(lobe / T(a));
          }};
}

// `zero` and `last`: the first zero of the jinc and the one at which the kernel ends.
template <class T>
Form<T> jinc_form(double zero, double last, double blur) {
  return {{0, last * blur}, [=](int, const T& r) {
            const T lobe = r / T(blur);
            return jinc(lobe) * jinc(lobe * T(zero) / T(last));
          }};
}

}  // namespace moire::stress
