// The index of disks against looking at every disk.
#include "testimages/disk_index.h"

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "disk_sets.h"

using namespace moire;
using namespace moire::test;

namespace {

using Quad = __float128;
Quad wide(double x) { return static_cast<Quad>(x); }

// The squared distance of the rectangle to the disk's centre over that of the rim; they meet when it is at most 1.
double relative_distance2(const GivenCircle& c, const Rect& r) {
  const auto gap = [](double at, double lo, double hi) {
    return at < lo ? wide(lo) - wide(at) : at > hi ? wide(at) - wide(hi) : Quad(0);
  };
  const Quad dx = gap(c.center.x, r.lo.x, r.hi.x), dy = gap(c.center.y, r.lo.y, r.hi.y), radius = wide(c.radius);
  return static_cast<double>((dx * dx + dy * dy) / (radius * radius));
}

struct Set {
  std::string name;
  std::vector<GivenCircle> disks;
};

std::vector<Set> sets() {
  Random random(1);
  std::vector<Set> all;
  all.push_back({"one", random_disks(random, 1, 64, 0, 0.9)});
  all.push_back({"two", random_disks(random, 2, 64, 0, 0.9)});
  all.push_back({"all places alike", random_disks(random, 700, 64, 0, 0.9)});
  all.push_back({"touching", random_disks(random, 700, 64, 0, 1)});
  all.push_back({"clustered, radii of 12 decades", random_disks(random, 700, 64, 0.97, 0.9)});
  // A dust of equal disks around one that is 10^12 times larger, and a line of them: boxes degenerate.
  std::vector<GivenCircle> dust{{{32, 32}, 1e6}}, line;
  for (int i = 0; i < 500; ++i) {
    const double angle = random.uniform(0, 6.28);
    dust.push_back({{32 + (1e6 + 1 + 1e-3 * i) * std::cos(angle), 32 + (1e6 + 1 + 1e-3 * i) * std::sin(angle)}, 1e-6});
    line.push_back({{i * 0.125, 7}, 0.0625});
  }
  all.push_back({"dust around a giant", dust});
  all.push_back({"a line", line});
  return all;
}

bool overlap_in_quad(const GivenCircle& a, const GivenCircle& b) {
  const Quad dx = wide(a.center.x) - wide(b.center.x), dy = wide(a.center.y) - wide(b.center.y);
  const Quad reach = wide(a.radius) + wide(b.radius);
  return dx * dx + dy * dy < reach * reach;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a visit reports every disk that meets the rectangle, once, and none that misses it") {
    Random random(2);
    for (const Set& set : sets()) {
      CAPTURE(set.name);
      const std::vector<GivenCircle>& disks = set.disks;
      const DiskIndex index(disks);
      REQUIRE(index.entries().size() == disks.size());
      int missed = 0, extra = 0, twice = 0, reported = 0;
      for (int i = 0; i < 800; ++i) {
        // Around some disk at some scale of its own: rectangles far smaller and far larger than disks.
        const GivenCircle& c = disks[random.below(disks.size())];
        const double reach = c.radius * random.log_uniform(0.01, 100);
        const Vec2 lo{c.center.x + random.uniform(-reach, reach), c.center.y + random.uniform(-reach, reach)};
        const Rect r{
            lo, {lo.x + c.radius * random.log_uniform(1e-3, 1e3), lo.y + c.radius * random.log_uniform(1e-3, 1e3)}};
        std::vector<int> seen(disks.size());
        CHECK(index.visit(r, [&](const DiskIndex::Entry& e) {
          ++seen[e.number];
          return true;
        }));
        for (std::size_t d = 0; d < disks.size(); ++d) {
          const double distance2 = relative_distance2(disks[d], r);
          missed += distance2 <= 1 && seen[d] == 0;
          extra += distance2 > 1 + 1e-12 && seen[d] != 0;  // the filter's own slack is 2^-49
          twice += seen[d] > 1;
          reported += seen[d];
        }
      }
      CHECK(missed == 0);
      CHECK(extra == 0);
      CHECK(twice == 0);
      CHECK(reported > 0);
    }
  }

  TEST_CASE("a visit ends when it is told to, and an empty index reports nothing") {
    Random random(3);
    const Rect everywhere{{-1e9, -1e9}, {1e9, 1e9}};
    const DiskIndex index(random_disks(random, 100, 64, 0, 0.9));
    int calls = 0;
    CHECK_FALSE(index.visit(everywhere, [&](const DiskIndex::Entry&) { return ++calls < 5; }));
    CHECK(calls == 5);
    const DiskIndex empty({});
    CHECK(empty.visit(everywhere, [&](const DiskIndex::Entry&) { return false; }));
    CHECK_FALSE(empty.find_overlap());
  }

  TEST_CASE("the index depends on the set of disks, not on their order") {
    Random random(4);
    for (const Set& set : sets()) {
      CAPTURE(set.name);
      std::vector<GivenCircle> disks = set.disks;
      const DiskIndex index(disks);
      for (std::size_t i = disks.size(); i > 1; --i) std::swap(disks[i - 1], disks[random.below(i)]);
      const DiskIndex other(disks);
      int different = 0;
      for (std::size_t i = 0; i < disks.size(); ++i) {
        const GivenCircle &a = index.entries()[i].circle, &b = other.entries()[i].circle;
        different += !(a.center == b.center && a.radius == b.radius);
      }
      CHECK(different == 0);
    }
  }

  TEST_CASE("a rectangle given relative to a pixel is never made smaller, however far away the pixel is") {
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
      const auto far = static_cast<std::int64_t>(random.log_uniform(1, 1e18));
      const Rect r{{random.uniform(-3, 0), random.uniform(-3, 0)}, {random.uniform(0, 3), random.uniform(0, 3)}};
      const Rect a = absolute({far, -far}, r);
      const auto holds = [](double lo, double hi, std::int64_t at, double from, double to) {
        return wide(lo) <= Quad(at) + wide(from) && wide(hi) >= Quad(at) + wide(to);
      };
      CHECK(holds(a.lo.x, a.hi.x, far, r.lo.x, r.hi.x));
      CHECK(holds(a.lo.y, a.hi.y, -far, r.lo.y, r.hi.y));
    }
  }

  TEST_CASE("disjoint sets have no overlap, and one that is planted is found") {
    Random random(6);
    for (const Set& set : sets()) {
      CAPTURE(set.name);
      const std::vector<GivenCircle>& disks = set.disks;
      CHECK_FALSE(DiskIndex(disks).find_overlap());
      int found = 0;
      for (int i = 0; i < 42; ++i) {
        std::vector<GivenCircle> more = disks;
        const std::size_t victim = random.below(disks.size()), place = random.below(disks.size() + 1);
        // A speck at the rim of one disk, inside by a thousandth of its own size, by most of it, or all but touching.
        const GivenCircle& c = disks[victim];
        const double radius = c.radius * 1e-3, angle = random.uniform(0, 6.28);
        const double at = c.radius + radius * (i % 3 == 0 ? 1 - 1e-3 : i % 3 == 1 ? -0.5 : 1 + 1e-9);
        const GivenCircle speck{{c.center.x + at * std::cos(angle), c.center.y + at * std::sin(angle)}, radius};
        more.insert(more.begin() + static_cast<std::ptrdiff_t>(place), speck);
        const bool overlaps =
            std::any_of(disks.begin(), disks.end(), [&](const GivenCircle& d) { return overlap_in_quad(d, speck); });
        found += overlaps;
        const auto pair = DiskIndex(more).find_overlap();
        REQUIRE(pair.has_value() == overlaps);
        if (!pair) continue;
        CHECK(pair->first < pair->second);
        CHECK(overlap_in_quad(more[pair->first], more[pair->second]));
        CHECK((pair->first == place || pair->second == place));
      }
      CHECK(found > 20);
    }
  }

  TEST_CASE("many disks in one place are refused without looking at all pairs") {
    // 200,000 of one kind and as many beside them: all pairs would take minutes.
    std::vector<GivenCircle> disks;
    for (int i = 0; i < 200000; ++i) {
      disks.push_back({{0, 0}, 1});
      disks.push_back({{0.9 + 1e-7 * i, 0.9}, 1e-9});
    }
    CHECK(DiskIndex(disks).find_overlap());
  }

  TEST_CASE("whether two disks overlap equals 113-bit arithmetic, touching and an ulp to either side of it too") {
    Random random(7);
    int touching = 0, close = 0;
    const int triples[][3] = {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {7, 24, 25}, {20, 21, 29}, {0, 1, 1}};
    for (int i = 0; i < 20000; ++i) {
      // Centres a Pythagorean multiple apart, coordinates of few bits: 113 bits hold all squares.
      const auto& t = triples[random.below(6)];
      const double scale =
          std::ldexp(1.0 + static_cast<double>(random.below(1000)), static_cast<int>(random.below(20)) - 10);
      const Vec2 a{static_cast<double>(random.below(1000)), static_cast<double>(random.below(1000))};
      const GivenCircle first{a, t[2] * scale * (static_cast<double>(1 + random.below(1023)) / 1024)};
      GivenCircle second{{a.x + t[0] * scale, a.y - t[1] * scale}, t[2] * scale - first.radius};
      const bool touch = i % 4 == 0;
      if (i % 4 == 1) second.radius = std::nextafter(second.radius, 0.0);
      if (i % 4 == 2) second.radius = std::nextafter(second.radius, 1e300);
      if (i % 4 == 3) second.radius *= random.uniform(0.9, 1.1);
      if (!(second.radius >= kMinRadius)) continue;
      const bool want = overlap_in_quad(first, second);
      CHECK(overlap(first, second) == want);
      CHECK(overlap(second, first) == want);
      touching += touch && !want;
      close += i % 4 == 2 && want;
    }
    CHECK(touching == 5000);
    CHECK(close > 4000);
  }

  TEST_CASE("the sum of two radii is not rounded before it is compared") {
    // 1 + 2^-60 rounds to 1; so does a distance of 1 + 2^-60 from two coordinates of both signs.
    CHECK(overlap({{0, 0}, 1}, {{1, 0}, 0x1p-60}));
    CHECK_FALSE(overlap({{0, 0}, 1}, {{1 + 0x1p-52, 0}, 0x1p-60}));
    CHECK_FALSE(overlap({{-0x1p-60, 0}, 1}, {{1, 0}, 0x1p-60}));
    CHECK(overlap({{-0x1p-60, 0}, 1}, {{1, 0}, 0x1.8p-60}));
    CHECK_FALSE(overlap({{-1e15, 0}, 1e15}, {{kMinRadius, 0}, kMinRadius}));
    CHECK(overlap({{-1e15, 0}, 1e15}, {{0, kMinRadius}, kMinRadius}));
    CHECK(overlap({{0, 0}, kMinRadius}, {{0, 0}, kMinRadius}));  // one in the other
    CHECK_FALSE(overlap({{0, 0}, kMinRadius}, {{2 * kMinRadius, 0}, kMinRadius}));
    CHECK(overlap({{0, 0}, kMinRadius}, {{2 * kMinRadius, 0}, std::nextafter(kMinRadius, 1.0)}));
  }
}
