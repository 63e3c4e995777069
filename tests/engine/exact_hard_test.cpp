// Exact values against the oracle where geometry degenerates: corners, sides, knots, tangency, huge coordinates.
#include <doctest/doctest.h>

#include "engine/exact_compare.h"
#include "engine/random_scenes.h"

namespace moire {
namespace {

constexpr double kBoxTolerance = 1e-13, kWideTolerance = 1e-12;

// Both ends of the range of pixels in which exact values promise their accuracy.
constexpr double kFar = 0x1p40;

std::vector<ExactComparison> all_filters() {
  std::vector<ExactComparison> all{{"box", kBoxTolerance}};
  for (const std::string& filter : wide_filters()) all.emplace_back(filter, kWideTolerance);
  return all;
}

void report(std::vector<ExactComparison>& all) {
  for (ExactComparison& compare : all) MESSAGE(compare.summary());
}

// Axis-parallel and diagonal directions, and the same turned by 1e-16 to 1e-3: lines that are almost a knot line.
std::vector<Vec2> hard_normals() {
  std::vector<Vec2> normals{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-3, -3}};
  for (const double turn : {1e-16, 1e-13, 1e-10, 1e-7, 1e-3})
    for (const double sign : {-1.0, 1.0}) {
      normals.push_back({1, sign * turn});
      normals.push_back({-sign * turn, 1});
      normals.push_back({1, sign + turn});
    }
  return normals;
}

// Coordinates on pixel corners and centres, and next to them.
constexpr double kTouchy[] = {4, 4 + 1e-12, 4 - 1e-12, 4.25, 4.5, 4.5 - 1e-12};

void compare_edges(double far) {
  auto all = all_filters();
  const auto base = static_cast<std::int64_t>(far);
  for (ExactComparison& compare : all)
    for (const Vec2 normal : hard_normals())
      for (const double x : kTouchy)
        for (const double y : {4.0, 4.5, 4.3}) {
          const TestImage edge = scenes::edge({far + x, y - far}, normal);
          for (const Pixel p : {Pixel{4, 4}, Pixel{3, 4}, Pixel{5, 3}}) compare(edge, {base + p.x, p.y - base});
        }
  report(all);
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("edges through corners, along sides and almost along them are exact") { compare_edges(0); }

  TEST_CASE("edges 2^40 pixels from the origin are as exact as near it") { compare_edges(kFar); }

  TEST_CASE("edges along every knot line of every filter are exact") {
    for (ExactComparison& compare : all_filters()) {
      for (int quarter = -10; quarter <= 10; ++quarter)
        for (const double tilt : {0.0, 1e-15, -1e-9}) {
          const double at = 7.5 + 0.25 * quarter;  // the knots of kernels of radius 1/2, 1, 1.5, 2, 2.25
          compare(scenes::edge({at, 7.5}, {1, tilt}), {7, 7});
          compare(scenes::edge({7.5, at}, {tilt, -1}), {7, 7});
        }
      const double r = compare.radius();
      for (const double at : {7.5 - r, 7.5 + r, std::nextafter(7.5 - r, 0.0), std::nextafter(7.5 + r, 9.0)})
        compare(scenes::edge({at, 7.5}, {-1, 0}), {7, 7});
    }
  }

  TEST_CASE("disks tangent to sides, through corners, inside one pixel or one knot cell are exact") {
    auto all = all_filters();
    const Vec2 centers[] = {{4, 4}, {4.5, 4.5}, {4, 4.5}, {4.25, 4.25}, {4 + 1e-12, 4.5}, {4.3, 4.7}, {4.5, 4 - 1e-12}};
    const double radii[] = {1e-6, 1e-3,           0.25, 0.5, 0.5 + 1e-12, 0.5 - 1e-12, std::sqrt(0.5),
                            1,    std::sqrt(2.0), 1.5,  2,   2.25,        3.5};
    for (ExactComparison& compare : all)
      for (const Vec2 c : centers)
        for (const double r : radii) {
          const TestImage disk = scenes::disk(c, r);
          for (const Pixel p : {Pixel{4, 4}, Pixel{3, 4}, Pixel{5, 5}, Pixel{2, 5}}) compare(disk, p);
        }
    report(all);
  }

  TEST_CASE("disks of 1e9 pixels that touch sides and corners are exact") {
    auto all = all_filters();
    for (ExactComparison& compare : all)
      for (const double r : {1e5, 1e9})
        for (const double shift : {0.0, 0.5, -0.5, 1.0, 0x1p-22, -0x1p-22})
          for (const double side : {-1.0, 1.0}) {
            // Leftmost, rightmost, top and bottom points on 4 + shift; both coordinates are exact in double.
            compare(scenes::disk({4 + shift + side * r, 4.5}, r), {4, 4});
            compare(scenes::disk({4.25, 4 + shift + side * r}, r), {4, 3});
            // 3-4-5: through the corner (4, 4) exactly.
            compare(scenes::disk({4 + shift + side * 0.6 * r, 4 + 0.8 * r}, r), {4, 4});
          }
    report(all);
  }

  TEST_CASE("disks 2^40 pixels from the origin are as exact as near it") {
    auto all = all_filters();
    constexpr auto kBase = static_cast<std::int64_t>(kFar);
    for (ExactComparison& compare : all)
      for (const double r : {1e-3, 0.5, 0.7, 3.0, 1e5, 1e9})
        for (const Vec2 c : {Vec2{4.5, 4.5}, Vec2{4, 4}, Vec2{4.25 + r, 4.75}, Vec2{4 + 0.6 * r, 4 - 0.8 * r}})
          for (const Pixel p : {Pixel{4, 4}, Pixel{5, 3}})
            compare(scenes::disk({c.x - kFar, c.y + kFar}, r), {p.x - kBase, p.y + kBase});
    report(all);
  }

  TEST_CASE("boards whose squares lie on pixel sides and corners are exact") {
    auto all = all_filters();
    for (ExactComparison& compare : all)
      for (const double scale : {1.0, -1.0, 0.5, 2.0, 1.0 / 3})
        for (const double shift : {0.0, 0.5, 1e-12, -0.25})
          for (const double tilt : {0.0, 1e-14, 1e-6}) {
            // Mirrored where scale is negative.
            const TestImage board =
                scenes::board({scale, tilt, shift, tilt, std::fabs(scale), -shift, 0, 0, 1}, {-8, 8, -3, 3.5});
            for (const Pixel p : {Pixel{0, 0}, Pixel{2, 2}, Pixel{1, 3}}) compare(board, p);
          }
    report(all);
  }

  TEST_CASE("boards 2^40 pixels from the origin are exact") {
    auto all = all_filters();
    constexpr auto kBase = static_cast<std::int64_t>(kFar);
    for (ExactComparison& compare : all)
      for (const double shift : {0.0, 0.5, 0.375}) {
        const TestImage board = scenes::board({1, 0, shift - kFar, 0.25, 1, -1.25 * kFar, 0, 0, 1}, {-4, 8, -3, 9.5});
        for (const Pixel p : {Pixel{4, 4}, Pixel{3, 1}, Pixel{-4, -2}}) compare(board, {p.x + kBase, p.y + kBase});
      }
    report(all);
  }

  TEST_CASE("a board that passes under the camera is exact") {
    // Level and tilted cameras above the board: its near squares reach behind the camera.
    auto all = all_filters();
    for (ExactComparison& compare : all)
      for (const double pitch : {0.0, 20.0, 70.0})
        for (const double yaw : {0.0, 30.0}) {
          const TestImage board =
              scenes::board({.focal = 20, .principal = {32, 16}, .pitch = pitch, .yaw = yaw}, {-2, 2, -3, 5});
          for (const Pixel p : {Pixel{30, 22}, Pixel{31, 31}, Pixel{40, 60}, Pixel{20, 15}}) compare(board, p);
        }
    report(all);
  }
}

}  // namespace moire
