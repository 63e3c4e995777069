// Exact values against the oracle where geometry degenerates: corners, sides, knots, tangency, huge coordinates.
#include <doctest/doctest.h>

#include "engine/exact_compare.h"
#include "engine/random_scenes.h"

namespace moire {
namespace {

constexpr double kBoxTolerance = 1e-13, kWideTolerance = 1e-12;

// Both ends of the range of pixels in which exact values promise their accuracy.
constexpr double kFar = 0x1p40;

double tolerance(const std::string& filter) { return filter == "box" ? kBoxTolerance : kWideTolerance; }

// Under every filter each n-th case only, from another one on than its neighbours in the catalogue, so that each case
// meets filters of every class; n is prime and divides no period of the lists. The plain box, whose oracle is a closed
// form, takes them all.
void compare_share(const std::vector<RandomCase>& cases, std::size_t n) {
  std::size_t first = 0;
  for (const std::string& filter : test::separable_texts()) {
    ExactComparison compare(filter, tolerance(filter));
    const std::size_t step = filter == "box" ? 1 : n;
    for (std::size_t i = first++ % step; i < cases.size(); i += step) compare(cases[i].image, cases[i].pixel);
    MESSAGE(compare.summary());
  }
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

std::vector<RandomCase> hard_edges(double far) {
  std::vector<RandomCase> cases;
  const auto base = static_cast<std::int64_t>(far);
  for (const Vec2 normal : hard_normals())
    for (const double x : kTouchy)
      for (const double y : {4.0, 4.5, 4.3})
        for (const Pixel p : {Pixel{4, 4}, Pixel{3, 4}, Pixel{5, 3}})
          cases.push_back({scenes::edge({far + x, y - far}, normal), {base + p.x, p.y - base}});
  return cases;
}

std::vector<RandomCase> hard_disks() {
  const Vec2 centers[] = {{4, 4}, {4.5, 4.5}, {4, 4.5}, {4.25, 4.25}, {4 + 1e-12, 4.5}, {4.3, 4.7}, {4.5, 4 - 1e-12}};
  const double radii[] = {1e-6, 1e-3,           0.25, 0.5, 0.5 + 1e-12, 0.5 - 1e-12, std::sqrt(0.5),
                          1,    std::sqrt(2.0), 1.5,  2,   2.25,        3.5};
  std::vector<RandomCase> cases;
  for (const Vec2 c : centers)
    for (const double r : radii)
      for (const Pixel p : {Pixel{4, 4}, Pixel{3, 4}, Pixel{5, 5}, Pixel{2, 5}})
        cases.push_back({scenes::disk(c, r), p});
  return cases;
}

std::vector<RandomCase> huge_disks() {
  std::vector<RandomCase> cases;
  for (const double r : {1e5, 1e9})
    for (const double shift : {0.0, 0.5, -0.5, 1.0, 0x1p-22, -0x1p-22})
      for (const double side : {-1.0, 1.0}) {
        // Leftmost, rightmost, top and bottom points on 4 + shift; both coordinates are exact in double.
        cases.push_back({scenes::disk({4 + shift + side * r, 4.5}, r), {4, 4}});
        cases.push_back({scenes::disk({4.25, 4 + shift + side * r}, r), {4, 3}});
        // 3-4-5: through the corner (4, 4) exactly.
        cases.push_back({scenes::disk({4 + shift + side * 0.6 * r, 4 + 0.8 * r}, r), {4, 4}});
      }
  return cases;
}

std::vector<RandomCase> far_disks() {
  constexpr auto kBase = static_cast<std::int64_t>(kFar);
  std::vector<RandomCase> cases;
  for (const double r : {1e-3, 0.5, 0.7, 3.0, 1e5, 1e9})
    for (const Vec2 c : {Vec2{4.5, 4.5}, Vec2{4, 4}, Vec2{4.25 + r, 4.75}, Vec2{4 + 0.6 * r, 4 - 0.8 * r}})
      for (const Pixel p : {Pixel{4, 4}, Pixel{5, 3}})
        cases.push_back({scenes::disk({c.x - kFar, c.y + kFar}, r), {p.x - kBase, p.y + kBase}});
  return cases;
}

std::vector<RandomCase> hard_boards() {
  std::vector<RandomCase> cases;
  for (const double scale : {1.0, -1.0, 0.5, 2.0, 1.0 / 3})
    for (const double shift : {0.0, 0.5, 1e-12, -0.25})
      for (const double tilt : {0.0, 1e-14, 1e-6}) {
        // Mirrored where scale is negative.
        const std::vector<double> h{scale, tilt, shift, tilt, std::fabs(scale), -shift, 0, 0, 1};
        for (const Pixel p : {Pixel{0, 0}, Pixel{2, 2}, Pixel{1, 3}}) {
          cases.push_back({scenes::board(h, {-8, 8, -3, 3.5}), p});
          cases.push_back({scenes::plane(h), p});
        }
      }
  return cases;
}

std::vector<RandomCase> far_boards() {
  constexpr auto kBase = static_cast<std::int64_t>(kFar);
  std::vector<RandomCase> cases;
  for (const double shift : {0.0, 0.5, 0.375})
    for (const Pixel p : {Pixel{4, 4}, Pixel{3, 1}, Pixel{-4, -2}})
      cases.push_back({scenes::board({1, 0, shift - kFar, 0.25, 1, -1.25 * kFar, 0, 0, 1}, {-4, 8, -3, 9.5}),
                       {p.x + kBase, p.y + kBase}});
  return cases;
}

// Level and tilted cameras above the board: its near squares reach behind the camera.
std::vector<RandomCase> boards_underfoot() {
  std::vector<RandomCase> cases;
  for (const double pitch : {0.0, 20.0, 70.0})
    for (const double yaw : {0.0, 30.0})
      for (const Pixel p : {Pixel{30, 22}, Pixel{31, 31}, Pixel{40, 60}, Pixel{20, 15}})
        cases.push_back(
            {scenes::board({.focal = 20, .principal = {32, 16}, .pitch = pitch, .yaw = yaw}, {-2, 2, -3, 5}), p});
  return cases;
}

// Of each filter, with its knots in pixels from the centre of pixel (7, 7), at (7.5, 7.5).
template <class Cases>
void compare_at_knots(const Cases& cases) {
  for (const std::string& text : test::separable_texts()) {
    ExactComparison compare(text, tolerance(text));
    const Filter filter(parse_spec(text, "test"));
    const std::span<const double> knots = filter.kernel().knots();
    for (std::size_t i = 0; i < knots.size(); ++i) cases(compare, knots, i);
    MESSAGE(compare.summary());
  }
}

constexpr Pixel kPixel{7, 7};
constexpr double kCentre = 7.5;

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("disks of 1e9 pixels that touch sides and corners are exact") { compare_share(huge_disks(), 7); }

  TEST_CASE("disks 2^40 pixels from the origin are as exact as near it") { compare_share(far_disks(), 7); }

  TEST_CASE("boards 2^40 pixels from the origin are exact") { compare_share(far_boards(), 5); }

  TEST_CASE("a board that passes under the camera is exact") { compare_share(boards_underfoot(), 7); }
}

TEST_SUITE("heavy") {
  TEST_CASE("edges through corners, along sides and almost along them are exact") { compare_share(hard_edges(0), 13); }

  TEST_CASE("edges 2^40 pixels from the origin are as exact as near it") { compare_share(hard_edges(kFar), 17); }

  TEST_CASE("disks tangent to sides, through corners, inside one pixel or one knot cell are exact") {
    compare_share(hard_disks(), 5);
  }

  TEST_CASE("boards whose squares lie on pixel sides and corners are exact") { compare_share(hard_boards(), 19); }

  TEST_CASE("edges along every knot line of every filter, and almost along it, are exact") {
    compare_at_knots([](ExactComparison& compare, std::span<const double> knots, std::size_t i) {
      const double at = kCentre + knots[i], tilt = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-15 : -1e-9;
      compare(scenes::edge({at, kCentre}, {1, tilt}), kPixel);
      compare(scenes::edge({kCentre, at}, {tilt, -1}), kPixel);
      // Next to the knot line on both sides.
      compare(scenes::edge({std::nextafter(at, -99), kCentre}, {-1, 0}), kPixel);
      compare(scenes::edge({kCentre, std::nextafter(at, 99)}, {0, 1}), kPixel);
      // Through a corner of knot lines.
      compare(scenes::edge({at, kCentre + knots[knots.size() / 3]}, {1, i % 2 == 0 ? 1.0 : -0.3}), kPixel);
    });
  }

  TEST_CASE("circles inside a knot cell, tangent to its sides and through its corners are exact") {
    compare_at_knots([](ExactComparison& compare, std::span<const double> knots, std::size_t i) {
      const double x = kCentre + knots[i], r = 0x1p-3;
      // Tangent to a knot line from the left, and from the right with the other line through its centre.
      compare(scenes::disk({x - r, kCentre + 0.3 * knots[0]}, r), kPixel);
      compare(scenes::disk({kCentre + knots[knots.size() / 3], x + r}, r), kPixel);
      // Around a corner of knot lines, and through one.
      compare(scenes::disk({x, kCentre + knots[knots.size() / 2]}, 0.4), kPixel);
      compare(scenes::disk({x + 0.6, kCentre + knots[knots.size() / 3] - 0.8}, 1), kPixel);
      if (i + 1 == knots.size()) return;
      // Inside the cell, then tangent to two of its sides (to four on the diagonal).
      const std::size_t j = (i + knots.size() / 3) % (knots.size() - 1);
      const double half = (knots[i + 1] - knots[i]) / 2, y = kCentre + (knots[j] + knots[j + 1]) / 2;
      compare(scenes::disk({x + half, y}, 0.4 * std::min(half, (knots[j + 1] - knots[j]) / 2)), kPixel);
      compare(scenes::disk({x + half, y}, half), kPixel);
    });
  }

  // Where a circle touches two knot lines at once, give or take an ulp, an arc between two of its special points is
  // shorter than their rounding. The disk of radius 0.149... in the left lower corner of a pixel was once
  // 0.063569846909 under the box, an arc's segment less than its area.
  TEST_CASE("circles tangent to two knot lines at once, give or take a few ulp, are exact") {
    constexpr double kSmall = 0.14918724507828604;
    ExactComparison box("box", kBoxTolerance);
    box(scenes::disk({7.1491872450782825, 7.8508127549217139}, kSmall), kPixel);
    Draw draw(41);
    for (const std::string& text : test::separable_texts()) {
      ExactComparison compare(text, tolerance(text));
      const Filter filter(parse_spec(text, "test"));
      const std::span<const double> knots = filter.kernel().knots();
      const auto knot = [&] { return knots[static_cast<std::size_t>(draw.integer(0, std::ssize(knots) - 1))]; };
      const auto nudged = [&](double x) {
        for (std::int64_t n = draw.integer(0, 4); n > 0; --n) x = std::nextafter(x, draw.coin() ? -99 : 99);
        return x;
      };
      for (int i = 0; i < (text == "box" ? 20000 : 30); ++i) {
        const double r = draw.log_uniform(0.01, 2), x = kCentre + knot(), y = kCentre + knot();
        compare(scenes::disk({nudged(draw.coin() ? x - r : x + r), nudged(draw.coin() ? y - r : y + r)}, r), kPixel);
      }
      MESSAGE(compare.summary());
    }
  }

  TEST_CASE("huge circles tangent to every knot line are exact") {
    compare_at_knots([](ExactComparison& compare, std::span<const double> knots, std::size_t i) {
      // Within the rounding of the centre, 1e-7 pixel for the larger one, which is part of the scene.
      const double r = i % 2 == 0 ? 1e5 : 1e9, side = i % 4 < 2 ? 1 : -1;
      compare(scenes::disk({kCentre + knots[i] + side * r, kCentre}, r), kPixel);
      compare(scenes::disk({kCentre + knots[knots.size() / 3], kCentre + knots[i] - side * r}, r), kPixel);
    });
  }

  TEST_CASE("boards whose lines are knot lines are exact") {
    compare_at_knots([](ExactComparison& compare, std::span<const double> knots, std::size_t i) {
      if (i % 4 != 1) return;  // the oracle is slow here
      const double at = kCentre + knots[i], side = kCentre + knots[knots.size() / 3];
      compare(scenes::board({0.5, 0, -0.5 * at, 0, -0.5, 0.5 * side, 0, 0, 1}, {-1, 2, -2, 0.5}), kPixel);
    });
  }
}

TEST_SUITE("slow") {
  TEST_CASE("every filter meets a third of all hard edges and disks") {
    for (const auto& cases : {hard_edges(0), hard_edges(kFar), hard_disks(), huge_disks(), far_disks()})
      compare_share(cases, 3);
  }

  TEST_CASE("every filter meets a third of all hard boards") {
    for (const auto& cases : {hard_boards(), far_boards(), boards_underfoot()}) compare_share(cases, 3);
  }
}

}  // namespace moire
