// The terms g_j of a radial weight by another way than the product's: Taylor series in time along the flow that keeps v
// constant (checker_series.h), in 34 digits, and with complex numbers where bounds speak of complex points.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "filters/filter.h"
#include "filters/radial_kernel.h"
#include "oracle/quad.h"
#include "testimages/board_frame.h"
#include "testimages/euler_polynomials.h"
#include "testimages/radial_rings.h"

namespace moire::test {

inline constexpr std::size_t kJet = kMaxTerms + 1;

// The first Taylor coefficients of a function of one variable.
template <class T>
using Jet = std::array<T, kJet>;

// A number as a T; what is no quad is rounded to 64 bits.
template <class T>
T number(oracle::Quad x) {
  if constexpr (std::is_same_v<T, oracle::Quad>) {
    return x;
  } else {
    return oracle::narrow(x);
  }
}
template <class T>
T number(double x) {
  return number<T>(oracle::widen(x));
}

template <class T>
Jet<T> constant(const T& c) {
  Jet<T> out{};
  out[0] = c;
  return out;
}

template <class T>
Jet<T> plus(const Jet<T>& a, const Jet<T>& b) {
  Jet<T> out{};
  for (std::size_t i = 0; i < kJet; ++i) out[i] = a[i] + b[i];
  return out;
}

template <class T>
Jet<T> times(const T& factor, const Jet<T>& a) {
  Jet<T> out{};
  for (std::size_t i = 0; i < kJet; ++i) out[i] = factor * a[i];
  return out;
}

template <class T>
Jet<T> product(const Jet<T>& a, const Jet<T>& b) {
  Jet<T> out{};
  for (std::size_t i = 0; i < kJet; ++i)
    for (std::size_t l = 0; l <= i; ++l) out[i] += a[l] * b[i - l];
  return out;
}

// The root whose value at 0 is `first`.
template <class T>
Jet<T> root(const Jet<T>& a, const T& first) {
  Jet<T> out{};
  out[0] = first;
  for (std::size_t i = 1; i < kJet; ++i) {
    T rest = a[i];
    for (std::size_t l = 1; l < i; ++l) rest -= out[l] * out[i - l];
    out[i] = rest / (first + first);
  }
  return out;
}

// One piece of k, as the polynomial that its doubles say, of r as a jet.
template <class T>
Jet<T> piece_of(const PieceWeight& piece, const Jet<T>& r) {
  const T low = number<T>(piece.low), high = number<T>(piece.high), two = number<T>(2.0);
  Jet<T> t = times(two / (high - low), r);
  t[0] -= (high + low) / (high - low);
  const Jet<T> twice = times(two, t);
  Jet<T> b1{}, b2{};
  for (std::size_t k = piece.series.size(); k-- > 1;) {
    Jet<T> b = plus(product(twice, b1), times(number<T>(-1.0), b2));
    b[0] += number<T>(piece.series[k]);
    b2 = b1;
    b1 = b;
  }
  Jet<T> out = plus(product(t, b1), times(number<T>(-1.0), b2));
  out[0] += number<T>(piece.series[0]);
  return out;
}

// What the flow needs of a homography: dp/du = W (G - e p), dW/du = -e W^2; G and e times `deepest`, as RadialTerms has
// them, from the rows in 34 digits.
struct Flow {
  oracle::Quad gx, gy, e;

  Flow(const BoardFrame& frame, double deepest) {
    using oracle::Quad;
    const auto wide = [](const Dd& d) { return Quad(d.hi) + Quad(d.lo); };
    const LocalHomography::Row &s = frame.smooth, &j = frame.jump, &w = frame.w;
    using oracle::widen;
    const Quad sa = widen(s.a), sb = widen(s.b), sc = wide(s.c), ja = widen(j.a), jb = widen(j.b), jc = wide(j.c),
               wa = widen(w.a), wb = widen(w.b), wc = wide(w.c);
    // First column of the inverse.
    const Quad x = jb * wc - jc * wb, y = jc * wa - ja * wc, z = ja * wb - jb * wa;
    const Quad det = sa * x + sb * y + sc * z;
    gx = x / det * Quad(deepest), gy = y / det * Quad(deepest), e = z / det * Quad(deepest);
  }
};

// All g_j at the point p, `r` its distance: k W^3 as a series in u from p on, where W = 1; its j-th derivative is
// (-1)^j g_j.
template <class T>
Jet<T> flow_terms(const Flow& flow, const PieceWeight& piece, const T& x, const T& y, const T& r) {
  const T gx = number<T>(flow.gx), gy = number<T>(flow.gy), e = number<T>(flow.e);
  Jet<T> px = constant(x), py = constant(y), w = constant(number<T>(1.0));
  for (std::size_t i = 0; i + 1 < kJet; ++i) {
    // Coefficient i of W (G - e p) and of -e W^2: only coefficients up to i of each are needed.
    T fx = gx * w[i], fy = gy * w[i], fw = number<T>(0.0);
    for (std::size_t l = 0; l <= i; ++l) {
      fx -= e * w[l] * px[i - l];
      fy -= e * w[l] * py[i - l];
      fw -= e * w[l] * w[i - l];
    }
    const T next = number<T>(static_cast<double>(i + 1));
    px[i + 1] = fx / next;
    py[i + 1] = fy / next;
    w[i + 1] = fw / next;
  }
  const Jet<T> square = plus(product(px, px), product(py, py));
  Jet<T> g = product(piece_of(piece, root(square, r)), product(w, product(w, w)));
  T factorial = number<T>(1.0);
  for (std::size_t j = 1; j < kJet; ++j) {
    factorial *= number<T>(-static_cast<double>(j));
    g[j] *= factorial;
  }
  return g;
}

// A radial filter as scenes see it. In place: a RadialWeight does not move.
struct SeenFilter {
  Filter filter;
  RadialWeight weight;

  explicit SeenFilter(const std::string& text)
      : filter(parse_spec(text, "test")), weight(pieces_of(filter.radial_kernel()), WeightBounds{}) {}
  SeenFilter(const SeenFilter&) = delete;
  SeenFilter& operator=(const SeenFilter&) = delete;
  ~SeenFilter() = default;

 private:
  static std::vector<PieceWeight> pieces_of(const RadialKernel& kernel) {
    std::vector<PieceWeight> pieces;
    for (int p = 0; p < kernel.pieces(); ++p) {
      const auto i = static_cast<std::size_t>(p);
      const RadialKernel::PieceBounds& bounds = kernel.bounds(p);
      pieces.push_back({kernel.knots()[i], kernel.knots()[i + 1], kernel.k_series(p), bounds.k, bounds.k_error});
    }
    return pieces;
  }
};

}  // namespace moire::test
