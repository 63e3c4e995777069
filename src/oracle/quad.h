// Arithmetic of the oracle: 113-bit numbers for geometry, 64-bit long double for kernels.
//
// Translating a scene to a pixel's centre is exact in 113 bits for coordinates up to 2^60, and the rounding that is
// left, about 1e-34 of the largest coordinate, is 1e-22 pixel even for radii and distances of 1e12.
#pragma once

#include <cmath>
#include <cstdint>

namespace moire::oracle {

__extension__ typedef __float128 Quad;

// A value of the oracle and what it says of its own error (absolute).
struct Value {
  long double value = 0, error = 0;
  Value& operator+=(const Value& o) {
    value += o.value;
    error += o.error;
    return *this;
  }
};

struct Point {
  Quad x = 0, y = 0;
};

inline Quad abs(Quad a) { return a < 0 ? -a : a; }
inline Quad min(Quad a, Quad b) { return b < a ? b : a; }
inline Quad max(Quad a, Quad b) { return a < b ? b : a; }
inline long double narrow(Quad a) { return static_cast<long double>(a); }
inline Quad widen(long double a) { return static_cast<Quad>(a); }
inline Quad widen(double a) { return static_cast<Quad>(a); }

// Zero for a <= 0: callers ask for the half chord of a circle at any distance. One Newton step takes 64 bits to 113.
inline Quad sqrt(Quad a) {
  if (!(a > 0)) return 0;
  const Quad s = widen(std::sqrt(narrow(a)));
  if (s == 0) return 0;
  return (s + a / s) / 2;
}

// Coordinate `a` of the image relative to the centre of pixel number i.
inline Quad relative(double a, std::int64_t i) { return widen(a) - (static_cast<Quad>(i) + Quad(1) / 2); }

}  // namespace moire::oracle
