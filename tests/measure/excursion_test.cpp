// How far an image leaves [0, 1].
#include "measure/excursion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

using namespace moire;

TEST_SUITE("unit") {
  TEST_CASE("what lies inside [0, 1] is no excursion, and what lies outside is measured from the nearer end") {
    ExcursionTally tally;
    for (const double v : {0.0, 1.0, 0.5, -0.0, 1.25, -0.5, 1.125}) tally.add(v);
    tally.add(std::numeric_limits<double>::quiet_NaN());
    tally.add(std::numeric_limits<double>::infinity());
    tally.add_flat(91);
    const Excursion e = tally.finish();
    CHECK(e.overshoot == 0.25);
    CHECK(e.undershoot == 0.5);
    CHECK(e.rms == std::sqrt((0.0625 + 0.25 + 0.015625) / 100));
    CHECK(ExcursionTally().finish().rms == 0);
  }
}
