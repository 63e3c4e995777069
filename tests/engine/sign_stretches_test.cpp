// Signs of polynomials whose zeros are known.
#include "engine/sign_stretches.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/hash.h"

using namespace moire;

namespace {

// The product of (x - zero) over [-1, 1].
EvaluatedPolynomial product(const std::vector<double>& zeros) {
  EvaluatedPolynomial p;
  p.at = [zeros](std::span<const double> x, double* out) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      out[i] = 1;
      for (const double z : zeros) out[i] *= x[i] - z;
    }
  };
  p.degree = static_cast<int>(zeros.size());
  p.begin = -1;
  p.end = 1;
  p.largest = 1;
  for (const double z : zeros) p.largest *= 1 + std::fabs(z);
  p.error = 0x1p-52 * p.degree * p.largest;  // a difference and a product for each zero
  return p;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a sign changes at every simple zero and nowhere else") {
    const std::vector<std::vector<double>> cases{{},           {0.3},         {-0.5, 0.5},       {-0.9, 0.1, 0.100001},
                                                 {2, -3, 0.7}, {-0.25, 0, 4}, {1e-6, -1e-6, 0.5}};
    for (const auto& zeros : cases) {
      const EvaluatedPolynomial p = product(zeros);
      std::vector<double> inside;
      for (const double z : zeros) {
        if (std::fabs(z) < 1) inside.push_back(z);
      }
      std::sort(inside.begin(), inside.end());
      const auto found = sign_stretches(p);
      REQUIRE(found.size() == inside.size() + 1);
      CHECK(found.front().begin == -1);
      CHECK(found.back().end == 1);
      for (std::size_t i = 0; i + 1 < found.size(); ++i) {
        CHECK(found[i].end == found[i + 1].begin);
        CHECK(found[i].sign == -found[i + 1].sign);
        // Where the value is as large as its error, and rounded.
        double slope = 1;
        for (const double z : zeros) slope *= z == inside[i] ? 1 : std::fabs(inside[i] - z);
        CHECK(std::fabs(found[i].end - inside[i]) <= 2 * p.error / slope + 0x1p-52);
      }
    }
  }

  TEST_CASE("zeros that only touch, and zeros at the ends, change no sign") {
    for (const std::vector<double>& zeros :
         {std::vector<double>{0.3, 0.3}, {1}, {-1}, {1, 1, 1}, {-1, -1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1}}) {
      const EvaluatedPolynomial p = product(zeros);
      const auto found = sign_stretches(p);
      REQUIRE(found.size() == 1);
      CHECK(found[0].begin == -1);
      CHECK(found[0].end == 1);
      double at_zero = 0, zero = 0.01;
      p.at({&zero, 1}, &at_zero);
      CHECK(found[0].sign * at_zero > 0);
    }
  }

  TEST_CASE("what is no larger than its error has no sign") {
    EvaluatedPolynomial p = product({0.5});
    p.error = 3;
    CHECK(sign_stretches(p).empty());
  }

  TEST_CASE("random zeros, some close together: the sign is right wherever the value is above the error") {
    int wrong = 0, seen = 0;
    for (std::uint64_t turn = 0; turn < 200; ++turn) {
      std::vector<double> zeros;
      const auto count = 1 + turn % 12;
      for (std::uint64_t i = 0; i < count; ++i) {
        const double z = 2.4 * unit_from_digits(mix64(100 * turn + i) >> 12) - 1.2;
        zeros.push_back(i % 3 == 2 ? zeros.back() + 1e-4 * z : z);
      }
      const EvaluatedPolynomial p = product(zeros);
      const auto found = sign_stretches(p);
      for (int i = 0; i < 300; ++i) {
        const double x = -1 + 2 * (i + 0.5) / 300;
        double value = 0;
        p.at({&x, 1}, &value);
        if (std::fabs(value) <= 6 * p.error) continue;
        const auto at = std::find_if(found.begin(), found.end(), [&](const SignStretch& s) { return x < s.end; });
        REQUIRE(at != found.end());
        ++seen;
        wrong += at->sign * value < 0;
      }
    }
    CHECK(seen > 50'000);
    CHECK(wrong == 0);
  }
}
