// Hard spectra, and the transform that erred by more than was said.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "measure/dft.h"
#include "numbers_checks.h"

using namespace moire;
using namespace moire::stress;

namespace moire::stress {
extern const Family spectra;
}

TEST_SUITE("unit") {
  TEST_CASE("a constant image of a prime side keeps the bound of its transform") {
    constexpr int kSide = 4093;
    const std::vector<double> ones(kSide, 1.0);
    const double error = std::abs(real_dft(ones, 1, kSide)[0] - std::complex<double>(kSide));
    CHECK(error <= 4e-16 * (1 + kSide) * kSide);
    // The bound was said to go with the root of the sum of squares: 1.05e-10 here, where the error is 1.4e-10.
  }

  TEST_CASE("hard spectra keep their bounds") { check_family(spectra, 300); }
}
