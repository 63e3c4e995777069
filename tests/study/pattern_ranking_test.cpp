// Ranking of patterns at equal samples and at equal time, on tables whose ranking is known.
#include "study/pattern_ranking.h"

#include <doctest/doctest.h>

#include <cmath>

namespace moire {
namespace {

// rmse = error / sqrt(spp), interval of `spread` either way (1: none); time = cost * spp.
Row row_of(const char* scene, const char* pattern, std::int64_t spp, double error, double cost, double spread) {
  Row row;
  row.set("scene", scene);
  row.set("pattern", pattern);
  row.set("spp", spp);
  row.set("filter", "box");
  row.set("estimator", "ratio");
  row.set("layout", "pixel");
  const double rmse = error / std::sqrt(static_cast<double>(spp));
  row.set("rmse_active", rmse);
  row.set("rmse_active_lo", spread > 1 ? Cell(rmse / spread) : Cell());
  row.set("rmse_active_hi", spread > 1 ? Cell(rmse * spread) : Cell());
  row.set("time_render_ns", cost * static_cast<double>(spp));
  return row;
}

TEST_SUITE("unit") {
  TEST_CASE("errors are ranked over the scene's best, with both intervals in the ratio's") {
    const Table ranking = rank_patterns({row_of("edge", "a", 4, 2, 1, 1.1), row_of("edge", "b", 4, 1, 1, 1.2),
                                         row_of("edge", "c", 4, 4, 1, 1), row_of("disk", "a", 4, 7, 1, 1.1)});
    REQUIRE(ranking.size() == 4);
    CHECK(ranking[0].number("relative_rmse") == doctest::Approx(2));
    CHECK(ranking[1].number("relative_rmse") == 1);
    CHECK(ranking[3].number("relative_rmse") == 1);
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(ranking[i].number("rank") == doctest::Approx(i == 0 ? 2 : i == 1 ? 1 : 3));
    const double both = std::exp(std::hypot(std::log(1.1), std::log(1.2)));
    CHECK(ranking[0].number("relative_rmse_hi") == doctest::Approx(2 * both));
    CHECK(ranking[0].number("relative_rmse_lo") == doctest::Approx(2 / both));
    CHECK(ranking[1].number("relative_rmse_hi") == 1);                         // of itself
    CHECK(ranking[2].number("relative_rmse_hi") == doctest::Approx(4 * 1.2));  // c does not vary, b does
  }

  TEST_CASE("at equal time a pattern that costs twice as much has had half the samples") {
    // a errs 2 / sqrt n at time n, b 1 / sqrt n at time 8 n: at equal time t, a errs 2 / sqrt t, b sqrt 8 / sqrt t.
    Table rows;
    for (const std::int64_t spp : {1, 4, 16, 64, 256}) {
      rows.push_back(row_of("edge", "a", spp, 2, 1, 1));
      rows.push_back(row_of("edge", "b", spp, 1, 8, 1));
    }
    for (const Row& row : rank_patterns(rows)) {
      const bool a = row.text("pattern") == "a";
      CHECK(row.number("relative_rmse") == doctest::Approx(a ? 2 : 1));
      // The time is sqrt 8 n, half way between the two. b's first point is later than that of n = 1, and a's last one
      // earlier than that of n = 256, where a stays at 2 / sqrt 256 and b is at sqrt 8 / sqrt(256 sqrt 8).
      const double spp = row.number("spp"), relative = row.number("relative_at_equal_time");
      if (spp == 256) {
        CHECK(relative == doctest::Approx(a ? 2 / std::pow(8.0, 0.25) : 1));
      } else if (spp == 1 && !a) {
        CHECK(std::isnan(relative));
        CHECK(std::isnan(row.number("rank_at_equal_time")));
      } else {
        CHECK(relative == doctest::Approx(a ? 1 : std::sqrt(2.0)));
        CHECK(row.number("rank_at_equal_time") == (a ? 1 : 2));
      }
    }
  }

  TEST_CASE("a time that was disturbed does not count for more than that of more samples") {
    Table rows;
    for (const std::int64_t spp : {1, 4, 16, 64, 256}) {
      rows.push_back(row_of("edge", "a", spp, 2, spp == 4 ? 1000 : 1, 1));  // 4000 where 4 was due and 16 is the next
      rows.push_back(row_of("edge", "b", spp, 2, 1, 1));
    }
    for (const Row& row : rank_patterns(rows)) {
      // At 4 samples a now seems to cost 16, and its line from 1 to 16 samples to stand upright there: between the
      // times 1 and 16 it seems to err 2 to 1, and b 2 to 1/2. Elsewhere nothing has changed.
      const bool near = row.number("spp") == 4;
      CHECK(row.number("relative_at_equal_time") >= 0.999);
      CHECK(row.number("relative_at_equal_time") <= (near ? 2 : 1.001));
    }
  }

  TEST_CASE("a pattern that no time is enough for has no place by time, and one without error leaves no ratio") {
    const Table apart = rank_patterns({row_of("edge", "a", 4, 2, 1, 1), row_of("edge", "b", 4, 1, 8, 1)});
    CHECK(apart[0].number("relative_at_equal_time") == 1);
    CHECK(std::isnan(apart[1].number("relative_at_equal_time")));
    const Table exact = rank_patterns({row_of("edge", "a", 4, 0, 1, 1), row_of("edge", "b", 4, 1, 1, 1)});
    CHECK(exact[0].number("rank") == 1);
    CHECK(std::isnan(exact[1].number("relative_rmse")));  // over nothing
    CHECK(exact[1].number("rank") == 2);
  }

  TEST_CASE("times are medians over the trials of a case") {
    Table rows;
    for (const double time : {30.0, 10.0, 20.0, 1000.0}) {
      rows.push_back(row_of("edge", "a", 1, 1, time, 1));
      rows.back().set("pixels_active", std::int64_t{10});
    }
    const Table timed = with_times({row_of("edge", "a", 1, 1, 0, 1)}, rows);
    CHECK(timed[0].number("time_render_ns") == 25);
    CHECK(timed[0].number("time_per_active_pixel_ns") == 2.5);
  }
}

}  // namespace
}  // namespace moire
