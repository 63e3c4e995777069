// Running studies: plan order, sharing, what observers see, and that threads and order change nothing.
#include "study/run.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

using namespace moire;

namespace {

const char* const kText = R"(
patterns = ["regular", "random", "dart-throwing:bank=4,k=200"]
spp = [4, 1]
trials = 3
filters = ["box", "tent"]
images = "first-trial"
[[scene]]
name = "tilted"
kind = "edge"
width = 24
height = 16
through = [12.3, 8.1]
normal = 20
[[scene]]
kind = "disk"
width = 20
height = 20
center = [10.2, 9.9]
radius = 6.5
)";

Study small_study() { return parse_study(kText, "s.toml", "s"); }

// The row without its times, as text.
std::string fingerprint(const Row& row) {
  std::string text;
  for (const auto& [name, cell] : row.cells()) {
    if (name.starts_with("time_")) continue;
    text += name + "=";
    if (const auto* d = std::get_if<double>(&cell)) text += shortest(*d);
    if (const auto* i = std::get_if<std::int64_t>(&cell)) text += std::to_string(*i);
    if (const auto* b = std::get_if<bool>(&cell)) text += *b ? "true" : "false";
    if (const auto* s = std::get_if<std::string>(&cell)) text += *s;
    text += ";";
  }
  return text;
}

std::string fingerprint(const Table& rows) {
  std::string text;
  for (const Row& row : rows) text += fingerprint(row) + "\n";
  return text;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("rows come in plan order and each is handed out once as it is finished") {
    const Study study = small_study();
    const std::vector<Case> cases = plan(study);
    Observer observer;
    std::multiset<std::string> seen;
    std::set<std::pair<std::uint32_t, std::uint32_t>> exact_images;
    std::size_t case_images = 0;
    double share = 0;
    observer.row = [&](const Row& row) { seen.insert(fingerprint(row)); };
    observer.exact_image = [&](std::uint32_t scene, std::uint32_t filter, const Truth& truth) {
      CHECK(exact_images.insert({scene, filter}).second);
      CHECK(static_cast<std::int64_t>(truth.exact.value.size()) == truth.rows.active_pixels());
    };
    observer.case_image = [&](const Case& c, const Truth&, const CaseResult& result) {
      CHECK(c.trial == 0);
      CHECK(result.row.text("image_got").ends_with("_t0.got.exr"));
      ++case_images;
    };
    std::size_t steps = 0;
    observer.progress = [&](std::size_t done, std::size_t due, double work) {
      CHECK(done == ++steps);
      CHECK(due == cases.size());
      CHECK(work > share);
      share = work;
    };
    const Results results = run(study, cases, observer);
    CHECK(results.complete);
    CHECK(share == doctest::Approx(1).epsilon(1e-12));  // a sum of about 60 terms
    REQUIRE(results.rows.size() == cases.size());
    CHECK(exact_images.size() == 4);
    CHECK(case_images == 2 * 3 * 2 * 2);  // scenes, patterns, counts, filters
    CHECK(seen.size() == cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Row& row = results.rows[i];
      CHECK(seen.count(fingerprint(row)) >= 1);
      CHECK(row.text("scene") == study.scenes[cases[i].scene].name);
      CHECK(row.text("pattern") == study.patterns[cases[i].pattern].text());
      CHECK(row.number("spp") == study.spp[cases[i].spp]);
      CHECK(row.text("filter") == study.filters[cases[i].filter].text());
      CHECK(row.number("trial") == cases[i].trial);
      CHECK(row.text("status") == "ok");
      CHECK((row.text("image_got").empty()) == (cases[i].trial != 0));
    }
  }

  TEST_CASE("threads and the order of work change no value") {
    const Study study = small_study();
    const std::vector<Case> cases = plan(study);
    const std::string whole = fingerprint(run(study, cases, {}).rows);
    {
      const ThreadLimit one(1);
      CHECK(fingerprint(run(study, cases, {}).rows) == whole);
    }
    // Each case alone, without anything shared; the split over trials needs all of them and is compared elsewhere.
    std::size_t index = 0;
    const Table rows = run(study, cases, {}).rows;
    for (const Case& c : cases) {
      const Truth truth = find_truth(study.scenes[c.scene].image, study.filters[c.filter]);
      const Pattern pattern(study.patterns[c.pattern], study.spp[c.spp], Draw{study.seed, c.trial});
      Row alone = run_case(study, c, pattern, 0, truth).row;
      for (const std::string_view name : {"bias_sq_active", "variance_active"})
        alone.set(name, *rows[index].find(name));
      CHECK(fingerprint(alone) == fingerprint(rows[index]));
      ++index;
    }
  }

  TEST_CASE("an exhaustive image has the same row bit for bit") {
    const Study study = small_study();
    for (const Case& c : plan(study)) {
      const Truth truth = find_truth(study.scenes[c.scene].image, study.filters[c.filter]);
      const Pattern pattern(study.patterns[c.pattern], study.spp[c.spp], Draw{study.seed, c.trial});
      Row fast = run_case(study, c, pattern, 0, truth).row;
      Row full = run_case(study, c, pattern, 0, truth, true).row;
      CHECK(full.number("samples_evaluated") == full.number("samples_total"));
      CHECK(fast.number("samples_evaluated") <= full.number("samples_evaluated"));
      full.set("samples_evaluated", *fast.find("samples_evaluated"));
      CHECK(fingerprint(fast) == fingerprint(full));
    }
  }

  TEST_CASE("bias and variance over trials add up to the mean squared error, in the last trial's row") {
    const Study study = small_study();
    const std::vector<Case> cases = plan(study);
    const Table rows = run(study, cases, {}).rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const bool varies = study.patterns[cases[i].pattern].varies();
      if (!varies || cases[i].trial != 2) {
        CHECK(std::isnan(rows[i].number("variance_active")));
        continue;
      }
      double mse = 0;
      for (std::size_t t = 0; t < 3; ++t) mse += rows[i - t].number("mse_active") / 3;
      // Both sides are sums over some dozen pixels of terms below 1: a few hundred roundings of 1e-16 relative.
      CHECK(rows[i].number("bias_sq_active") + rows[i].number("variance_active") ==
            doctest::Approx(mse).epsilon(1e-12));
    }
  }

  TEST_CASE("whatever rows are there already, a run adds the others and ends with the same results") {
    const Study study = small_study();
    const std::vector<Case> cases = plan(study);
    const Table whole = run(study, cases, {}).rows;
    const auto earlier_with = [&](auto&& keep) {
      Table earlier(cases.size());
      for (std::size_t i = 0; i < cases.size(); ++i) {
        if (keep(i)) earlier[i] = whole[i];
      }
      return earlier;
    };
    std::mt19937 random(1);
    for (int round = 0; round < 12; ++round) {
      const Table earlier = earlier_with([&](std::size_t) { return random() % 12 < static_cast<unsigned>(round); });
      std::size_t added = 0, missing = 0, images = 0;
      for (const Row& row : earlier) missing += row.cells().empty();
      Observer observer;
      observer.row = [&](const Row&) { ++added; };
      observer.has_exact_image = [](std::uint32_t, std::uint32_t) { return true; };
      observer.exact_image = [&](std::uint32_t, std::uint32_t, const Truth&) { FAIL("it is there"); };
      observer.has_case_image = [&](const Case& c) { return c.pattern != 0; };  // those of `regular` have gone
      observer.case_image = [&](const Case& c, const Truth&, const CaseResult&) { images += c.pattern == 0; };
      const Results results = run(study, cases, observer, earlier);
      CHECK(results.complete);
      CHECK(added == missing);
      CHECK(images == 2 * 2 * 2);  // scenes, counts, filters
      CHECK(fingerprint(results.rows) == fingerprint(whole));
    }
    // Everything there: no work.
    Observer observer;
    observer.progress = [](std::size_t, std::size_t, double) { FAIL("nothing is due"); };
    CHECK(fingerprint(run(study, cases, observer, whole).rows) == fingerprint(whole));
  }

  TEST_CASE("an earlier row that its case does not give is refused when that is computed again") {
    const Study study = small_study();
    const std::vector<Case> cases = plan(study);
    Table earlier = run(study, cases, {}).rows;
    // `random`, trials 0 to 2: the last one is missing, so that all are computed for the variance.
    std::size_t first = 0;
    while (cases[first].pattern != 1) ++first;
    earlier[first + 2] = {};
    earlier[first].set("mae_all", earlier[first].number("mae_all") * (1 + 1e-15));
    try {
      run(study, cases, {}, earlier);
      FAIL("not refused");
    } catch (const Error& e) {
      CHECK(e.code() == Exit::failed);
      CHECK(std::string(e.what()).find(describe(study, cases[first]) + ": its \"mae_all\" differs") == 0);
    }
  }

  TEST_CASE("a run that is stopped keeps the rows that were finished") {
    const Study study = small_study();
    const std::vector<Case> cases = plan(study);
    Observer observer;
    std::size_t rows = 0;
    observer.row = [&](const Row&) { ++rows; };
    observer.stop = [&] { return rows >= 5; };
    const Results results = run(study, cases, observer);
    CHECK_FALSE(results.complete);
    CHECK(results.rows.size() == 5);
    observer.stop = [] { return true; };
    CHECK(run(study, cases, observer).rows.empty());
  }
}
