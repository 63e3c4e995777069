// Medians and deviations of timings.
#include "measure/timings.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace moire;

TEST_SUITE("unit") {
  TEST_CASE("the spread of timings is that of the sorted list, whatever their order") {
    // Sorted 1 2 4 8 100: median 4; distances 3 2 0 4 96, sorted 0 2 3 4 96.
    const TimingSpread odd = timing_spread(std::vector<double>{100, 2, 8, 1, 4});
    CHECK(odd.median == 4);
    CHECK(odd.deviation == 3);
    CHECK(odd.least == 1);
    CHECK(odd.most == 100);
    // Sorted 1 2 4 8: median 3; distances 2 1 1 5.
    const TimingSpread even = timing_spread(std::vector<double>{8, 1, 4, 2});
    CHECK(even.median == 3);
    CHECK(even.deviation == 1.5);
  }

  TEST_CASE("one timing is its own median without deviation, and none is no number") {
    const TimingSpread one = timing_spread(std::vector<double>{7});
    CHECK(one.median == 7);
    CHECK(one.deviation == 0);
    CHECK(one.least == 7);
    CHECK(one.most == 7);
    const TimingSpread none = timing_spread({});
    CHECK(std::isnan(none.median));
    CHECK(std::isnan(none.deviation));
    CHECK(std::isnan(none.least));
    CHECK(std::isnan(none.most));
  }

  TEST_CASE("a minority of wild timings moves neither median nor deviation") {
    const TimingSpread calm = timing_spread(std::vector<double>{10, 11, 12, 13, 14});
    const TimingSpread wild = timing_spread(std::vector<double>{10, 11, 12, 1e9, 1e9});
    CHECK(wild.median == calm.median);
    CHECK(wild.deviation <= 2);
  }
}
