// The family of edges, and the judgement that the families of scenes share.
#include <doctest/doctest.h>

#include "stress/exact_checks.h"
#include "stress/naive.h"
#include "stress/scenes.h"

namespace moire::stress {

extern const Family edges;

namespace {

ExactCase through_the_centre() { return {scenes::edge({4.5, 4.5}, Vec2{0.6, 0.8}), {4, 4}, checked_filter("box")}; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("hard edges are within their bounds of the oracle") { check_passes(edges, 3, 400); }

  TEST_CASE("a described edge is the same case again, down to the bits") { check_can_be_rerun(edges, 4, 64); }

  TEST_CASE("2000 hard edges meet every filter of the catalogue") { check_meets_all_filters(edges, 1, 2000); }

  TEST_CASE("an edge through the pixel's centre is worth one half") {
    const Outcome outcome = run(through_the_centre());
    CHECK(outcome.wanted == 0.5);
    CHECK(passes(outcome));
  }

  TEST_CASE("a value that is two bounds off fails, in either direction, and so does one that is no number") {
    const ExactCase c = through_the_centre();
    const Exact got = exact_pixel(c.image, c.filter->filter, c.pixel);
    const oracle::Value truth = true_value(c.image, *c.filter, c.pixel);
    CHECK(passes(judged(c, got, truth)));
    CHECK_FALSE(passes(judged(c, {got.value + 2 * got.bound, got.bound}, truth)));
    CHECK_FALSE(passes(judged(c, {got.value - 2 * got.bound, got.bound}, truth)));
    CHECK_FALSE(passes(judged(c, {std::nan(""), got.bound}, truth)));
    CHECK_FALSE(passes(judged(c, {got.value, std::nan("")}, truth)));
  }

  TEST_CASE("a bound above what is promised fails, however true: of edges, tiny disks and boards") {
    const ExactCase cases[] = {
        through_the_centre(),
        {scenes::disk({4.5, 4.5}, 1e-6), {4, 4}, checked_filter("tent")},
        {scenes::board({0.7, 0.1, 0, -0.2, 0.9, 0, 1e-3, 2e-3, 1}, {-8, 8, -8, 8}), {2, 3}, checked_filter("mitchell")},
        {scenes::plane(scenes::Camera{.principal = {32, 32}, .pitch = 0}), {32, 31}, checked_filter("box")}};
    for (const ExactCase& c : cases) {
      const Exact got = exact_pixel(c.image, c.filter->filter, c.pixel);
      const oracle::Value truth{static_cast<long double>(got.value), 0};
      CHECK(passes(judged(c, got, truth)));
      CHECK_FALSE(passes(judged(c, {got.value, 0.5}, truth)));
      CHECK_FALSE(passes(judged(c, {got.value, 1.1 * promised_bound(c)}, truth)));
    }
  }

  TEST_CASE("a value that claims more than it has fails") {
    const ExactCase c{scenes::edge({4.3, 4.4}, Vec2{0.6, 0.8}), {4, 4}, checked_filter("mitchell")};
    const oracle::Value truth = true_value(c.image, *c.filter, c.pixel);
    // One bit of the value, with no bound at all; the oracle knows some ten bits more.
    const double off = std::nextafter(static_cast<double>(truth.value), 2.0);
    CHECK_FALSE(passes(judged(c, {off, 0}, truth)));
  }

  TEST_CASE("textbook coverage of an edge is right for an easy one and wrong 2^40 pixels away") {
    CHECK(naive_coverage(oracle::Edge{{4.5, 4.5}, {0.6, 0.8}}, {4, 4}, 1) == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(naive_coverage(oracle::Edge{{4.25, 4.5}, {1, 0}}, {4, 4}, 1) == 0.75);
    const auto far = static_cast<double>(std::int64_t{1} << 40);
    const double there = naive_coverage(oracle::Edge{{far + 0.25, far + 0.5}, {0.6, 0.8}},
                                        {std::int64_t{1} << 40, std::int64_t{1} << 40}, 1);
    CHECK(std::fabs(there - naive_coverage(oracle::Edge{{0.25, 0.5}, {0.6, 0.8}}, {0, 0}, 1)) > 1e-6);
  }
}

}  // namespace moire::stress
