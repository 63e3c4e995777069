// Exact values of kernels that are in no list: those that come from a file, and the widest of all. Even ones against
// the oracle's own reading of the file, others against their mirror image and plain sums.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "engine/exact_compare.h"
#include "engine/random_scenes.h"
#include "reports/folder.h"

namespace moire {
namespace {

// A plateau, a jump down and a roof; a jump to zero at the end.
constexpr const char* kHouse = "0,1\n0.375,1\n0.375,0.75\n1.25,0.25\n1.7,0.125\n";

// Falls by half within 2^-20 pixel.
constexpr const char* kCliff = "0,1\n0.7,0.9\n0.70000095367431640625,0.4\n2,0\n";

// Lopsided, with jumps and a sign change; and its mirror image.
constexpr const char* kLopsided = "-1.25,0.5\n-0.5,1\n-0.5,0.75\n0.25,1.5\n0.75,-0.125\n1.5,-0.25\n2,0\n";
constexpr const char* kMirrored = "-2,0\n-1.5,-0.25\n-0.75,-0.125\n-0.25,1.5\n0.5,0.75\n0.5,1\n1.25,0.5\n";

// A sinc under a cosine at rows that are no multiples of each other, 0 at its end.
std::string lobes() {
  std::string rows;
  for (int i = 0; i <= 17; ++i) {
    const double x = 2.5 * i / 17, k = i == 0 ? 1 : std::sin(3.1 * x) / (3.1 * x) * std::cos(0.6 * x);
    rows += shortest(x) + ',' + shortest(i == 17 ? 0 : k) + '\n';
  }
  return rows;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("tabulated kernels, straight and cubic between rows, are exact on edges, disks and boards") {
    const Folder folder;
    std::ofstream(folder.file("house.csv")) << kHouse;
    std::ofstream(folder.file("lobes.csv")) << lobes();
    std::ofstream(folder.file("cliff.csv")) << kCliff;
    Draw draw(51);
    for (const char* file : {"house.csv", "lobes.csv", "cliff.csv"})
      for (const std::string between : {"linear", "cubic"}) {
        if (file == std::string("cliff.csv") && between == "cubic")
          continue;  // a spline through a cliff is all ringing
        const std::string text = "tabulated:path=" + folder.file(file) + ",between=" + between;
        CAPTURE(text);
        const Filter filter(parse_spec(text, "test"));
        const Kernel& product = filter.kernel();
        const oracle::Kernel truth(text);
        for (int i = -499; i < 500; ++i) {
          const double x = product.radius() * i / 500;
          const auto at = static_cast<long double>(x), right = std::nextafter(at, 99.0L);
          // Half-open from the right; on a cliff that step is seen, 2^-64 |x| times its slope.
          CHECK(std::fabs(static_cast<long double>(product.k(x)) - truth(right)) <=
                static_cast<long double>(product.k_error()) +
                    static_cast<long double>(product.slope_max()) * (right - at));
          CHECK(std::fabs(static_cast<long double>(product.K(x)) - truth.over(-truth.radius(), at)) <=
                static_cast<long double>(product.K_error()));
        }
        ExactComparison compare(text, 1e-12);  // the promise of moire for filters other than the box
        for (int i = 0; i < 200; ++i) {
          const RandomCase edge = random_edge(draw, compare.radius()), disk = random_disk(draw, compare.radius());
          compare(edge.image, edge.pixel);
          compare(disk.image, disk.pixel);
          const RandomCase board = random_board(draw, compare.radius(), 20);
          if (i % 4 == 0) compare(board.image, board.pixel);
        }
        MESSAGE(compare.summary());
      }
  }

  TEST_CASE("a tiny disk's bound knows nothing of a cliff elsewhere in the kernel, and is relative to its value") {
    const Folder folder;
    std::ofstream(folder.file("cliff.csv")) << kCliff;
    const Filter filter(parse_spec("tabulated:path=" + folder.file("cliff.csv"), "test"));
    for (const double radius : {0.2, 1e-3, 1e-9}) {
      const Exact e = exact_pixel(scenes::disk({0.75, 0.625}, radius), filter, {0, 0});
      // Some hundred roundings of the value, whose pieces have one sign.
      CHECK(e.bound <= 1e-13 * e.value);
      // Across the cliff: a place is known to u |x|, and over the width of the cliff k is off by 2^20 times that.
      const Exact across = exact_pixel(scenes::disk({0.5 + 0.7, 0.625}, radius), filter, {0, 0});
      CHECK(across.bound <= (radius > 1e-6 ? 1e-12 : 1e-9) * across.value);
    }
  }

  TEST_CASE("a lopsided kernel's values are those of the mirrored kernel on the mirrored scene") {
    const Folder folder;
    std::ofstream(folder.file("lopsided.csv")) << kLopsided;
    std::ofstream(folder.file("mirrored.csv")) << kMirrored;
    Draw draw(52);
    for (const char* between : {",between=linear", ",between=cubic"}) {
      CAPTURE(between);
      const Filter filter(parse_spec("tabulated:path=" + folder.file("lopsided.csv") + between, "test"));
      const Filter mirror(parse_spec("tabulated:path=" + folder.file("mirrored.csv") + between, "test"));
      const Pixel at{0, 0};
      const auto check_same = [&](const TestImage& scene, const TestImage& mirrored) {
        const Exact a = exact_pixel(scene, filter, at), b = exact_pixel(mirrored, mirror, at);
        CHECK(std::fabs(a.value - b.value) <= a.bound + b.bound + 0x1p-52 * std::fabs(a.value));  // the difference's
      };
      // Dyadic places: mirroring them in the pixel's centre is exact.
      const auto dyadic = [&](double lo, double hi) { return std::round(draw.uniform(lo, hi) * 0x1p20) * 0x1p-20; };
      for (int i = 0; i < 300; ++i) {
        const Vec2 p{dyadic(-2, 3), dyadic(-2, 3)}, n{dyadic(-1, 1), dyadic(-1, 1) + 0x1p-30};
        check_same(scenes::edge(p, n), scenes::edge({1 - p.x, 1 - p.y}, {-n.x, -n.y}));
        const double r = draw.log_uniform(1e-6, 20);
        check_same(scenes::disk(p, r), scenes::disk({1 - p.x, 1 - p.y}, r));
        const double a = dyadic(-0.5, 0.5), b = dyadic(-0.5, 0.5) + 0x1p-25, g = dyadic(-0.01, 0.01);
        const std::vector<double> extent{-3, 4, -2.5, 3};
        check_same(scenes::board({a, b, 0.25, -b, a, 0.5, g, 0x1p-10, 1}, extent),
                   scenes::board({-a, -b, a + b + 0.25, b, -a, a - b + 0.5, -g, -0x1p-10, 1 + g + 0x1p-10}, extent));
      }
    }
  }

  TEST_CASE("a lopsided kernel is not mirrored: edges against its integral, disks against plain sums") {
    const Folder folder;
    std::ofstream(folder.file("lopsided.csv")) << kLopsided;
    const Filter filter(parse_spec("tabulated:path=" + folder.file("lopsided.csv"), "test"));
    const Kernel& k = filter.kernel();
    Draw draw(53);
    for (int i = 0; i < 100; ++i) {
      const double x = draw.uniform(-2, 2);
      for (const bool down : {false, true}) {
        const TestImage edge = scenes::edge({0.5 + x, 0.5 + x}, down ? Vec2{0, 1} : Vec2{1, 0});
        const Exact e = exact_pixel(edge, filter, {0, 0});
        // 2^-53 for the place in the image, below 3.
        CHECK(std::fabs(e.value - (1 - k.K(x))) <= e.bound + k.K_error() + 4 * k.k_max() * 0x1p-53);
      }
      const Vec2 c{x, draw.uniform(-2, 2)};
      const double r = draw.log_uniform(1e-3, 3);
      // x = c.x - r cos(angle), by the midpoint rule. Its jumps, up to a few times k(x) r, count for one step each.
      constexpr int kSteps = 20000;
      double sum = 0;
      for (int j = 0; j < kSteps; ++j) {
        const double angle = std::numbers::pi * (j + 0.5) / kSteps, half = r * std::sin(angle);
        sum += k.k(c.x - r * std::cos(angle)) * half * (k.K(c.y + half) - k.K(c.y - half));
      }
      const Exact e = exact_pixel(scenes::disk({0.5 + c.x, 0.5 + c.y}, r), filter, {0, 0});
      CHECK(std::fabs(e.value - sum * std::numbers::pi / kSteps) <= 4 * std::min(r, 1.0) * r / kSteps);
    }
  }

  TEST_CASE("the widest kernels, radius 16, are exact on edges and disks") {
    Draw draw(54);
    for (const char* text : {"lanczos:a=16", "windowed-sinc:radius=16"}) {
      CAPTURE(text);
      ExactComparison compare(text, 1e-12);  // the promise of moire for filters other than the box
      for (int i = 0; i < 12; ++i) {
        const RandomCase edge = random_edge(draw, compare.radius()), disk = random_disk(draw, compare.radius());
        compare(edge.image, edge.pixel);
        compare(disk.image, disk.pixel);
      }
      CHECK(compare.median_bound() < 1e-13);  // what narrower kernels have, too
      MESSAGE(compare.summary());
    }
  }
}

}  // namespace moire
