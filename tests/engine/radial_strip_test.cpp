// The series of radial weights (testimages/radial_series.h) between two depths, against the squares there one by one.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/radial_integral.h"
#include "engine/weight_bounds.h"
#include "filter_list.h"
#include "testimages/board_squares.h"
#include "testimages/radial_jets.h"
#include "testimages/radial_parts.h"

namespace moire {
namespace {

using test::SeenFilter;

// The strip of the window between two depths.
SharpPolygon strip_of(BoardWindow& window, double near, double far) {
  const LocalHomography::Row& w = window.local.w;
  const auto level = [&](double depth) { return sharp_line({w.a, w.b, w.c - Dd(depth), w.c_error}, w, 0, 1); };
  SharpPolygon behind, strip;
  window.clipper.set_line(BoardWindow::kCut, level(near));
  window.clipper.split(window.part, BoardWindow::kCut, nullptr, &behind);
  window.clipper.set_line(SharpClipper::kWindow + 1, level(far));
  window.clipper.split(behind, SharpClipper::kWindow + 1, &strip, nullptr);
  return strip;
}

// The notch of a part.
SharpPolygon notch_of(BoardWindow& window, const RadialPart& part) {
  const LocalHomography::Row& w = window.local.w;
  SharpPolygon strip = strip_of(window, part.depth, part.notch_depth), one, both;
  const double width = part.notch * std::hypot(w.a, w.b);
  window.clipper.set_line(SharpClipper::kWindow + 2, {Dd(-w.b), Dd(w.a), Dd(width), 0});
  window.clipper.split(strip, SharpClipper::kWindow + 2, &one, nullptr);
  window.clipper.set_line(SharpClipper::kWindow + 3, {Dd(w.b), Dd(-w.a), Dd(width), 0});
  window.clipper.split(one, SharpClipper::kWindow + 3, &both, nullptr);
  return both;
}

Bounded integral(const SeenFilter& seen, const Boundary& boundary) {
  const RadialKernel& kernel = seen.filter.radial_kernel();
  RadialIntegral sum(kernel);
  sum.reset();
  for (const Segment& s : boundary.segments) sum.add(s);
  return {sum.value(), sum.bound() + doubt(boundary, weight_bounds(kernel), kernel.k_error())};
}

// J over the strip, square by square: twice the integral over even squares less that over all.
Bounded by_squares(const SeenFilter& seen, BoardWindow& window, const SharpPolygon& strip) {
  Boundary even, all;
  SharpClipper::append(strip, 1, all);
  window.part = strip;
  window.board = rounded(strip);
  append_squares(window, even);
  const Bounded e = integral(seen, even), a = integral(seen, all);
  // The strip's own area is only as good as its cuts and its rounded vertices.
  const double area = window.board_error(), top = weight_bounds(seen.filter.radial_kernel()).top;
  return {2 * e.value - a.value, 2 * e.error + a.error + area * top};
}

struct Tally {
  int cases = 0, good = 0;
  double worst = 0;
};

// The better of the two forms.
Bounded series(const LocalHomography& local, const RadialWeight& weight, const RadialPart& part, double goal) {
  RadialSeries u(local.u, local.v, local.w, weight, part), v(local.v, local.u, local.w, weight, part);
  u.lay_out(goal);
  v.lay_out(goal);
  RadialSeries& better = u.estimate() <= v.estimate() ? u : v;
  return better.estimate() < 0.1 ? better.integrate() : Bounded{0, HUGE_VAL};
}

// A strip, or the notch of a part: what one part has more than another.
void compare(const SeenFilter& seen, const LocalHomography& local, const RadialPart& more, const RadialPart& less,
             double goal, Tally& tally) {
  BoardWindow window(local, {}, seen.weight.radius());
  const SharpPolygon part = less.notch > 0 ? notch_of(window, less) : strip_of(window, more.depth, less.depth);
  if (part.empty() || !(squares_met(local, rounded(part)) < 3000)) return;
  const Bounded whole = series(local, seen.weight, more, goal), rest = series(local, seen.weight, less, goal);
  if (std::isinf(whole.error + rest.error)) return;
  const Bounded between = by_squares(seen, window, part);
  const double bound = whole.error + rest.error + between.error;
  const double miss = std::fabs(whole.value - rest.value - between.value);
  CAPTURE(whole.value);
  CAPTURE(rest.value);
  CAPTURE(between.value);
  CHECK(miss <= bound);
  ++tally.cases;
  tally.good += bound < 1e-6;
  tally.worst = std::max(tally.worst, miss / bound);
}

// Random ones, if they are of use.
void compare_strip(Draw& draw, const SeenFilter& seen, Tally& tally) {
  const double radius = seen.weight.radius();
  const LocalHomography local = test::random_local(draw, radius);
  const std::optional<RadialPart> part = test::random_part(draw, local, radius, false);
  if (!part) return;
  const test::Level w(local);
  const RadialPart behind{part->depth * draw.uniform(0.3, 1)};
  if (std::fabs(behind.depth - w.centre) < RadialPart::clearance(radius) * w.slope) return;
  compare(seen, local, *part, behind, draw.log_uniform(1e-9, 1e-3), tally);
}
void compare_notch(Draw& draw, const SeenFilter& seen, Tally& tally) {
  const LocalHomography local = test::random_local(draw, seen.weight.radius());
  const std::optional<RadialPart> part = test::random_part(draw, local, seen.weight.radius(), true);
  if (!part) return;
  const test::Level w(local);
  if (std::fabs(part->depth - w.centre) < RadialPart::clearance(seen.weight.radius()) * w.slope) return;
  compare(seen, local, {part->depth}, *part, draw.log_uniform(1e-9, 1e-3), tally);
}

template <class Compare>
void compare_many(std::uint64_t seed, int cases, const Compare& compare_one) {
  Draw draw(seed);
  const std::vector<std::string> texts = test::radial_texts();
  std::map<std::string, SeenFilter> filters;
  Tally tally;
  for (std::size_t i = 0; tally.cases < cases; ++i) {
    const std::string& text = texts[i % texts.size()];
    CAPTURE(i);
    CAPTURE(text);
    compare_one(draw, filters.try_emplace(text, text).first->second, tally);
  }
  MESSAGE(tally.good << " of " << tally.cases << " known to 1e-6; largest difference over bounds " << tally.worst);
  CHECK(tally.good > tally.cases / 8);
}

// A board of which the window sees a part of one square, and the horizon nowhere: nothing alternates, so that bounds
// are nearly reached.
LocalHomography within_a_square(Draw& draw, double radius) {
  const double tilt = draw.log_uniform(0.05, 0.9) / radius, turn = draw.uniform(0, 7);
  LocalHomography local{};
  local.w = {tilt * std::cos(turn), tilt * std::sin(turn), Dd(1), 0};
  // u and v at the centre are `at`, and differ from that by less than 0.9 `room` in the window, where W >= 0.1.
  const auto row = [&](double at, double room) {
    const double slope = 0.09 * room / radius, angle = draw.uniform(0, 7);
    return LocalHomography::Row{at * local.w.a + slope * std::cos(angle), at * local.w.b + slope * std::sin(angle),
                                Dd(at), 0};
  };
  const double u = draw.coin() ? draw.uniform(0.01, 0.99) : draw.log_uniform(1e-3, 0.1), v = draw.uniform(0.2, 0.8);
  local.u = row(u, std::min(u, 1 - u));
  local.v = row(v, 0.2);
  return local;
}

// The largest share of their bounds that errors reach there, of as many terms as are asked by the goals.
double compare_within_a_square(std::uint64_t seed, int cases, double goal, const SeenFilter& seen) {
  Draw draw(seed);
  double largest = 0;
  const double radius = seen.weight.radius();
  for (int i = 0; i < cases; ++i) {
    const LocalHomography local = within_a_square(draw, radius);
    const test::Level w(local);
    const RadialPart part{w.centre + draw.uniform(-0.95, 1) * w.slope * radius};
    if (std::fabs(part.depth - w.centre) < RadialPart::clearance(radius) * w.slope) continue;
    BoardWindow window(local, {}, radius);
    const SharpPolygon behind = strip_of(window, part.depth, 0);
    if (behind.empty()) continue;
    const Bounded truth = by_squares(seen, window, behind);
    RadialSeries series(local.u, local.v, local.w, seen.weight, part);
    series.lay_out(goal);
    const Bounded got = series.integrate();
    const double miss = std::fabs(got.value - truth.value), bound = got.error + truth.error;
    CAPTURE(i);
    CHECK(miss <= bound);
    if (std::isfinite(bound)) largest = std::max(largest, miss / bound);
  }
  return largest;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the radial series behind two depths differs by the squares between them") {
    compare_many(121, 25, compare_strip);
  }

  TEST_CASE("the radial series with and without a notch differs by the squares in it") {
    compare_many(124, 25, compare_notch);
  }

  TEST_CASE("what lies between the disk filter's rim and a polygon inside it is in the bound") {
    // With coarse goals, so that it is most of it. Without it one error is 1.7 times its bound.
    for (const double goal : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4}) {
      CAPTURE(goal);
      compare_within_a_square(130, 100, goal, SeenFilter("disk"));
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE(
      "the radial series behind two depths differs by the squares between them, or in a notch, in many random "
      "windows") {
    compare_many(122, 200, compare_strip);
    compare_many(125, 200, compare_notch);
  }

  TEST_CASE("in a part of one square the radial series is within its bounds, which are nearly reached") {
    double largest = 0;
    for (const std::string& text : test::radial_texts()) {
      CAPTURE(text);
      const double share = compare_within_a_square(123, 60, 1e-6, SeenFilter(text));
      largest = std::max(largest, share);
    }
    MESSAGE("largest error over its bound " << largest);
    CHECK(largest > 0.5);
  }
}

}  // namespace moire
