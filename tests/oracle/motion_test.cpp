// Means over time against what motion does to simple scenes.
#include "oracle/motion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "oracle/coverage.h"
#include "oracle/filtered.h"

namespace moire::oracle {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("an edge that crosses a pixel from side to side covers half of it on average") {
    const Value v = moving(Kernel("box"), Edge{{0, 0.3}, {1, 0}}, {1, 0}, {0, 0});
    CHECK(std::fabs(v.value - 0.5L) <= v.error);
    CHECK(v.error < 1e-16L);
  }

  TEST_CASE("an edge that moves along itself has its still value") {
    for (const char* text : {"box", "tent", "mitchell"}) {
      const Kernel k(text);
      const Edge edge{{0.25, 0.5}, {3, 4}};
      const Value still = filtered(k, edge, {0, 0}), v = moving(k, edge, {8, -6}, {0, 0});
      CHECK(std::fabs(v.value - still.value) <= v.error + still.error);
    }
  }

  TEST_CASE("an edge that moves one way and one that moves the other way from its end have the same mean") {
    for (const char* text : {"box", "tent", "mitchell"}) {
      const Kernel k(text);
      const Edge start{{-0.25, 0.5}, {0.75, 0.5}}, end{{1.25, 0.75}, {0.75, 0.5}};
      const Value there = moving(k, start, {1.5, 0.25}, {0, 0}), back = moving(k, end, {-1.5, -0.25}, {0, 0});
      CHECK(std::fabs(there.value - back.value) <= there.error + back.error);
      CHECK(there.error < 1e-15L);
    }
  }

  TEST_CASE("a disk that flies through a pixel leaves its area times the time that each of its points is there") {
    for (const double r : {1e-6, 0.1, 0.45}) {
      const Value v = moving(Disk{{-0.5, 0.5}, r}, {2, 0}, {0, 0}, 1);
      const auto square = static_cast<long double>(r) * static_cast<long double>(r);
      CHECK(std::fabs(v.value - kPi * square / 2) <= v.error + 1e-18L * square);
      CHECK(v.error < 1e-16L);
    }
  }

  TEST_CASE("a disk that hardly moves has its still value") {
    const Disk disk{{0.9, 0.8}, 0.7};
    const Value v = moving(disk, {1e-18, 0}, {0, 0}, 1), still = coverage(disk, {0, 0}, 1);
    CHECK(std::fabs(v.value - still.value) <=
          v.error + still.error + 2e-18L);  // no value changes by more than it moves
  }
}

}  // namespace moire::oracle
