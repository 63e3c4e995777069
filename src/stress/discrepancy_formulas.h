// Discrepancies of weighted points term by term, for any type of number: the truth in more bits than double has, and
// what plain double arithmetic makes of the same formulas.
//
// Sources: Warnock 1972 (star); Alexander 1991 for isotropic lines; for the printed ones and the disks the integrals of
// the probability that two points are parted. Formulas as they are derived, not as the program arranges them.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include "oracle/quad.h"
#include "stress/weighted_points.h"

namespace moire::stress {

// Sum over ordered pairs of places of term(i, j), times both counts, over N^2; rows are added as wholes.
template <class T, class Term>
T mean_over_pairs(const WeightedPoints& w, const Term& term) {
  T all = 0;
  for (std::size_t i = 0; i < w.places(); ++i) {
    T row = 0;
    for (std::size_t j = 0; j < w.places(); ++j) row += static_cast<T>(w.count[j]) * term(i, j);
    all += static_cast<T>(w.count[i]) * row;
  }
  const T n = static_cast<T>(w.points());
  return all / (n * n);
}
template <class T, class Term>
T mean_over_points(const WeightedPoints& w, const Term& term) {
  T all = 0;
  for (std::size_t i = 0; i < w.places(); ++i) all += static_cast<T>(w.count[i]) * term(i);
  return all / static_cast<T>(w.points());
}

// 3^-k - 2^(1-k) mean prod (1 - x^2) + mean prod (1 - max).
template <class T>
T star_l2_formula(const WeightedPoints& w, int dims) {
  const auto larger = [](double a, double b) { return static_cast<T>(a > b ? a : b); };
  const T linear = mean_over_points<T>(w, [&](std::size_t i) {
    const T x = static_cast<T>(w.x[i]), y = static_cast<T>(w.y[i]), t = static_cast<T>(w.t[i]);
    const T box = (1 - x * x) * (1 - y * y);
    return dims == 3 ? box * (1 - t * t) : box;
  });
  const T pairs = mean_over_pairs<T>(w, [&](std::size_t i, std::size_t j) {
    const T box = (1 - larger(w.x[i], w.x[j])) * (1 - larger(w.y[i], w.y[j]));
    return dims == 3 ? box * (1 - larger(w.t[i], w.t[j])) : box;
  });
  return T(1) / T(dims == 3 ? 27 : 9) - linear / T(dims == 3 ? 4 : 2) + pairs;
}

// The larger part of a box that closed counts overfill and open ones leave empty.
template <class T>
T star_linf_formula(const WeightedPoints& w) {
  const T n = static_cast<T>(w.points());
  T worst = 0;
  for (std::size_t i = 0; i <= w.places(); ++i) {
    for (std::size_t j = 0; j <= w.places(); ++j) {
      const double x = i < w.places() ? w.x[i] : 1, y = j < w.places() ? w.y[j] : 1;
      std::uint64_t closed = 0, open = 0;
      for (std::size_t k = 0; k < w.places(); ++k) {
        if (w.x[k] <= x && w.y[k] <= y) closed += w.count[k];
        if (w.x[k] < x && w.y[k] < y) open += w.count[k];
      }
      const T area = static_cast<T>(x) * static_cast<T>(y);
      const T full = static_cast<T>(closed) / n - area, empty = area - static_cast<T>(open) / n;
      worst = full > worst ? full : worst;
      worst = empty > worst ? empty : worst;
    }
  }
  return worst;
}

// --- Edges: 4-corner sums of the integral over a rectangle of what depends on the distance to its corner ---

template <class T, class Corner>
T four_corners(const Corner& corner, double x, double y) {
  const T a = static_cast<T>(x), b = static_cast<T>(y);
  return corner(a, b) + corner(1 - a, b) + corner(a, 1 - b) + corner(1 - a, 1 - b);
}

template <class T>
T distance_integral(T a, T b) {
  if (a == 0 || b == 0) return 0;
  return a * b * std::sqrt(a * a + b * b) / 3 + (a * a * a * std::asinh(b / a) + b * b * b * std::asinh(a / b)) / 6;
}

template <class T>
T edge_l2_formula(const WeightedPoints& w) {
  const T to_square =
      mean_over_points<T>(w, [&](std::size_t i) { return four_corners<T>(distance_integral<T>, w.x[i], w.y[i]); });
  const T to_each_other = mean_over_pairs<T>(w, [&](std::size_t i, std::size_t j) {
    const T dx = static_cast<T>(w.x[i]) - static_cast<T>(w.x[j]), dy = static_cast<T>(w.y[i]) - static_cast<T>(w.y[j]);
    return std::sqrt(dx * dx + dy * dy);
  });
  const T square = (2 + std::sqrt(T(2)) + 5 * std::log(1 + std::sqrt(T(2)))) / 15;
  return (2 * to_square - to_each_other - square) / 4;
}

// h, the probability that the printed generator's line parts two points, and its integral over y from 0 to b.
template <class T>
T separation(T dx, T dy) {
  const T p = std::fabs(dx), q = std::fabs(dy), u = p > q ? p : q, v = p > q ? q : p;
  return u == 0 ? T(0) : ((u - v) + (u + v) * std::log1p(v / u)) / 2;
}
template <class T>
T separation_strip(T a, T b) {
  if (a == 0) return b * b / 4;
  const T sum = a + b, two = 2 * a * a * std::numbers::ln2_v<T>;
  if (b <= a) return (a * b / 2 - 3 * b * b / 4 + sum * sum / 2 * std::log1p(b / a)) / 2;
  return (-a * a / 4 + two) / 2 + ((b - a) * (b - a) / 2 + sum * sum / 2 * std::log1p(a / b) - two + a * (b - a) / 2 +
                                   a * a / 2 * std::log(b / a)) /
                                      2;
}
template <class T>
T separation_integral(T a, T b) {
  return (a * separation_strip(a, b) + b * separation_strip(b, a)) / 3;
}

template <class T>
T edge_printed_formula(const WeightedPoints& w) {
  const T to_square =
      mean_over_points<T>(w, [&](std::size_t i) { return four_corners<T>(separation_integral<T>, w.x[i], w.y[i]); });
  const T to_each_other = mean_over_pairs<T>(w, [&](std::size_t i, std::size_t j) {
    return separation(static_cast<T>(w.x[i]) - static_cast<T>(w.x[j]), static_cast<T>(w.y[i]) - static_cast<T>(w.y[j]));
  });
  const T square = (24 * std::numbers::ln2_v<T> - 5) / 45;
  return (2 * to_square - to_each_other - square) / 2;
}

// --- Disks on the torus ---

// The area that two disks of radius r have in common, d apart. The quotient c is rounded once for both terms: their
// difference changes by 2 sqrt(1 - c^2) of that, while an arc cosine alone would lose half the digits near c = 1.
template <class T>
T common_area(T d, T r) {
  const T c = d / (2 * r);
  if (c >= 1) return 0;
  return 2 * r * r * (std::acos(c) - c * std::sqrt((1 - c) * (1 + c)));
}
// Its integral over radii from d / 2 to r.
template <class T>
T common_area_integral(T d, T r) {
  const T a = d / 2;
  if (a >= r) return 0;
  if (a == 0) return std::numbers::pi_v<T> * r * r * r / 3;
  const T s = std::sqrt((r - a) * (r + a));
  return 2 * r * r * r * std::acos(a / r) / 3 - 4 * a * r * s / 3 + 2 * a * a * a * std::log((r + s) / a) / 3;
}

// Differences of doubles across a side of the square take more than 64 bits: rounded, they are another distance to tiny
// disks. The textbook has double alone.
template <class T, class Overlap>
T mean_overlap(const WeightedPoints& w, const Overlap& overlap) {
  using Difference = std::conditional_t<std::is_same_v<T, double>, double, oracle::Quad>;
  return mean_over_pairs<T>(w, [&](std::size_t i, std::size_t j) {
    T sum = 0;
    for (int image = 0; image < 9; ++image) {
      const T dx = static_cast<T>(static_cast<Difference>(w.x[i]) - static_cast<Difference>(w.x[j]) + (image % 3 - 1));
      const T dy = static_cast<T>(static_cast<Difference>(w.y[i]) - static_cast<Difference>(w.y[j]) + (image / 3 - 1));
      sum += overlap(std::sqrt(dx * dx + dy * dy));
    }
    return sum;
  });
}

// Of one radius up to 1/2; and of radii uniform in [0, 1/2].
template <class T>
T disk_l2_formula(const WeightedPoints& w, double radius) {
  const T r = static_cast<T>(radius), area = std::numbers::pi_v<T> * r * r;
  return mean_overlap<T>(w, [r](T d) { return common_area(d, r); }) - area * area;
}
template <class T>
T disk_l2_formula(const WeightedPoints& w) {
  const T r = T(1) / 2, pi = std::numbers::pi_v<T>;
  return 2 * mean_overlap<T>(w, [r](T d) { return common_area_integral(d, r); }) - pi * pi / 80;
}

}  // namespace moire::stress
