// The family of disks.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "oracle/coverage.h"
#include "stress/exact_checks.h"
#include "stress/naive.h"
#include "stress/scenes.h"

namespace moire::stress {

extern const Family disks;

TEST_SUITE("unit") {
  TEST_CASE("hard disks are within their bounds of the oracle") { check_passes(disks, 3, 450); }

  TEST_CASE("a described disk is the same case again, down to the bits") { check_can_be_rerun(disks, 4, 72); }

  TEST_CASE("2000 hard disks meet every filter of the catalogue") { check_meets_all_filters(disks, 1, 2000); }

  // The pixel's middle is 1.1483417740464109 below the disk's centre, which rounds by more than the disk dips in: 0,
  // with a bound of 0, was the answer.
  TEST_CASE("a disk that dips into a pixel by less than a rounding has that sliver in its bound") {
    const ExactCase c{scenes::disk({475, 0.35165822595358903}, 0.64834177404641102), {475, 1}, checked_filter("box")};
    const Outcome outcome = run(c);
    CHECK(outcome.error > 3e-25);
    CHECK(outcome.bound < 1e-20);
    CHECK(passes(outcome));
  }

  TEST_CASE("a tiny disk in one pixel is worth its area times the kernel's value, to its last digits") {
    for (const std::string& text : filter_variants()) {
      CAPTURE(text);
      const FilterPtr f = checked_filter(text);
      for (const double r : {1e-12, 1e-9, 1e-6}) {
        // Near enough to the centre for k(0) to be k: every kernel here is flat at 0 or has a corner there, whose slope
        // is below 4 k(0) per pixel.
        const ExactCase c{scenes::disk({0.5, 0.5}, r), {0, 0}, f};
        const Outcome outcome = run(c);
        CHECK(passes(outcome));
        const double k =
            f->kernel ? static_cast<double>((*f->kernel)(0) * (*f->kernel)(0)) : static_cast<double>((*f->rings)(0));
        const double area = std::numbers::pi * r * r;
        CHECK(std::fabs(outcome.computed - area * k) <= area * std::fabs(k) * (8 * r + 1e-15) + outcome.bound);
        // The claim is relative: it shrinks with the disk, as the value does. Some 250 roundings around the circle of
        // factors up to 2 pi and twice the largest k k, which is at the centre up to a third.
        CHECK(outcome.bound <= 3000 * 0x1p-53 * 2.25 * std::fabs(k) * r * r);
      }
    }
  }

  TEST_CASE("a quarter of a disk on a corner is in each of the four pixels") {
    for (const double r : {1e-12, 1e-3, 0.5, 1.0})
      for (const Pixel p : {Pixel{3, 3}, Pixel{4, 3}, Pixel{3, 4}, Pixel{4, 4}}) {
        const Outcome outcome = run({scenes::disk({4, 4}, r), p, checked_filter("box")});
        CHECK(passes(outcome));
        CHECK(std::fabs(outcome.wanted - std::numbers::pi * r * r / 4) <= 1e-15 * r * r);
      }
  }

  TEST_CASE("textbook coverage of a disk is right for easy ones and wrong for huge ones") {
    constexpr double kPi = std::numbers::pi;
    CHECK(naive_coverage(oracle::Disk{{4.5, 4.5}, 0.25}, {4, 4}, 1) == doctest::Approx(kPi / 16).epsilon(1e-12));
    CHECK(naive_coverage(oracle::Disk{{4, 4}, 0.5}, {4, 4}, 1) == doctest::Approx(kPi / 16).epsilon(1e-12));
    CHECK(naive_coverage(oracle::Disk{{4, 4}, 3}, {4, 4}, 1) == doctest::Approx(1).epsilon(1e-12));
    const oracle::Disk large{{1.3, 0.7}, 1.1};
    CHECK(naive_coverage(large, {0, 0}, 1) ==
          doctest::Approx(static_cast<double>(oracle::coverage(large, {0, 0}, 1).value)).epsilon(1e-12));
    const oracle::Disk huge{{4.3 + 6e8, 4.4 + 8e8}, 1e9};
    CHECK(std::fabs(naive_coverage(huge, {4, 4}, 1) - static_cast<double>(oracle::coverage(huge, {4, 4}, 1).value)) >
          1e-3);
  }
}

}  // namespace moire::stress
