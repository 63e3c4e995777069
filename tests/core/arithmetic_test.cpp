// Double-double, exact signs and compensated sums against 113-bit arithmetic.
#include <doctest/doctest.h>
#include <quadmath.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "core/dd_math.h"
#include "core/double_double.h"
#include "core/expansion.h"
#include "core/sum.h"

namespace {

using moire::Dd;
using Quad = __float128;

Quad quad(Dd a) { return Quad(a.hi) + Quad(a.lo); }

double relative(Dd got, Quad want) { return static_cast<double>(fabsq((quad(got) - want) / want)); }

// Doubles of very different sizes.
double any_double(std::mt19937_64& random, int range) {
  std::uniform_real_distribution<double> mantissa(-2, 2);
  std::uniform_int_distribution<int> exponent(-range, range);
  return std::ldexp(mantissa(random), exponent(random));
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("double-double sums, products and quotients keep their published error bounds") {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20000; ++i) {
      const Dd a = moire::two_sum(any_double(random, 20), any_double(random, 20) * 0x1p-50);
      const Dd b = moire::two_sum(any_double(random, 20), any_double(random, 20) * 0x1p-50);
      // The reference itself rounds each operand to 113 bits.
      const Quad sum = quad(a) + quad(b), rounding = (fabsq(quad(a)) + fabsq(quad(b))) * 0x1p-112;
      CHECK(fabsq(quad(a + b) - sum) <= fabsq(sum) * (3 * 0x1p-106) + rounding);
      CHECK(relative(a * b, quad(a) * quad(b)) <= 5 * 0x1p-106 * 1.01);
      CHECK(relative(a / b, quad(a) / quad(b)) <= 10 * 0x1p-106 * 1.1);
    }
  }

  TEST_CASE("every 64-bit integer becomes a double-double exactly") {
    std::mt19937_64 random(2);
    for (int i = 0; i < 10000; ++i) {
      const auto n = static_cast<std::int64_t>(random() >> (random() % 60));
      for (const std::int64_t v : {n, -n}) CHECK(quad(moire::dd_from_integer(v)) == Quad(v));
    }
    for (const std::int64_t v : {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
      CHECK(quad(moire::dd_from_integer(v)) == Quad(v));
    }
  }

  TEST_CASE("sine, cosine and exponential have 94 bits or more") {
    for (int q = 1; q <= 60; ++q) {
      for (int p = 0; p <= q; ++p) {
        const Quad want = cosq(acosq(Quad(-1)) * p / q);
        CHECK(static_cast<double>(fabsq(quad(moire::dd_cos_pi(p, q)) - want)) <= 0x1p-98);
      }
    }
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> angle(-0.8, 0.8), power(-40, 40);
    for (int i = 0; i < 2000; ++i) {
      const Dd a(angle(random)), x(power(random));
      CHECK(static_cast<double>(fabsq(quad(moire::dd_cos_sin(a).sin) - sinq(quad(a)))) <= 0x1p-100);
      CHECK(static_cast<double>(fabsq(quad(moire::dd_cos_sin(a).cos) - cosq(quad(a)))) <= 0x1p-100);
      CHECK(relative(moire::dd_exp(x), expq(quad(x))) <= 0x1p-94);
    }
  }

  TEST_CASE("the modified Bessel function has 95 bits") {
    for (const double x : {0.0, 1e-9, 0.5, 2.0, 6.5, 12.25, 32.0, 64.0}) {
      // The mean of exp(x cos(t)) over the circle: the plain sum over n points misses it by 2 I_n(x), which is below
      // 2 (x / 2)^n / n! e^(x / 2) and so below 2^-200 for all x here.
      constexpr int n = 400;
      Quad sum = 0;
      for (int i = 0; i < n; ++i) sum += expq(Quad(x) * cosq(2 * acosq(Quad(-1)) * i / n));
      CHECK(relative(moire::dd_bessel_i0_of_root(Dd(x) * Dd(x)), sum / n) <= 0x1p-95);
    }
  }

  TEST_CASE("the sign of a sum of products is exact where doubles cancel completely") {
    std::mt19937_64 random(4);
    for (int i = 0; i < 5000; ++i) {
      // a b + c d - a b - c d + tiny, in a random order of sizes: only `tiny` is left.
      const double a = any_double(random, 60), b = any_double(random, 60), c = any_double(random, 60),
                   d = any_double(random, 60);
      const double tiny = (i % 3 - 1) * std::ldexp(1.0, -300);
      moire::Expansion sum;
      sum.add_product(a, b);
      sum.add(tiny);
      sum.add_product(c, d);
      sum.add_product(-b, a);
      sum.add_product(d, -c);
      CHECK(sum.sign() == i % 3 - 1);
    }
    CHECK(moire::Expansion{}.sign() == 0);
  }

  TEST_CASE("a compensated sum does not notice zeros and survives cancellation") {
    std::mt19937_64 random(5);
    moire::Sum plain, zeros;
    Quad want = 0;
    for (int i = 0; i < 10000; ++i) {
      const double x = any_double(random, 30);
      plain.add(x);
      zeros.add(0.0);
      zeros.add(x);
      want += x;
    }
    CHECK(plain.value() == zeros.value());
    // n^2 2^-106 times the largest partial sums, far below an ulp of the result here.
    CHECK(plain.value() == doctest::Approx(static_cast<double>(want)).epsilon(1e-15));
    moire::Sum cancelled;
    for (const double x : {1e16, 1.0, -1e16}) cancelled.add(x);
    CHECK(cancelled.value() == 1.0);
  }
}
