// Scenes that move while the shutter is open: which points are inside at which time, what a rectangle holds at all
// times, and the boundary that is moved.
#include <doctest/doctest.h>
#include <quadmath.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/error.h"
#include "moving_scenes.h"

using namespace moire;

namespace {

using Quad = __float128;
using Random = std::mt19937_64;

double uniform(Random& random, double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(random() >> 11) * 0x1p-53);
}
// A multiple of 1 / parts from lo to hi.
double grid_point(Random& random, int lo, int hi, int parts) {
  return lo + static_cast<double>(random() % static_cast<std::uint64_t>((hi - lo) * parts + 1)) / parts;
}

// An edge (radius 0) or a disk.
struct Shape {
  Vec2 at, normal;
  double radius;
  Vec2 motion;

  TestImage image() const {
    return radius > 0 ? scenes::moving_disk(at, radius, motion) : scenes::moving_edge(at, normal, motion);
  }
  // Positive inside, 0 on the boundary.
  Quad inside(Pixel p, double x, double y, double t) const {
    const Quad dx = (Quad(p.x) - at.x) + x - Quad(t) * motion.x, dy = (Quad(p.y) - at.y) + y - Quad(t) * motion.y;
    return radius > 0 ? Quad(radius) * radius - dx * dx - dy * dy : dx * normal.x + dy * normal.y;
  }
  // Below this its sign may be rounding: products of 113 bits, of numbers up to 100.
  static constexpr double kNoise = 0x1p-90;
};

bool inside_at(const TestImage& scene, Pixel p, double x, double y, double t) {
  std::uint8_t in = 0;
  scene.contains_at({&p, 1}, {&x, 1}, {&y, 1}, {&t, 1}, {&in, 1});
  return in != 0;
}

Shape random_shape(Random& random) {
  Shape s{{uniform(random, -20, 20), uniform(random, -20, 20)}, {}, 0, {}};
  s.motion = {uniform(random, -9, 9), uniform(random, -9, 9)};
  if (random() % 5 == 0) s.motion.x = 0;
  if (random() % 5 == 0) s.motion.y = 0;
  if (random() % 7 == 0) s.motion = {s.motion.x * 1e-9, s.motion.y * 1e-9};
  if (s.motion == Vec2{}) s.motion = {0, 1};
  if (random() % 2 == 0) {
    s.radius = std::exp(uniform(random, -3, 3));
  } else {
    s.normal = {uniform(random, -1, 1), uniform(random, -1, 1)};
  }
  return s;
}

std::string refusal(const char* kind, Given keys, std::vector<double> motion) {
  Value v = scenes::list(std::move(motion));
  v.place = "s.toml:4:1";
  keys.emplace_back("motion", v);
  try {
    const TestImage image(find_testimage(kind, ""), keys, {8, 8}, "test");
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a point is inside at a time by exact signs, on the moved boundary and an ulp beside it") {
    Random random(31);
    int on_boundary = 0, wrong = 0;
    const auto check = [&](const Shape& s, const TestImage& image, Pixel p, double x, double y, double t, bool exact) {
      const Quad value = s.inside(p, x, y, t);
      if (!exact && fabsq(value) < Shape::kNoise) return;
      on_boundary += value == 0;
      wrong += inside_at(image, p, x, y, t) != (value >= 0);
    };
    // Few bits everywhere, so that 113 are exact: points on the boundary itself.
    for (int i = 0; i < 3000; ++i) {
      Shape s{{grid_point(random, -4, 4, 4), grid_point(random, -4, 4, 4)}, {}, 0, {}};
      s.motion = {grid_point(random, -4, 4, 8), grid_point(random, -4, 4, 8)};
      if (s.motion == Vec2{}) continue;
      if (i % 2 == 0) s.radius = 1.25;  // a 3-4-5 circle in quarters
      s.normal = {grid_point(random, 1, 3, 1), grid_point(random, -3, 3, 1)};
      const TestImage image = s.image();
      const double t = grid_point(random, 0, 1, 8);
      const double signs[] = {-1, 1};
      const Vec2 rim = s.radius > 0 ? Vec2{0.75 * signs[random() % 2], 1.0 * signs[random() % 2]}
                                    : Vec2{-s.normal.y / 4, s.normal.x / 4};
      const Vec2 on{s.at.x + t * s.motion.x + rim.x, s.at.y + t * s.motion.y + rim.y};
      const Pixel p{static_cast<std::int64_t>(std::floor(on.x)), static_cast<std::int64_t>(std::floor(on.y))};
      const double x = on.x - std::floor(on.x), y = on.y - std::floor(on.y);
      check(s, image, p, x, y, t, true);
      check(s, image, p, x + 0x1p-52, y, t, true);
      check(s, image, p, x, y, std::fabs(t - 0x1p-53), false);
      check(s, image, p, x, y, std::min(1.0, t + 0x1p-52), false);
    }
    CHECK(on_boundary > 2000);
    // Any numbers: points that are on the boundary up to rounding.
    for (int i = 0; i < 3000; ++i) {
      const Shape s = random_shape(random);
      const TestImage image = s.image();
      const double t = uniform(random, 0, 1), angle = uniform(random, 0, 6.283), along = uniform(random, -9, 9);
      const Vec2 rim = s.radius > 0 ? Vec2{s.radius * std::cos(angle), s.radius * std::sin(angle)}
                                    : Vec2{-s.normal.y * along, s.normal.x * along};
      const Vec2 on{s.at.x + t * s.motion.x + rim.x, s.at.y + t * s.motion.y + rim.y};
      const Pixel p{static_cast<std::int64_t>(std::floor(on.x)), static_cast<std::int64_t>(std::floor(on.y))};
      for (int k = -3; k <= 3; ++k) {
        check(s, image, p, on.x - std::floor(on.x) + k * 0x1p-52, on.y - std::floor(on.y), t, false);
      }
      check(s, image, p, uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1), false);
    }
    CHECK(wrong == 0);
  }

  TEST_CASE("a run of pixels is answered as its points are, and at time 0 as without motion") {
    Random random(32);
    for (int i = 0; i < 100; ++i) {
      const Shape s = random_shape(random);
      const TestImage image = s.image();
      const Vec2 at{s.at.x + 0.5 * s.motion.x, s.at.y + 0.5 * s.motion.y};
      std::vector<Pixel> run;
      std::vector<double> x, y, t, zero;
      for (int p = -3; p < 3; ++p) {
        run.push_back({static_cast<std::int64_t>(std::floor(at.x)) + p, static_cast<std::int64_t>(std::floor(at.y))});
        for (int j = 0; j < 5; ++j) {
          x.push_back(uniform(random, 0, 1));
          y.push_back(uniform(random, 0, 1));
          t.push_back(uniform(random, 0, 1));
          zero.push_back(0);
        }
      }
      std::vector<std::uint8_t> in(x.size()), at_zero(x.size()), still(x.size());
      image.contains_at(run, x, y, t, in);
      image.contains_at(run, x, y, zero, at_zero);
      image.contains(run, x, y, still);
      CHECK(at_zero == still);
      for (std::size_t k = 0; k < x.size(); ++k) CHECK((in[k] != 0) == inside_at(image, run[k / 5], x[k], y[k], t[k]));
    }
  }

  TEST_CASE("moving disks are the union of their disks, at any time and in any rectangle") {
    Random random(33);
    std::vector<double> circles;
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < 12; ++j) {
        for (const double v : {i + 0.5, j + 0.5, uniform(random, 0.05, 0.5)}) circles.push_back(v);
      }
    }
    for (const Vec2 motion : {Vec2{5.5, -2.25}, Vec2{0, 7}, Vec2{1e-3, 1e-3}, Vec2{-40, 31}}) {
      const TestImage all = scenes::moving_disks(circles, motion);
      std::vector<TestImage> single;
      for (std::size_t c = 0; c < circles.size(); c += 3) {
        single.push_back(scenes::moving_disk({circles[c], circles[c + 1]}, circles[c + 2], motion));
      }
      int inside = 0, wrong = 0, clear = 0;
      for (int i = 0; i < 300; ++i) {
        const Pixel p{static_cast<std::int64_t>(random() % 16), static_cast<std::int64_t>(random() % 16)};
        const std::size_t n = i % 2 == 0 ? 1 : 40;
        std::vector<double> x(n), y(n), t(n);
        for (std::size_t k = 0; k < n; ++k) {
          x[k] = uniform(random, 0, 1);
          y[k] = uniform(random, 0, 1);
          t[k] = uniform(random, 0, 1);
        }
        std::vector<std::uint8_t> got(n), want(n), one(n);
        all.contains_at({&p, 1}, x, y, t, got);
        const Rect r{{0, 0}, {uniform(random, 0, 0.5), uniform(random, 0, 0.5)}};
        Cover cover = Cover::none;
        for (const TestImage& s : single) {
          s.contains_at({&p, 1}, x, y, t, one);
          for (std::size_t k = 0; k < n; ++k) want[k] |= one[k];
          if (s.cover(p, r) != Cover::none) cover = s.cover(p, r);
        }
        wrong += got != want;
        for (const std::uint8_t v : got) inside += v;
        CHECK(all.cover(p, r) == cover);
        clear += cover != Cover::partial;
      }
      CHECK(wrong == 0);
      CHECK(inside > 0);
      CHECK(clear > 0);
    }
  }

  TEST_CASE("cover is right about every point of a rectangle at every time") {
    Random random(34);
    int clear = 0, partial = 0, wrong = 0;
    for (int i = 0; i < 20000; ++i) {
      const Shape s = random_shape(random);
      const TestImage image = s.image();
      const double when = uniform(random, 0, 1), reach = s.radius > 0 ? 1.5 * s.radius : 5;
      const Pixel p{static_cast<std::int64_t>(std::floor(s.at.x + when * s.motion.x + uniform(random, -reach, reach))),
                    static_cast<std::int64_t>(std::floor(s.at.y + when * s.motion.y + uniform(random, -reach, reach)))};
      const double size = std::exp(uniform(random, -6, 1.5));
      const double x0 = random() % 3 == 0 ? 0 : uniform(random, 0, 1),
                   y0 = random() % 3 == 0 ? 0 : uniform(random, 0, 1);
      const Rect r{{x0, y0}, {x0 + size, random() % 3 == 0 ? y0 : y0 + size}};
      const Cover cover = image.cover(p, r);
      if (cover == Cover::partial) {
        ++partial;
        continue;
      }
      ++clear;
      for (const double u : {0.0, 1.0, uniform(random, 0, 1)}) {
        for (const double v : {0.0, 1.0, uniform(random, 0, 1)}) {
          for (const double t : {0.0, 1.0, when, uniform(random, 0, 1)}) {
            const double x = r.lo.x + u * (r.hi.x - r.lo.x), y = r.lo.y + v * (r.hi.y - r.lo.y);
            wrong += inside_at(image, p, x, y, t) != (cover == Cover::all);
          }
        }
      }
    }
    CHECK(wrong == 0);
    CHECK(clear > 1000);
    CHECK(partial > 1000);
  }

  TEST_CASE("cover is sharp: what the boundary misses by 1e-9 pixel at all times is clear") {
    // A disk of radius 5 that moves by (30, 40): its side passes (4, -3) + (15, 20), with normal (0.8, -0.6).
    const TestImage d = scenes::moving_disk({0, 0}, 5, {30, 40});
    const auto corner = [&](double away) {  // the rectangle's lower left corner, y pointing down
      const Vec2 c{0.5 + 0.8 * away, 0.5 - 0.6 * away};
      return d.cover({18, 16}, {{c.x + 0.5, c.y - 0.5}, {c.x + 1.5, c.y + 0.5}});
    };
    CHECK(corner(1e-9) == Cover::none);
    CHECK(corner(0) == Cover::partial);
    CHECK(corner(-1e-9) == Cover::partial);
    CHECK(d.cover({15, 20}, {{-0.1, -0.1}, {0.1, 0.1}}) == Cover::partial);  // passed by, clear at both ends
    CHECK(scenes::moving_disk({0, 0}, 1e-50, {30, 40}).cover({15, 20}, {{0, 0}, {1, 1}}) == Cover::partial);
    const TestImage slow = scenes::moving_disk({0, 0}, 5, {1, 0});
    CHECK(slow.cover({0, 0}, {{-3.99, -0.1}, {4.99, 0.1}}) == Cover::all);
    CHECK(slow.cover({0, 0}, {{-4.01, -0.1}, {4.99, 0.1}}) == Cover::partial);
    const TestImage e = scenes::moving_edge({0, 0}, {1, 0}, {3, 100});  // x >= 3 t
    CHECK(e.cover({0, 0}, {{3 + 1e-9, 0}, {9, 9}}) == Cover::all);
    CHECK(e.cover({0, 0}, {{3, 0}, {9, 9}}) == Cover::partial);
    CHECK(e.cover({0, 0}, {{-9, 0}, {-1e-9, 9}}) == Cover::none);
    CHECK(e.cover({0, 0}, {{-9, 0}, {0, 9}}) == Cover::partial);
  }

  TEST_CASE("the boundary, moved along, encloses what is inside at that time") {
    Random random(35);
    const double half = 2;
    int inside = 0, outside = 0;
    for (int i = 0; i < 300; ++i) {
      const Shape s = random_shape(random);
      const TestImage image = s.image();
      const double when = uniform(random, 0, 1);
      const Pixel p{static_cast<std::int64_t>(std::floor(s.at.x + when * s.motion.x + s.radius)),
                    static_cast<std::int64_t>(std::floor(s.at.y + when * s.motion.y))};
      Boundary boundary;
      image.boundary(p, half, boundary);
      for (int k = 0; k < 20; ++k) {
        const double x = uniform(random, -half, half), y = uniform(random, -half, half), t = uniform(random, 0, 1);
        const Vec2 q{x - t * image.sweep().x, y - t * image.sweep().y};
        double turns = 0;
        bool near = false;
        for (const Segment& g : boundary.segments) {
          const Vec2 a{g.a.x - q.x, g.a.y - q.y}, b{g.b.x - q.x, g.b.y - q.y};
          const double cross = a.x * b.y - a.y * b.x;
          near |= std::fabs(cross) < 1e-6;
          turns += std::atan2(cross, a.x * b.x + a.y * b.y) / (2 * 3.14159265358979323846);
        }
        for (const Circle& c : boundary.circles) {
          const double excess = std::hypot(q.x - c.center.x, q.y - c.center.y) - c.radius;
          near |= std::fabs(excess) < 1e-6;
          turns += excess < 0 ? 1 : 0;
        }
        if (near) continue;
        const bool in = inside_at(image, p, x + 0.5, y + 0.5, t);
        CHECK(std::fabs(turns - (in ? 1 : 0)) < 1e-6);
        (in ? inside : outside) += 1;
      }
    }
    CHECK(inside > 500);
    CHECK(outside > 500);
  }

  TEST_CASE("a motion of (0, 0) is none: the same answers, boundary and stored doubles") {
    const TestImage pairs[][2] = {
        {scenes::moving_edge({3, 4}, {0.3, -0.7}, {0, -0.0}), scenes::edge({3, 4}, {0.3, -0.7})},
        {scenes::moving_disk({3, 4}, 2.5, {0, 0}), scenes::disk({3, 4}, 2.5)},
        {scenes::moving_disks({3, 4, 2.5, 9, 9, 1}, {0, 0}), scenes::disks({3, 4, 2.5, 9, 9, 1})}};
    for (const auto& [moved, still] : pairs) {
      CHECK(!moved.moves());
      CHECK(moved.stored() == still.stored());
      Boundary a, b;
      moved.boundary({4, 4}, 1.5, a);
      still.boundary({4, 4}, 1.5, b);
      REQUIRE(a.segments.size() == b.segments.size());
      for (std::size_t i = 0; i < a.segments.size(); ++i) {
        CHECK(a.segments[i].a == b.segments[i].a);
        CHECK(a.segments[i].b == b.segments[i].b);
      }
      REQUIRE(a.circles.size() == b.circles.size());
      for (std::size_t i = 0; i < a.circles.size(); ++i) CHECK(a.circles[i].center == b.circles[i].center);
      for (int i = 0; i < 12; ++i)
        CHECK(moved.cover({i, 4}, {{0, 0}, {1, 1}}) == still.cover({i, 4}, {{0, 0}, {1, 1}}));
    }
    CHECK(scenes::moving_edge({3, 4}, {0, 1}, {5, 2}).stored().back() ==
          std::pair<std::string, std::vector<double>>{"motion", {5, 2}});
    // Along itself an edge moves and does not.
    const TestImage along = scenes::moving_edge({3, 4}, {0.25, -0.5}, {2, 1});
    CHECK(along.moves());
    CHECK(along.sweep() == Vec2{});
  }

  TEST_CASE("motions that are no displacement, too large or too small are refused with their place") {
    const Given edge{{"through", scenes::list({1, 2})}, {"normal", scenes::one(30)}};
    const auto says = [](const std::string& message, const char* part) {
      return message.find(part) != std::string::npos;
    };
    CHECK(refusal("edge", edge, {1, 2}).empty());
    CHECK(refusal("edge", edge, {0x1p20, 0}).empty());
    CHECK(says(refusal("edge", edge, {1}), "s.toml:4:1: \"motion\" must be a displacement, [dx, dy] in pixels"));
    CHECK(says(refusal("edge", edge, {1, 2, 3}), "must be a displacement"));
    CHECK(says(refusal("edge", edge, {0, 2e6}), "\"motion\" is 2e+06; each component must be 0 or 1e-30 to 1048576"));
    CHECK(says(refusal("edge", edge, {1e-31, 1}), "each component must be 0 or"));
    CHECK(says(refusal("edge", edge, {NAN, 1}), "finite"));
    CHECK(says(refusal("noise-field", {}, {1, 2}), "motion"));
  }
}
