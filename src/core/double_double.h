// Arithmetic with about 106 bits: a number as the unevaluated sum of two doubles, |lo| <= ulp(hi) / 2.
//
// Dekker, "A floating-point technique for extending the available precision", 1971; error bounds from Joldes, Muller
// and Popescu, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44(2),
// 2017: relative error of + (accurate form) below 3 * 2^-106, of * below 5 * 2^-106, of / below 10 * 2^-106.
// Products must neither overflow nor come near the smallest normal number.
#pragma once

#include <cmath>
#include <cstdint>

namespace moire {

struct Dd {
  double hi = 0, lo = 0;
  constexpr Dd() = default;
  constexpr Dd(double h) : hi(h) {}  // NOLINT: a double is a Dd
  constexpr Dd(double h, double l) : hi(h), lo(l) {}
  // Within half an ulp plus 2^-106 of the number.
  constexpr double value() const { return hi + lo; }
};

// a + b = hi + lo exactly (Knuth).
inline Dd two_sum(double a, double b) {
  const double s = a + b;
  const double t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

// The same for |a| >= |b| or a = 0 (Dekker).
inline Dd quick_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

// a * b = hi + lo exactly. The fused multiply-add is explicit: it is the error-free transformation itself.
inline Dd two_prod(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

inline Dd operator-(Dd a) { return {-a.hi, -a.lo}; }

inline Dd operator+(Dd a, Dd b) {
  Dd s = two_sum(a.hi, b.hi);
  const Dd t = two_sum(a.lo, b.lo);
  s = quick_two_sum(s.hi, s.lo + t.hi);
  return quick_two_sum(s.hi, s.lo + t.lo);
}

inline Dd operator-(Dd a, Dd b) { return a + (-b); }

inline Dd operator*(Dd a, Dd b) {
  const Dd p = two_prod(a.hi, b.hi);
  return quick_two_sum(p.hi, p.lo + (std::fma(a.hi, b.lo, a.lo * b.hi)));
}

inline Dd operator/(Dd a, Dd b) {
  const double q = a.hi / b.hi;
  const Dd r = a - b * Dd(q);
  const double q2 = r.hi / b.hi;
  const Dd r2 = r - b * Dd(q2);
  return quick_two_sum(q, q2) + Dd(r2.hi / b.hi);
}

// Any 64-bit integer, exactly.
inline Dd dd_from_integer(std::int64_t i) {
  constexpr std::int64_t kHalf = std::int64_t{1} << 32;
  const std::int64_t high = i / kHalf;
  return quick_two_sum(static_cast<double>(high) * 0x1p32, static_cast<double>(i - high * kHalf));
}

}  // namespace moire
