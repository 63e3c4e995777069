// The process of dart-throwing without most of its misses, against the plain one: every candidate of the whole torus
// thrown, every one compared with every kept point.
#include "patterns/dart_process.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/hash.h"
#include "measure/discrepancy/star_l2.h"

using namespace moire;

namespace {

struct Torus {
  double width, height;
};

double distance2(const Torus& torus, double ax, double ay, double bx, double by) {
  double dx = std::abs(ax - bx), dy = std::abs(ay - by);
  dx = std::min(dx, torus.width - dx);
  dy = std::min(dy, torus.height - dy);
  return dx * dx + dy * dy;
}

struct Thrown {
  std::vector<double> x, y;
  double radius;  // at the end
};

double first_radius(const Torus& torus, int n) {
  return std::sqrt(2 * torus.width * torus.height / (std::sqrt(3.0) * n));
}

Thrown thrown_plainly(const Key& key, const Torus& torus, int n, int k) {
  Thrown t{{}, {}, first_radius(torus, n)};
  int misses = 0;
  for (std::uint32_t c = 0; t.x.size() < static_cast<std::size_t>(n); ++c) {
    const Words w = hash(key, c, Axis::dart);
    const double x = torus.width * unit(w.a, w.b), y = torus.height * unit(w.c, w.d);
    bool near = false;
    for (std::size_t i = 0; i < t.x.size() && !near; ++i)
      near = distance2(torus, t.x[i], t.y[i], x, y) < t.radius * t.radius;
    if (!near) {
      t.x.push_back(x);
      t.y.push_back(y);
      misses = 0;
    } else if (++misses == k) {
      t.radius *= 0.99;
      misses = 0;
    }
  }
  return t;
}

Thrown thrown(const Key& key, const Torus& torus, int n, int k, int most_boxes = 1024) {
  DartProcess::Memory memory(n, first_radius(torus, n), torus.width, torus.height, most_boxes);
  const auto count = static_cast<std::size_t>(n);
  Thrown t{std::vector<double>(count), std::vector<double>(count), 0};
  t.radius = DartProcess(key, Axis::dart, k, memory, t.x.data(), t.y.data()).run(n);
  return t;
}

std::vector<double> nearest_distances2(const Thrown& t, const Torus& torus) {
  std::vector<double> nearest(t.x.size(), torus.width * torus.width + torus.height * torus.height);
  for (std::size_t i = 0; i < t.x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double d2 = distance2(torus, t.x[i], t.y[i], t.x[j], t.y[j]);
      nearest[i] = std::min(nearest[i], d2);
      nearest[j] = std::min(nearest[j], d2);
    }
  return nearest;
}

// What sets are compared by: how often the radius shrank, the least distance, the mean distance to the nearest point,
// the distance of the last point to its nearest one, and T, the L2 star discrepancy on the unit square.
constexpr int kStatistics = 5;
constexpr const char* kNames[kStatistics] = {"shrinkings", "least distance", "mean nearest", "last nearest", "T"};

std::vector<double> statistics(const Thrown& t, const Torus& torus) {
  const auto n = static_cast<double>(t.x.size());
  const std::vector<double> nearest = nearest_distances2(t, torus);
  double mean = 0;
  for (const double d2 : nearest) mean += std::sqrt(d2) / n;
  std::vector<double> x = t.x, y = t.y;
  for (double& v : x) v /= torus.width;
  for (double& v : y) v /= torus.height;
  return {std::round(std::log(t.radius / first_radius(torus, static_cast<int>(n))) / std::log(0.99)),
          std::sqrt(*std::min_element(nearest.begin(), nearest.end())), mean, std::sqrt(nearest.back()),
          std::sqrt(star_l2_squared({x, y}))};
}

// The statistic of N. V. Smirnov (1939) for two samples of one size m: sqrt(m / 2) times the largest difference of
// their distribution functions. Above z with a probability of 2 exp(-2 z^2), or less where values repeat.
double smirnov(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double most = 0;
  for (const double v : a) {
    const auto below = [v](const std::vector<double>& s) {
      return std::upper_bound(s.begin(), s.end(), v) - s.begin();
    };
    most = std::max(most, std::abs(static_cast<double>(below(a) - below(b))));
  }
  return most / std::sqrt(2.0 * static_cast<double>(a.size()));
}

void check_same_law(const Torus& torus, int n, int k, std::uint32_t sets, int most_boxes = 1024) {
  CAPTURE(n);
  CAPTURE(k);
  CAPTURE(most_boxes);
  std::vector<double> plain[kStatistics], fast[kStatistics];
  for (std::uint32_t s = 0; s < sets; ++s) {
    const auto a = statistics(thrown_plainly(pixel_key(draw_hash(31, s), {}), torus, n, k), torus);
    const auto b = statistics(thrown(pixel_key(draw_hash(32, s), {}), torus, n, k, most_boxes), torus);
    for (std::size_t i = 0; i < kStatistics; ++i) {
      plain[i].push_back(a[i]);
      fast[i].push_back(b[i]);
    }
  }
  for (std::size_t i = 0; i < kStatistics; ++i) {
    CAPTURE(std::string(kNames[i]));
    // Of about 60 comparisons here, one in 200 runs of other seeds fails by chance.
    CHECK(smirnov(plain[i], fast[i]) < 2.2);
    double mean = 0, squares = 0;
    for (std::size_t s = 0; s < sets; ++s) {
      mean += (fast[i][s] - plain[i][s]) / sets;
      squares += (fast[i][s] - plain[i][s]) * (fast[i][s] - plain[i][s]) / sets;
    }
    CHECK(std::abs(mean) <= 4 * std::sqrt((squares - mean * mean) / (sets - 1)));
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("no two points are nearer than the radius at the end, and it is the start times 0.99^i") {
    for (const int n : {1, 2, 3, 4, 5, 8, 11, 12, 13, 16, 50, 64, 200, 500})
      for (const int k : {1, 10, 300, 5000})
        for (const Torus& torus : {Torus{1, 1}, Torus{7, 3}, Torus{2, 90}}) {
          CAPTURE(n);
          CAPTURE(k);
          const Thrown t = thrown(pixel_key(draw_hash(21, static_cast<std::uint32_t>(n)), {}), torus, n, k);
          if (n > 1) {
            const std::vector<double> nearest = nearest_distances2(t, torus);
            CHECK(std::sqrt(*std::min_element(nearest.begin(), nearest.end())) >= t.radius);
          }
          double radius = first_radius(torus, n);
          while (radius > t.radius) radius *= 0.99;
          CHECK(radius == t.radius);
          CHECK((*std::min_element(t.x.begin(), t.x.end()) >= 0 && *std::min_element(t.y.begin(), t.y.end()) >= 0));
          CHECK(*std::max_element(t.x.begin(), t.x.end()) < torus.width);
          CHECK(*std::max_element(t.y.begin(), t.y.end()) < torus.height);
        }
  }

  TEST_CASE("a set does not depend on what its memory was used for") {
    const Key one = pixel_key(draw_hash(5, 0), {}), two = pixel_key(draw_hash(5, 1), {});
    DartProcess::Memory memory(100, first_radius({1, 1}, 100), 1, 1, 1024);
    std::vector<double> x(100), y(100);
    for (const Key& key : {one, two, one}) {
      DartProcess(key, Axis::dart, 500, memory, x.data(), y.data()).run(100);
      const Thrown fresh = thrown(key, {1, 1}, 100, 500);
      CHECK(x == fresh.x);
      CHECK(y == fresh.y);
    }
  }

  TEST_CASE("a covered box has no place for a dart, and the list has every box that has one, once") {
    const Key key = pixel_key(draw_hash(77, 0), {});
    for (const Torus& torus : {Torus{1, 1}, Torus{3, 1}, Torus{1, 20}}) {
      const double r0 = 0.2;
      DartBoxes::Memory memory(r0, torus.width, torus.height, 1000);
      DartBoard::Memory board_memory(1000, r0, torus.width, torus.height);
      DartBoxes boxes(memory);
      DartBoard board(board_memory);
      double r = r0;
      const auto count = [&](DartBoxes::Box box) {
        int times = 0;
        for (std::size_t i = 0; i < boxes.listed(); ++i)
          times += boxes.listed_box(i).x == box.x && boxes.listed_box(i).y == box.y;
        return times;
      };
      bool has_list = false;
      int open_places = 0, covered_places = 0, lists = 0;
      std::uint32_t c = 0;
      for (int step = 0; step < 12; ++step) {
        // Points anywhere, closer than dart-throwing would put them.
        for (int i = 0; i < 2 + static_cast<int>(4 * torus.width * torus.height); ++i) {
          const Words w = hash(key, c++, Axis::dart);
          const double x = torus.width * unit(w.a, w.b), y = torus.height * unit(w.c, w.d);
          board.keep(x, y);
          boxes.keep(x, y, r);
        }
        for (std::size_t i = 0; i < boxes.listed(); i += 3) boxes.drop_if_covered(i);
        // A list that holds for two shrinkings at a time.
        if (step % 2 == 0) {
          has_list = has_list ? boxes.extend(r * 0.95) : boxes.list(r * 0.95);
          lists += has_list;
        }
        boxes.set_radius(r);
        for (std::uint32_t place = 0; place < 500; ++place) {
          const Words w = hash(key, place, Axis::shift);
          const double x = torus.width * unit(w.a, w.b), y = torus.height * unit(w.c, w.d);
          const DartBoxes::Box box = boxes.box_of(x, y);
          const bool near = board.too_near(x, y, r);
          if (boxes.covered(box)) {
            ++covered_places;
            CHECK(near);
          } else if (!near) {
            ++open_places;
          }
          if (has_list) {
            CHECK(count(box) <= 1);
            if (!boxes.covered(box)) CHECK(count(box) == 1);
          }
        }
        r *= 0.95;
      }
      CHECK(open_places > 100);
      CHECK(covered_places > 100);
      CHECK(lists > 1);
    }
  }

  TEST_CASE("the logarithms behind numbers of misses are right to 2^-49") {
    for (std::uint32_t i = 0; i < 20000; ++i) {
      const Words w = hash(pixel_key(draw_hash(3, 0), {}), i, Axis::xy);
      for (const double x : {1 - unit(w.a, w.b), std::ldexp(1 - unit(w.a, w.b), -static_cast<int>(w.c % 1000)),
                             1 - std::ldexp(unit(w.a, w.b), -static_cast<int>(w.d % 60))}) {
        const auto want = static_cast<double>(-std::log(static_cast<long double>(x)));
        CHECK(std::abs(minus_log(x) - want) <= 0x1p-49 * want);
      }
      const std::uint64_t whole = 1 + w.a, part = w.b % (whole + 1);
      for (const std::uint64_t p : {part, part / 1000, whole / 2, whole - 1}) {
        // Near 1 the rounding of p / whole would count.
        const auto share = static_cast<long double>(p) / static_cast<long double>(whole);
        const auto rest = static_cast<long double>(whole - p) / static_cast<long double>(whole);
        const auto want = static_cast<double>(2 * p < whole ? -std::log1p(-share) : -std::log(rest));
        CHECK(std::abs(miss_rate(p, whole) - want) <= 0x1p-49 * want);
      }
    }
    CHECK(minus_log(1.0) == 0);
    CHECK(miss_rate(0, 5) == 0);
    CHECK(std::isinf(miss_rate(5, 5)));
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("dart-throwing has the law of the plain process over thousands of sets") {
    check_same_law({1, 1}, 16, 300, 6000);
    check_same_law({1, 1}, 50, 200, 6000);
  }

  TEST_CASE("dart-throwing has the law of the plain process, from few points to many and from few misses to many") {
    const Torus square{1, 1};
    check_same_law(square, 16, 5000, 100);
    check_same_law(square, 16, 100, 400);
    check_same_law(square, 64, 200, 300);
    check_same_law(square, 256, 100, 200);
    check_same_law(square, 64, 5, 400);   // the list is made for many shrinkings at once
    check_same_law(square, 256, 1, 200);  // and here not at all
    check_same_law(square, 3, 50, 400);   // one cell holds all points
  }

  TEST_CASE("dart-throwing has the law of the plain process on an oblong, and with boxes as wide as the radius") {
    check_same_law({5, 2}, 40, 100, 300);
    check_same_law({1, 6}, 30, 30, 300);
    check_same_law({1, 1}, 64, 100, 300, 10);
  }
}
