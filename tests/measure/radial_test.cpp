// Rings of frequencies: what belongs to them, and what they say of their bins.
#include "measure/radial.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

using moire::Ring;
using moire::ring_of;
using moire::rings;

TEST_SUITE("unit") {
  TEST_CASE("a ring holds the integer frequencies that are nearest to it, by integer arithmetic") {
    for (std::int64_t u = 0; u < 700; u += 7) {
      for (std::int64_t v = 0; v < 700; ++v) {
        // (k - 1/2)^2 <= u^2 + v^2 < (k + 1/2)^2 means k^2 - k < u^2 + v^2 <= k^2 + k for integers.
        const std::int64_t k = ring_of(static_cast<double>(-u), static_cast<double>(v)), square = u * u + v * v;
        REQUIRE(k * k - k < square + (square == 0 ? 1 : 0));
        REQUIRE(square <= k * k + k);
      }
    }
    // The largest for which this is promised.
    for (const double k : {3.0, 4194303.0}) {
      CHECK(ring_of(k, 0) == static_cast<int>(k));
      CHECK(ring_of(0, -k) == static_cast<int>(k));
    }
  }

  TEST_CASE("every bin but zero frequency belongs to one ring, whatever the size") {
    for (const auto& size : {std::pair{1, 1}, {2, 1}, {1, 5}, {8, 8}, {7, 7}, {16, 6}, {5, 12}, {64, 48}}) {
      const int width = size.first, height = size.second;
      CAPTURE(width);
      CAPTURE(height);
      const std::vector<double> power(static_cast<std::size_t>(width * height), 2.5);
      std::int64_t bins = 0, distinct = 0;
      for (const Ring& ring : rings(power, width, height)) {
        bins += ring.bins;
        distinct += ring.distinct;
        if (ring.bins > 0) CHECK(ring.mean == 2.5);
        if (ring.bins == 0) CHECK(std::isnan(ring.mean));
        CHECK(std::isnan(ring.anisotropy_db));  // no variance
      }
      CHECK(bins == width * height - 1);
      // Own partners: the Nyquist bins, one for each way to be at zero or Nyquist along both axes, without zero itself.
      const int own = (width % 2 == 0 ? 2 : 1) * (height % 2 == 0 ? 2 : 1) - 1;
      CHECK(distinct == (width * height - 1 + own) / 2);
      CHECK(rings(power, width, height).front().bins == 0);
      if (width * height > 1) CHECK(rings(power, width, height).back().bins > 0);
    }
  }

  TEST_CASE("zero frequency, at the centre, is left out however large it is") {
    std::vector<double> power(81, 1.0);
    power[4 * 9 + 4] = 1e300;
    for (const Ring& ring : rings(power, 9, 9))
      if (ring.bins > 0) CHECK(ring.mean == 1);
  }

  TEST_CASE("mean and anisotropy of the innermost ring are as worked out by hand") {
    // 3 x 3: ring 1 has all eight neighbours of zero, four pairs with the powers 1, 2, 3 and 6: mean 3, sum of squared
    // deviations 4 + 1 + 0 + 9 = 14 over 4 - 1.
    const std::vector<double> power = {1, 2, 3, 6, 0, 6, 3, 2, 1};
    const std::vector<Ring> all = rings(power, 3, 3);
    REQUIRE(all.size() == 2);
    CHECK(all[1].bins == 8);
    CHECK(all[1].distinct == 4);
    CHECK(all[1].mean == 3);
    CHECK(std::fabs(all[1].anisotropy_db - 10 * std::log10(14.0 / 3 / 9)) < 1e-14);
  }

  TEST_CASE("in an image that is not square rings are circles in cycles per pixel") {
    // 8 x 4: a step along y is two steps along x. Of ring 2, 1.5 <= r < 2.5: (+-2, 0), (0, +-1), (+-1, +-1).
    const std::vector<double> power(32, 1.0);
    const std::vector<Ring> all = rings(power, 8, 4);
    CHECK(all[1].bins == 2);
    CHECK(all[2].bins == 8);
  }
}
