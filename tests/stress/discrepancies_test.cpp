// Formulas of discrepancies on sets whose values are known, and the family.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "numbers_checks.h"
#include "stress/discrepancy_formulas.h"
#include "stress/half_plane_search.h"

using namespace moire;
using namespace moire::stress;

namespace moire::stress {
extern const Family discrepancies;
}

namespace {

WeightedPoints one(double x, double y) { return {{x}, {y}, {0}, {7}}; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the formulas give what is known of points in one place") {
    constexpr long double kRounding = 0x1p-58L;  // some 60 roundings of 64 bits
    // At the origin every box holds all points: the mean of (1 - x y)^2 = 1 - 1/2 + 1/9.
    CHECK(std::fabs(oracle::narrow(star_l2_formula<oracle::Quad>(one(0, 0), 2)) - 11 / 18.0L) <= kRounding);
    CHECK(oracle::narrow(star_linf_formula<oracle::Quad>(one(0, 0))) == 1);
    // A half-plane through the centre has half the square, and all points in it.
    CHECK(std::fabs(oracle::narrow(HalfPlaneSearch(one(0.5, 0.5)).worst()) - 0.5L) <= 0x1p-64L);
    // In a corner: all points in no area.
    CHECK(oracle::narrow(HalfPlaneSearch(one(0, 0)).worst()) == 1);
    // E[A] - E[A^2] for a disk's area A, radius uniform: pi / 12 - pi^2 / 80.
    const long double pi = std::numbers::pi_v<long double>;
    CHECK(std::fabs(disk_l2_formula<long double>(one(0.3, 0.9)) - (pi / 12 - pi * pi / 80)) <= kRounding);
    CHECK(std::fabs(disk_l2_formula<long double>(one(0.3, 0.9), 0.5) - (pi / 4 - pi * pi / 16)) <= kRounding);
  }

  TEST_CASE("the formulas give the published values of Zaremba's 16 points") {
    // x = i / 16; y = i's four binary digits mirrored, every second one flipped, and the tail of a third of the last.
    WeightedPoints w;
    for (unsigned i = 0; i < 16; ++i) {
      unsigned digits = 0;
      for (unsigned k = 0; k < 4; ++k) digits = digits * 2 + ((i >> k & 1u) ^ (k & 1u));
      w.x.push_back(i / 16.0);
      w.y.push_back((digits + 1 / 3.0) / 16);
      w.t.push_back(0);
      w.count.push_back(1);
    }
    // T^2 = 6059 / 4718592, exactly, for y of infinitely many digits: rounded ones move it by 16 * 2^-54 at most.
    CHECK(std::fabs(oracle::narrow(star_l2_formula<oracle::Quad>(w, 2)) - 6059 / 4718592.0L) <= 0x1p-50L);
    // 15 digits are known of each T.
    CHECK(std::fabs(std::sqrt(edge_l2_formula<long double>(w)) - 3.92802931043459e-2L) <= 1e-15L);
    CHECK(std::fabs(std::sqrt(edge_printed_formula<long double>(w)) - 3.93463133468158e-2L) <= 1e-15L);
    CHECK(std::fabs(std::sqrt(disk_l2_formula<long double>(w)) - 4.60446154116311e-2L) <= 1e-15L);
    CHECK(std::fabs(oracle::narrow(HalfPlaneSearch(w).worst()) - 17 / 96.0L) <= 1e-15L);
  }

  // 300 from the first that has no large set: those are eight measures of seven kinds of sets.
  TEST_CASE("discrepancies of hard point sets keep their bounds") {
    for (std::uint64_t i = 56; i < 356; ++i) {
      const Outcome outcome = run_case(discrepancies, {1, i});
      CAPTURE(i);
      CHECK(passes(outcome));
    }
    // Bounds shrink with disks: an answer of 0 is none, however small the radius. (Two places across a side of the
    // square may be nearer than double tells.)
    std::uint64_t asked = 0, told = 0;
    for (std::uint64_t i = 56 + 7; i < 1000; i += 8) {
      const Outcome outcome = run_case(discrepancies, {1, i});
      ++asked;
      told += outcome.wanted > 1000 * (outcome.bound + outcome.oracle_error) ? 1 : 0;
    }
    CHECK(told >= asked - asked / 20);
    CHECK(discrepancies.describe({1, 57}).find("x,y,t") != std::string::npos);
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("discrepancies of up to 10^6 points of every kind keep their bounds") { check_family(discrepancies, 56); }
}
