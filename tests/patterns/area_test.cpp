// Patterns that fill a whole image as one set: where the points are, how they are sorted, and that only the draw
// decides.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "chi_square.h"
#include "core/error.h"
#include "patterns/area_points.h"
#include "patterns/variants.h"

using namespace moire;
using namespace moire::test;

namespace {

std::vector<PatternChoice> area_patterns() {
  std::vector<PatternChoice> all;
  for (const std::string& text : variants()) {
    PatternChoice choice = chosen(text);
    if (choice.info().area_count != nullptr) all.push_back(std::move(choice));
  }
  return all;
}

PointSet fill(const PatternChoice& choice, Grid area, std::int64_t spp, Draw draw = {}) {
  const auto count = static_cast<std::size_t>(choice.area_count(area, spp));
  PointSet set = room_for(count, choice.has_time());
  choice.info().fill_area(choice.args(), area, draw, points_of(set));
  return set;
}

std::string message_of(const PatternChoice& choice, Grid area, std::int64_t spp) {
  try {
    choice.area_count(area, spp);
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

double nearest_on_torus(const PointSet& set, double width, double height) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < set.x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = std::fabs(set.x[i] - set.x[j]), dy = std::fabs(set.y[i] - set.y[j]);
      nearest = std::min(nearest, std::hypot(std::min(dx, width - dx), std::min(dy, height - dy)));
    }
  }
  return nearest;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("points of areas lie in them, as many as were announced, and only the draw decides where") {
    for (const PatternChoice& choice : area_patterns()) {
      CAPTURE(choice.text());
      for (const Grid area : {Grid{1, 1}, Grid{7, 3}, Grid{2, 31}, Grid{40, 25}}) {
        for (const int spp : {1, 2, 5}) {
          const PointSet set = fill(choice, area, spp, {3, 1});
          const double wanted = static_cast<double>(spp) * area.width * area.height;
          // A grid has whole columns and rows: at most half a row of the columns too few or too many.
          CHECK(std::fabs(static_cast<double>(set.x.size()) - wanted) <= 0.5 * std::sqrt(wanted * area.width) + 1);
          for (std::size_t i = 0; i < set.x.size(); ++i) {
            REQUIRE((set.x[i] >= 0 && set.x[i] < area.width && set.y[i] >= 0 && set.y[i] < area.height));
          }
          for (const double t : set.t) REQUIRE((t >= 0 && t < 1));
          CHECK(set == fill(choice, area, spp, {3, 1}));
          PointSet still = room_for(set.x.size(), false);
          choice.info().fill_area(choice.args(), area, {3, 1}, points_of(still));
          CHECK(still.x == set.x);
          CHECK(still.y == set.y);
          for (const Draw draw : {Draw{3, 2}, Draw{4, 1}}) {
            const PointSet other = fill(choice, area, spp, draw);
            CHECK((set.x != other.x) == choice.varies());
            CHECK((set.y != other.y) == choice.varies());
            CHECK((set.t != other.t) == (choice.varies(true) && choice.has_time()));
          }
        }
      }
    }
  }

  TEST_CASE("points of areas are uniform over trials, pixel by pixel and within pixels") {
    for (const char* text :
         {"random", "jittered", "jittered-random-time", "n-rooks", "dart-throwing:k=100", "hammersley:instance=shift",
          "hammersley:instance=scramble", "zaremba:instance=shift", "zaremba:instance=scramble"}) {
      CAPTURE(text);
      const Grid area{6, 4};
      std::vector<std::uint32_t> pixels(24), places(16), times(24);
      for (std::uint32_t trial = 0; trial < 400; ++trial) {
        const PointSet set = fill(chosen(text), area, 2, {1, trial});
        for (std::size_t i = 0; i < set.x.size(); ++i) {
          ++pixels[static_cast<std::size_t>(set.x[i]) + 6 * static_cast<std::size_t>(set.y[i])];
          const double u = set.x[i] - std::floor(set.x[i]), v = set.y[i] - std::floor(set.y[i]);
          ++places[static_cast<std::size_t>(4 * u) + 4 * static_cast<std::size_t>(4 * v)];
          if (!set.t.empty()) ++times[static_cast<std::size_t>(24 * set.t[i])];
        }
      }
      // Points of one set keep apart, so counts vary less than independent ones: too even is no fault.
      CHECK(z_of_counts(pixels) < 5);
      CHECK(z_of_counts(places) < 5);
      if (chosen(text).has_time()) CHECK(z_of_counts(times) < 5);
    }
  }

  TEST_CASE("sorted points are the pattern's points, each in its pixel and in the order in which it was made") {
    for (const PatternChoice& choice : area_patterns()) {
      CAPTURE(choice.text());
      const Grid grid{9, 5};
      const int apron = 2;
      const Grid area{13, 9};
      const AreaPoints sorted(choice, grid, apron, 3, {2, 7}, choice.has_time());
      const PointSet set = fill(choice, area, 3, {2, 7});
      REQUIRE(sorted.count() == static_cast<std::int64_t>(set.x.size()));
      CHECK(sorted.has_time() == choice.has_time());
      CHECK(sorted.density() == static_cast<double>(set.x.size()) / (13 * 9));
      CHECK(sorted.fits(grid, apron));
      CHECK_FALSE(sorted.fits(grid, 1));
      std::size_t seen = 0;
      for (int y = -apron; y < grid.height + apron; ++y) {
        const auto row = sorted.points(-apron, grid.width + apron, y);
        for (int x = -apron; x < grid.width + apron; ++x) {
          const auto p = static_cast<std::size_t>(x + apron);
          std::vector<std::tuple<double, double, double>> here, want;
          const auto time = [](const auto& t, std::size_t i) { return t.empty() ? -1 : t[i]; };
          for (std::size_t i = row.first[p]; i < row.first[p + 1]; ++i) {
            here.emplace_back(row.x[i], row.y[i], time(row.t, i));
          }
          for (std::size_t i = 0; i < set.x.size(); ++i) {
            if (std::floor(set.x[i]) == x + apron && std::floor(set.y[i]) == y + apron) {
              want.emplace_back(set.x[i] - (x + apron), set.y[i] - (y + apron), time(set.t, i));
            }
          }
          CHECK(here == want);
          seen += here.size();
        }
      }
      CHECK(seen == set.x.size());
    }
  }

  TEST_CASE("darts keep their distance across the borders of an oblong area, in pixels") {
    for (const Grid area : {Grid{24, 6}, Grid{5, 20}, Grid{10, 10}}) {
      const PointSet set = fill(chosen("dart-throwing"), area, 4);
      // Maximal random packings cover about 0.55 of what the hexagonal lattice covers, 0.9069: distances of 0.75 of its
      // sqrt(2 / sqrt(3) / density) are to be expected, and 0.65 if the last points had to squeeze in.
      const double hexagonal = std::sqrt(2 / std::sqrt(3.0) / 4);
      const double nearest = nearest_on_torus(set, area.width, area.height);
      CHECK(nearest > 0.65 * hexagonal);
      CHECK(nearest < hexagonal);
      CHECK(nearest_on_torus(fill(chosen("random"), area, 4), area.width, area.height) < 0.3 * hexagonal);
    }
  }

  TEST_CASE("n rooks over an area stand one in each column and each row of n") {
    const Grid area{8, 5};
    const PointSet set = fill(chosen("n-rooks"), area, 3);
    const double n = 120;
    std::set<int> columns, rows;
    for (std::size_t i = 0; i < set.x.size(); ++i) {
      columns.insert(static_cast<int>(set.x[i] / area.width * n));
      rows.insert(static_cast<int>(set.y[i] / area.height * n));
    }
    CHECK(columns.size() == 120);
    CHECK(rows.size() == 120);
  }

  TEST_CASE("a jittered area has one point in each cell of its shifted grid") {
    const Grid area{12, 8};
    const PatternChoice choice = chosen("jittered");
    const PointSet set = fill(choice, area, 4, {1, 5});
    REQUIRE(set.x.size() == 24 * 16);  // cells of half a pixel
    // Some shift puts each point in a cell of its own; 64 x 64 shifts are tried, each then a 128th of a cell off.
    int best = 0;
    for (int a = 0; a < 64; ++a) {
      for (int b = 0; b < 64; ++b) {
        std::set<std::pair<int, int>> cells;
        for (std::size_t i = 0; i < set.x.size(); ++i) {
          const double x = std::fmod(set.x[i] * 2 + 24 - (a + 0.5) / 64, 24),
                       y = std::fmod(set.y[i] * 2 + 16 - (b + 0.5) / 64, 16);
          cells.emplace(static_cast<int>(x), static_cast<int>(y));
        }
        best = std::max(best, static_cast<int>(cells.size()));
      }
    }
    // A 128th of a cell to either side, in both axes: 2 in 128 of the points may be in a neighbour's cell.
    CHECK(best > 0.96 * 24 * 16);
  }

  TEST_CASE("what cannot fill areas, and what would be too many points, is refused with what is possible") {
    const std::string regular = message_of(chosen("regular"), {8, 8}, 4);
    CHECK(regular.find("pattern \"regular\" cannot fill an image as one set; these can: random, jittered, n-rooks") !=
          std::string::npos);
    for (const PatternChoice& choice : area_patterns()) {
      CHECK(message_of(choice, {8192, 8192}, 1).empty());
      CHECK(message_of(choice, {8192, 8192}, 2).find("more than 67108864 points") != std::string::npos);
      CHECK(message_of(choice, {1 << 20, 1 << 20}, kMaxSamples).find("more than 67108864") != std::string::npos);
    }
  }

  TEST_CASE("oblong cells take any count, and are squares where the count is one") {
    const PatternChoice oblong = chosen("jittered:cells=oblong");
    for (int n = 1; n <= 100; ++n) CHECK_NOTHROW(oblong.require_count(n));
    CHECK(set_of("jittered:cells=oblong", 16) == set_of("jittered", 16));
    // 12 samples: 4 columns, 3 rows.
    const PointSet set = set_of("jittered:cells=oblong", 12);
    std::set<std::pair<int, int>> cells;
    for (std::size_t i = 0; i < 12; ++i) cells.emplace(static_cast<int>(4 * set.x[i]), static_cast<int>(3 * set.y[i]));
    CHECK(cells.size() == 12);
  }
}
