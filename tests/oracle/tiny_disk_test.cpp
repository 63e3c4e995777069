// Disks in units of their radius: against closed forms, and against sections in pixels for disks that are not tiny.
#include "oracle/tiny_disk.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "filter_list.h"
#include "oracle/coverage.h"
#include "oracle/filtered.h"
#include "oracle/rings.h"

namespace moire::oracle {
namespace {

long double square(double r) { return static_cast<long double>(r) * static_cast<long double>(r); }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("under the box tiny disks inside, across sides and on corners have their closed form to the last digits") {
    const Kernel box("box");
    for (const double r : {1e-12, 1e-6, 1e-2})
      for (const double x : {0.5, 0.0, 0.3 * r, -0.99 * r, 1.0})
        for (const double y : {0.25, 1.0, 1 + 0.5 * r}) {
          const Disk disk{{x, y}, r};
          const Value v = filtered_per_square(box, disk, {0, 0}), closed = coverage(disk, {0, 0}, 1);
          CHECK(std::fabs(v.value - closed.value / square(r)) <= v.error + closed.error / square(r));
          CHECK(v.error < 1e-15L);
        }
  }

  TEST_CASE("small disks under every separable kernel agree with sections in pixels") {
    for (const std::string& text : test::separable_texts()) {
      CAPTURE(text);
      const Kernel k(text);
      const auto reach = static_cast<double>(k.radius());
      for (const double r : {reach / 8, reach / 40})
        for (const double x : {0.5, 0.5 + 0.31 * reach, 0.5 + reach})
          for (const double y : {0.5 + 0.3 * r, 0.5 - 0.77 * reach}) {
            const Disk disk{{x, y}, r};
            const Value v = filtered_per_square(k, disk, {0, 0}), sections = filtered(k, disk, {0, 0});
            CHECK(std::fabs(v.value * square(r) - sections.value) <= v.error * square(r) + sections.error);
          }
    }
  }

  TEST_CASE("a tiny disk centred on a radial kernel's rim is half inside, less the rim's bend") {
    // Rays from the disk's centre that only just pass the rim were once missed: 1.6635489222024303e-18.
    const RingKernel k("disk");
    const double r = 9.1201670027700149e-10;
    const Value v = filtered_per_square(k, Disk{{1, 0.5}, r}, {0, 0});
    // The lens of the two circles, evaluated with 60 digits.
    CHECK(std::fabs(v.value * square(r) - 1.66354892252438688135790868632554e-18L) <= v.error * square(r) + 1e-36L);
    CHECK(v.error < 1e-15L);
  }

  TEST_CASE("a tiny disk centred next to a radial kernel's rim has the value of its rings") {
    // 4e-15 inside of the rim; rays along it were once integrated over the bend: 1.217710287171581927e-10.
    const RingKernel k("radial-bc:preset=ospray-mitchell");
    const Disk disk{{-242.35714285714286, -126.5}, 0.00089979489351762186};
    const Value v = filtered_per_square(k, disk, {-244, -127});
    // Rings around the pixel's centre, evaluated with 40 digits.
    CHECK(std::fabs(v.value * square(disk.radius) - 1.21771029659744232810219e-10L) <=
          v.error * square(disk.radius) + 1e-31L);
    CHECK(v.error < 1e-15L);
    for (const double radius : {1e-6, 1e-4, 0.01})
      for (const double away : {-1e-15, 0.0, 1e-14, -1e-10, 3e-7})
        for (const char* text : {"disk", "cone", "radial-bc", "radial-lanczos"}) {
          CAPTURE(std::string(text));
          const RingKernel kernel(text);
          const Disk other{{0.5 + static_cast<double>(kernel.breaks().back()) + away, 0.5}, radius};
          const Value per_square = filtered_per_square(kernel, other, {0, 0}), rings = filtered(kernel, other, {0, 0});
          CHECK(std::fabs(per_square.value * square(radius) - rings.value) <=
                per_square.error * square(radius) + rings.error);
        }
  }
}

}  // namespace moire::oracle
