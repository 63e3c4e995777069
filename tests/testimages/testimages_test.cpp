// Properties of every kind of scene: membership is exact, cover never lies, boundaries enclose what is inside.
#include <doctest/doctest.h>
#include <quadmath.h>

#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "curve/polygon.h"
#include "scenes.h"

using namespace moire;

namespace {

using Quad = __float128;

// A scene with its definition in 113-bit arithmetic: positive inside, negative outside, 0 on the boundary. Values up to
// `noise` in magnitude may be rounding (0: everything is exact there).
struct Case {
  std::string name;
  TestImage scene;
  Quad (*inside)(const StoredDoubles&, Pixel p, double x, double y);
  double noise = 0;
};

// The offset from a scene's point to pixel p + (x, y), the large parts first, so that tiny x and y survive.
Quad offset(double from, std::int64_t pixel, double x) { return (Quad(pixel) - from) + x; }

Quad edge_inside(const StoredDoubles& s, Pixel p, double x, double y) {
  return offset(s[0].second[0], p.x, x) * s[1].second[0] + offset(s[0].second[1], p.y, y) * s[1].second[1];
}

Quad disk_inside(const StoredDoubles& s, Pixel p, double x, double y) {
  const Quad dx = offset(s[0].second[0], p.x, x), dy = offset(s[0].second[1], p.y, y), r = s[1].second[0];
  return r * r - dx * dx - dy * dy;
}

Quad disks_inside(const StoredDoubles& s, Pixel p, double x, double y) {
  const std::vector<double>& d = s[0].second;
  Quad inside = -1;
  for (std::size_t i = 0; i < d.size(); i += 3) {
    const Quad dx = offset(d[i], p.x, x), dy = offset(d[i + 1], p.y, y), r = d[i + 2];
    const Quad value = r * r - dx * dx - dy * dy;
    if (i == 0 || value > inside) inside = value;
  }
  return inside;
}

// +-distance in squares to the nearest line, by the plane's definition.
Quad board_inside(const StoredDoubles& s, Pixel p, double px, double py) {
  const Quad x = offset(0, p.x, px), y = offset(0, p.y, py);
  const std::vector<double>& h = s[0].second;
  const std::vector<double>& e = s[1].second;
  const Quad U = h[0] * x + h[1] * y + h[2], V = h[3] * x + h[4] * y + h[5], W = h[6] * x + h[7] * y + h[8];
  if (W <= 0) return -1;
  const Quad u = U / W, v = V / W;
  if (u < e[0] || u > e[1] || v < e[2] || v > e[3]) return -1;
  return fmodq(floorq(u) + floorq(v), 2) == 0 ? 1 : -1;
}

std::vector<Case> cases() {
  using namespace scenes;
  std::vector<Case> all;
  const double far = 0x1p40;
  all.push_back({"edge", edge({31.3, 30.7}, 97.3), edge_inside, 64 * 0x1p-110});
  all.push_back({"edge, far", edge({far + 31.25, -far + 30.75}, {0.25, -0.75}), edge_inside});
  all.push_back({"edge, vertical", edge({32, 7}, 180), edge_inside});
  all.push_back({"edge, diagonal", edge({32, 32}, 45), edge_inside, 64 * 0x1p-110});
  all.push_back({"edge, through lattice points", edge({16, 16}, {3, -1}), edge_inside});
  all.push_back({"disk", disk({31.7, 32.3}, 20.25), disk_inside, 4096 * 0x1p-110});
  all.push_back({"disk, through lattice points", disk({32, 32}, 5), disk_inside, 0});
  all.push_back({"disk, small", disk({31.7, 32.3}, 0.01), disk_inside, 4096 * 0x1p-110});
  all.push_back({"disk, huge", disk({32 + 6e8, 32 + 8e8}, 1e9), disk_inside, 8e18 * 0x1p-110});
  all.push_back({"disks", disks({20.3, 25.1, 9.7, 38.9, 31.7, 3.2, 33.1, 24.8, 1e-3, 40, 40, 1e-6}), disks_inside,
                 8192 * 0x1p-110});
  // All touch in lattice points or half of them; such a point is inside.
  all.push_back({"disks, touching",
                 disks({32, 28, 5, 41, 40, 10, 23, 28, 4, 27.5, 34, 2.5, 32, 22.5, 0.5, 41, 29.75, 0.25}),
                 disks_inside});
  all.push_back({"disks, far", disks({far + 5.25, -far + 5, 5, far + 15.25, -far + 5, 5, far + 10.25, -far + 0.5, 0.5}),
                 disks_inside});
  all.push_back({"board, level", board({0.25, 0, -8, 0, 0.25, -8, 0, 0, 1}, {-7, 7, -7, 7}), board_inside});
  all.push_back(
      {"board, camera",
       board({.focal = 64, .principal = {32, 32}, .height = 1.5, .pitch = 25, .yaw = 7, .roll = 3}, {-3, 4, 1, 9}),
       board_inside});
  return all;
}

// The pixel of each case around which points are thrown.
Pixel home(const Case& c) {
  const StoredDoubles s = c.scene.stored();
  if (c.inside == edge_inside)
    return {static_cast<std::int64_t>(s[0].second[0]), static_cast<std::int64_t>(s[0].second[1])};
  if (c.inside == disks_inside) {
    const std::vector<double>& d = s[0].second;
    return {static_cast<std::int64_t>(d[0] + d[2]), static_cast<std::int64_t>(d[1])};
  }
  if (c.inside == disk_inside && s[1].second[0] < 1) return {31, 32};
  if (c.inside == disk_inside && s[1].second[0] < 10) return {29, 28};
  if (c.inside == disk_inside && s[1].second[0] < 100) return {11, 32};
  return {32, 32};
}

bool contains(const TestImage& scene, Pixel p, double x, double y) {
  std::uint8_t in = 7;
  scene.contains({&p, 1}, {&x, 1}, {&y, 1}, {&in, 1});
  REQUIRE(in <= 1);
  return in == 1;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("scene names are unique and described") {
    std::set<std::string_view> names;
    for (const TestImageInfo* t : testimages()) {
      CHECK(names.insert(t->name).second);
      CHECK_FALSE(t->title.empty());
      CHECK_FALSE(t->cite.empty());
    }
    CHECK_THROWS_AS(find_testimage("egde", "test"), Error);
  }

  TEST_CASE("membership equals 113-bit arithmetic, on and next to boundaries too") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::uniform_int_distribution<int> spread(-24, 24), eighth(0, 7);
    for (const Case& c : cases()) {
      CAPTURE(c.name);
      const StoredDoubles stored = c.scene.stored();
      const auto check = [&](Pixel p, double x, double y) {
        const Quad want = c.inside(stored, p, x, y);
        if (c.noise == 0 || fabsq(want) > c.noise) CHECK(contains(c.scene, p, x, y) == (want >= 0));
      };
      const Pixel h = home(c);
      for (int i = 0; i < 2000; ++i) {
        const Pixel p{h.x + spread(random), h.y + spread(random)};
        // Anywhere, and on a grid of eighths, where lattice lines and rational edges pass exactly.
        const double x = i % 2 != 0 ? unit(random) : eighth(random) / 8.0,
                     y = i % 2 != 0 ? unit(random) : eighth(random) / 8.0;
        check(p, x, y);
        // Walk along x to the boundary, by halving, and look at the doubles around it.
        double low = 0, high = std::nextafter(1.0, 0);
        const bool at_low = contains(c.scene, p, low, y);
        if (at_low == contains(c.scene, p, high, y)) continue;
        for (int step = 0; step < 60; ++step) {
          const double mid = 0.5 * (low + high);
          (contains(c.scene, p, mid, y) == at_low ? low : high) = mid;
        }
        double near = low;
        for (int ulp = 0; ulp < 4; ++ulp) near = std::nextafter(near, -1.0);
        for (int ulp = 0; ulp < 9; ++ulp) {
          if (near >= 0 && near < 1) check(p, near, y);
          near = std::nextafter(near, 2.0);
        }
      }
    }
  }

  TEST_CASE("a run of pixels is answered as its pixels one by one") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const Case& c : cases()) {
      CAPTURE(c.name);
      const Pixel h = home(c);
      std::vector<Pixel> run;
      for (int i = 0; i < 9; ++i) run.push_back({h.x - 4 + i, h.y});
      std::vector<double> x(run.size() * 5), y(x.size());
      for (double& v : x) v = unit(random);
      for (double& v : y) v = unit(random);
      std::vector<std::uint8_t> inside(x.size());
      c.scene.contains(run, x, y, inside);
      for (std::size_t i = 0; i < x.size(); ++i) CHECK((inside[i] == 1) == contains(c.scene, run[i / 5], x[i], y[i]));
    }
  }

  TEST_CASE("cover is never contradicted by a point of its rectangle, corners and sides included") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0, 1), size(-6, 1.5);
    std::uniform_int_distribution<int> spread(-20, 20), snap(0, 2);
    for (const Case& c : cases()) {
      CAPTURE(c.name);
      const Pixel h = home(c);
      int clear = 0, partial = 0;
      for (int i = 0; i < 4000; ++i) {
        const Pixel p{h.x + spread(random), h.y + spread(random)};
        const double w = std::exp(size(random));
        const double x0 = snap(random) == 0 ? 0 : unit(random), y0 = snap(random) == 0 ? 0 : unit(random);
        const Rect r{{x0, y0}, {snap(random) == 0 ? x0 + 1 : x0 + w, y0 + w}};
        const Cover cover = c.scene.cover(p, r);
        if (cover == Cover::partial) {
          ++partial;
          continue;
        }
        ++clear;
        const bool all = cover == Cover::all;
        for (const double t : {0.0, 0.5, 1.0, unit(random)}) {
          for (const double s : {0.0, 0.5, 1.0, unit(random)}) {
            CHECK(contains(c.scene, p, r.lo.x + t * (r.hi.x - r.lo.x), r.lo.y + s * (r.hi.y - r.lo.y)) == all);
          }
        }
      }
      CHECK(clear > 0);  // and it does say something
      CHECK(partial > 0);
    }
  }

  TEST_CASE("cover is sharp: rectangles a little away from the boundary are clear, touching ones are not") {
    using namespace scenes;
    const TestImage e = edge({256, 0}, 180, {512, 512});  // inside: x <= 256
    CHECK(e.cover({255, 10}, {{0, 0}, {1, 1}}) == Cover::partial);
    CHECK(e.cover({255, 10}, {{0, 0}, {1 - 1e-9, 1}}) == Cover::all);
    CHECK(e.cover({256, 10}, {{1e-9, 0}, {1, 1}}) == Cover::none);
    CHECK(e.cover({0, 0}, {{0, 0}, {255, 511}}) == Cover::all);
    const TestImage d = disk({10, 10}, 5);
    CHECK(d.cover({15, 10}, {{0, -1}, {1, 1}}) == Cover::partial);  // tangent
    CHECK(d.cover({15, 10}, {{1e-9, -1}, {1, 1}}) == Cover::none);
    CHECK(d.cover({7, 7}, {{0, 0}, {6, 6}}) == Cover::all);
    CHECK(d.cover({0, 0}, {{0, 0}, {20, 20}}) == Cover::partial);
    const TestImage b = board({1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 8, 0, 8});
    CHECK(b.cover({2, 2}, {{1e-9, 1e-9}, {1 - 1e-9, 1 - 1e-9}}) == Cover::all);
    CHECK(b.cover({2, 3}, {{1e-9, 1e-9}, {1 - 1e-9, 1 - 1e-9}}) == Cover::none);
    CHECK(b.cover({2, 2}, {{0, 0}, {1, 1}}) == Cover::partial);
    CHECK(b.cover({8, 2}, {{1e-9, 0}, {50, 50}}) == Cover::none);  // off the board
  }

  TEST_CASE("the boundary winds once around the inside and not at all around the outside") {
    std::mt19937_64 random(4);
    const double half = 2;
    std::uniform_real_distribution<double> unit(-half, half);
    for (const Case& c : cases()) {
      CAPTURE(c.name);
      const Pixel h = home(c);
      Boundary boundary;
      c.scene.boundary(h, half, boundary);
      CHECK(boundary.area_error <= 1e-11);
      CHECK(boundary.segments.size() + boundary.circles.size() > 0);
      for (int i = 0; i < 500; ++i) {
        const Vec2 p{unit(random), unit(random)};
        double winding = 0;
        bool near = false;
        for (const Segment& s : boundary.segments) {
          const Vec2 a{s.a.x - p.x, s.a.y - p.y}, b{s.b.x - p.x, s.b.y - p.y};
          const double cross = a.x * b.y - a.y * b.x;
          near |= std::fabs(cross) < 1e-6;
          winding += s.weight * std::atan2(cross, a.x * b.x + a.y * b.y);
        }
        double turns = winding / (2 * 3.14159265358979323846);
        for (const Circle& k : boundary.circles) {
          // |p - c|^2 - R^2 = p . (p - 2 c) - power.
          const double excess = p.x * (p.x - 2 * k.center.x) + p.y * (p.y - 2 * k.center.y) - k.power;
          near |= std::fabs(excess) < 1e-6 * k.radius;
          turns += excess < 0 ? 1 : 0;
        }
        if (near) continue;
        // From the centre to the corner: 0.5 + p, in the pixel that holds it.
        const Pixel at{h.x + static_cast<std::int64_t>(std::floor(p.x + 0.5)),
                       h.y + static_cast<std::int64_t>(std::floor(p.y + 0.5))};
        const double x = p.x + 0.5 - std::floor(p.x + 0.5), y = p.y + 0.5 - std::floor(p.y + 0.5);
        CHECK(std::fabs(turns - (contains(c.scene, at, x, y) ? 1 : 0)) <= 1e-6);
      }
    }
  }

  TEST_CASE("directions in degrees are exact at multiples of 45 and right to an ulp elsewhere") {
    const auto normal = [](double degrees) {
      const std::vector<double> n = scenes::edge({0, 0}, degrees).stored()[1].second;
      return Vec2{n[0], n[1]};
    };
    CHECK(normal(0) == Vec2{1, 0});
    CHECK(normal(90) == Vec2{0, 1});
    CHECK(normal(180) == Vec2{-1, 0});
    CHECK(normal(270) == Vec2{0, -1});
    CHECK(normal(-90) == Vec2{0, -1});
    CHECK(normal(360e10) == Vec2{1, 0});
    for (const double d : {45.0, 135.0, 225.0, 315.0, -45.0, 405.0})
      CHECK(std::fabs(normal(d).x) == std::fabs(normal(d).y));
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> degrees(-720, 720);
    for (int i = 0; i < 5000; ++i) {
      const double d = i % 2 == 0 ? degrees(random) : std::ldexp(degrees(random), -static_cast<int>(random() % 60));
      const Quad angle = fmodq(d, 360) * (acosq(Quad(-1)) / 180);
      const Vec2 n = normal(d);
      for (const auto& [got, want] : {std::pair{n.x, cosq(angle)}, std::pair{n.y, sinq(angle)}}) {
        const double ulp = std::nextafter(std::fabs(got), 2.0) - std::fabs(got);
        CHECK(static_cast<double>(fabsq(Quad(got) - want)) <= ulp);
      }
    }
  }

  TEST_CASE("a component of the normal that is too small to change anything decides on the line through the point") {
    for (const double tiny : {1e-300, -1e-300, 5e-324}) {
      const TestImage scene = scenes::edge({4.5, 4.5}, Vec2{1e300, tiny}, {9, 9});
      const std::vector<double> x = {0.5, 0.5, 0.5, std::nextafter(0.5, 0), std::nextafter(0.5, 1)};
      const std::vector<double> y = {0.25, 0.5, 0.75, 0.5, 0.5};
      std::vector<std::uint8_t> inside(x.size());
      const Pixel pixel{4, 4};
      scene.contains({&pixel, 1}, x, y, inside);
      CHECK(inside == std::vector<std::uint8_t>{tiny<0, 1, tiny> 0, 0, 1});
    }
  }

  TEST_CASE("a camera is the homography of its rays") {
    // Ray of (x, y), rolled, pitched and yawed one after the other in 113 bits; u = height X / Y, v = height Z / Y.
    const scenes::Camera c{.focal = 300, .principal = {128, 100}, .height = 2.5, .pitch = 17, .yaw = -12, .roll = 9};
    const std::vector<double> h = scenes::board(c, {-50, 50, -50, 50}).stored()[0].second;
    const Quad degree = acosq(Quad(-1)) / 180;
    for (const Vec2 p : {Vec2{10, 200}, Vec2{128, 150}, Vec2{250, 255}}) {
      const Quad x = (p.x - c.principal.x) / Quad(c.focal), y = (p.y - c.principal.y) / Quad(c.focal), z = 1;
      const Quad r = c.roll * degree, t = c.pitch * degree, w = c.yaw * degree;
      const Quad x1 = x * cosq(r) - y * sinq(r), y1 = x * sinq(r) + y * cosq(r);
      const Quad y2 = y1 * cosq(t) + z * sinq(t), z2 = -y1 * sinq(t) + z * cosq(t);
      const Quad X = x1 * cosq(w) + z2 * sinq(w), Z = -x1 * sinq(w) + z2 * cosq(w);
      const Quad W = h[6] * Quad(p.x) + h[7] * Quad(p.y) + h[8];
      const Quad u = (h[0] * Quad(p.x) + h[1] * Quad(p.y) + h[2]) / W,
                 v = (h[3] * Quad(p.x) + h[4] * Quad(p.y) + h[5]) / W;
      // The stored matrix is rounded: a few ulp of terms of size up to 2, divided by W.
      CHECK(static_cast<double>(fabsq(u - c.height * X / y2)) <= 1e-13);
      CHECK(static_cast<double>(fabsq(v - c.height * Z / y2)) <= 1e-13);
    }
  }
}
