// The series of radial weights: against itself where nothing else can follow. By parts along u and along v hardly a
// number is common to both.
#include "testimages/radial_series.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "filter_list.h"
#include "testimages/radial_jets.h"
#include "testimages/radial_parts.h"

namespace moire {
namespace {

using test::SeenFilter;

// Filters in turn.
class Filters {
 public:
  const RadialWeight& operator()(std::size_t i) {
    const std::string& text = texts_[i % texts_.size()];
    return seen_.try_emplace(text, text).first->second.weight;
  }
  const std::string& text(std::size_t i) const { return texts_[i % texts_.size()]; }

 private:
  std::vector<std::string> texts_ = test::radial_texts();
  std::map<std::string, SeenFilter> seen_;
};

// J by parts along u, and along v, for a goal; not worked out where it will not be known to kUseless.
constexpr double kUseless = 0.1;
Bounded along_u(const LocalHomography& local, const RadialWeight& weight, const RadialPart& part, double goal) {
  RadialSeries series(local.u, local.v, local.w, weight, part);
  series.lay_out(goal);
  return series.estimate() < kUseless ? series.integrate() : Bounded{0, HUGE_VAL};
}
Bounded along_v(const LocalHomography& local, const RadialWeight& weight, const RadialPart& part, double goal) {
  return along_u({local.v, local.u, local.w}, weight, part, goal);
}

bool agree(const Bounded& a, const Bounded& b) {
  return std::isfinite(a.value) && std::isfinite(b.value) && std::fabs(a.value - b.value) <= a.error + b.error;
}

// How many of so many cases are known well enough that agreement says something.
struct Known {
  int cases = 0, good = 0;
  double worst = 0;
  void add(const Bounded& a, const Bounded& b, double enough) {
    ++cases;
    good += a.error + b.error < enough;
    if (a.error + b.error > 0) worst = std::max(worst, std::fabs(a.value - b.value) / (a.error + b.error));
  }
};

void compare_forms(std::uint64_t seed, int cases, bool notch) {
  Draw draw(seed);
  Filters filters;
  Known known;
  for (int i = 0; known.cases < cases; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const RadialWeight& weight = filters(at);
    const LocalHomography local = test::random_local(draw, weight.radius());
    const std::optional<RadialPart> part = test::random_part(draw, local, weight.radius(), notch);
    const double goal = draw.log_uniform(1e-9, 1e-3);
    if (!part) continue;
    const Bounded u = along_u(local, weight, *part, goal), v = along_v(local, weight, *part, goal);
    if (std::isinf(u.error + v.error)) continue;
    CAPTURE(i);
    CAPTURE(filters.text(at));
    CAPTURE(u.value);
    CAPTURE(u.error);
    CAPTURE(v.value);
    CAPTURE(v.error);
    CHECK(agree(u, v));
    known.add(u, v, 1e-6);
  }
  MESSAGE(known.good << " of " << known.cases << " known to 1e-6 in both ways; largest difference over bounds "
                     << known.worst);
  CHECK(known.good > known.cases / 8);
}

void compare_jumps(std::uint64_t seed, int wanted) {
  // Of a sum of two weights on the same pieces, with two goals: other sums, other polygons.
  Draw draw(seed);
  const std::vector<double> one{0.7, -0.5, 0.1, 0.05}, two{0.3, 0.2, -0.1, 0.0}, first{0.9, -0.4, 0.05, 0.0},
      second{0.2, 0.1, 0.1, -0.02};
  const auto weight_of = [](const std::vector<double>& inner, const std::vector<double>& outer) {
    return std::vector<PieceWeight>{{0, 0.8, inner, 2, 0}, {0.8, 1.5, outer, 2, 0}};
  };
  const auto sum_of = [](std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
  };
  const std::vector<double> inner = sum_of(one, first), outer = sum_of(two, second);
  const RadialWeight a(weight_of(one, two), {}), b(weight_of(first, second), {}), both(weight_of(inner, outer), {});
  int cases = 0, good = 0;
  for (int i = 0; cases < wanted; ++i) {
    const LocalHomography local = test::random_local(draw, 1.5);
    const std::optional<RadialPart> part = test::random_part(draw, local, 1.5, draw.coin());
    if (!part) continue;
    // Circles at knots are polygons of many sides: finer goals take minutes.
    const Bounded x = along_u(local, a, *part, 1e-5), y = along_u(local, b, *part, 1e-4),
                  z = along_u(local, both, *part, 3e-5), other = along_v(local, both, *part, 1e-5);
    const double bound = x.error + y.error + z.error;
    if (std::isinf(bound) || std::isinf(other.error)) continue;
    ++cases;
    CAPTURE(i);
    // Sums of coefficients are rounded, by 2^-53 of at most 2 each.
    CHECK(std::fabs(x.value + y.value - z.value) <= bound + 1e-14);
    CHECK(agree(z, other));
    good += z.error + other.error < 1e-4;
  }
  CHECK(good > cases / 4);
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("by parts along u and along v is the same under radial weights, behind any depth") {
    compare_forms(111, 25, false);
  }

  TEST_CASE("by parts along u and along v is the same under radial weights, around any notch") {
    compare_forms(112, 25, true);
  }

  TEST_CASE("a finer goal agrees with a coarser one, and knows no less") {
    Draw draw(113);
    Filters filters;
    Known known;
    for (int i = 0; known.cases < 20; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const RadialWeight& weight = filters(at);
      const LocalHomography local = test::random_local(draw, weight.radius());
      const std::optional<RadialPart> part = test::random_part(draw, local, weight.radius(), draw.coin());
      if (!part) continue;
      CAPTURE(i);
      CAPTURE(filters.text(at));
      if (std::isinf(along_u(local, weight, *part, 1e-8).error)) continue;
      Bounded last{0, HUGE_VAL};
      for (const double goal : {1e-1, 1e-3, 1e-5, 1e-8}) {
        CAPTURE(goal);
        const Bounded now = along_u(local, weight, *part, goal);
        if (std::isfinite(last.error)) CHECK(agree(now, last));
        // Where the goal is out of reach, more terms are tried to no avail and sides may lose a little more.
        CHECK(now.error <= 2 * last.error + 1e-12);
        if (goal == 1e-8) known.add(now, last, 1e-4);
        last = now;
      }
    }
    CHECK(known.good > known.cases / 8);
  }

  TEST_CASE("the radial series is linear in weights that jump at a knot, by parts along u and along v") {
    compare_jumps(114, 6);
  }

  TEST_CASE("by parts along u and along v is the same under radial weights, in many random windows") {
    compare_forms(115, 150, false);
    compare_forms(116, 150, true);
  }

  TEST_CASE("the radial series is linear in weights that jump at a knot, in many random windows") {
    compare_jumps(119, 60);
  }
}

TEST_SUITE("slow") {
  TEST_CASE("by parts along u and along v is the same under radial weights, in thousands of random windows") {
    compare_forms(117, 2000, false);
    compare_forms(118, 2000, true);
  }
}

}  // namespace moire
