// Hard reconstructions keep what follows from the claims of kernels.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "numbers_checks.h"

using namespace moire;
using namespace moire::stress;

namespace moire::stress {
extern const Family reconstruction;
}

TEST_SUITE("unit") {
  TEST_CASE("a few hard reconstructions keep their bounds, and say how to see them again") {
    check_family(reconstruction, 21);
    // Every seventh inverts a distribution; the others are pictures.
    CHECK(reconstruction.describe({1, 6}).find("inverse distribution of --filter ") != std::string::npos);
    const std::string text = reconstruction.describe({1, 5});
    for (const char* word : {"kind = ", "--pattern ", "--filter ", "--estimator ", "--spp "}) {
      CHECK(text.find(word) != std::string::npos);
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("hard reconstructions keep their bounds, and weight sums near zero fall back") {
    check_family(reconstruction, 300);
    // Among them some whose quotient alone is off by more than a pixel's range.
    double naive = 0;
    for (std::uint64_t i = 0; i < 300; ++i) naive = std::fmax(naive, run_case(reconstruction, {1, i}).naive_error);
    CHECK(naive > 1);
  }
}
