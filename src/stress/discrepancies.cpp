// Hard point sets for discrepancies: clusters, lines, coincident points, borders and grids, to 10^6 points, against
// the formulas in 64 and 113 bits and against brute force.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "core/rounding.h"
#include "measure/discrepancy/disk_l2.h"
#include "measure/discrepancy/edge_l2.h"
#include "measure/discrepancy/edge_linf.h"
#include "measure/discrepancy/star_l2.h"
#include "measure/discrepancy/star_linf.h"
#include "stress/chance.h"
#include "stress/discrepancy_formulas.h"
#include "stress/family.h"
#include "stress/half_plane_search.h"
#include "stress/weighted_points.h"

namespace moire::stress {
namespace {

using oracle::Quad;

constexpr std::uint64_t kLargeEvery = 4096;  // among so many the first ones have as many points as time allows
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// What the program says, what is true, and the bounds of both.
struct Judged {
  double computed = 0;
  Quad truth = 0;
  double bound = 0, oracle_error = 0, naive = kNone;
};

// Sums of `places` rows of `places` terms, in 113 bits; each term has at most ten roundings, and all means are below 1.
double quad_error(const WeightedPoints& w) { return (2 * static_cast<double>(w.places()) + 20) * 0x1p-112; }
// In 64 bits, with functions of the library right to 2 ulp in place of roundings.
double extended_error(const WeightedPoints& w) { return (4 * static_cast<double>(w.places()) + 100) * 0x1p-63; }

template <int kDims>
Judged star(const WeightedPoints& w, const PlainPoints& p, Chance&) {
  const double computed = star_l2_squared(p.view(kDims));
  const double n = static_cast<double>(w.points());
  return {computed, star_l2_formula<Quad>(w, kDims), (n + 100) * 0x1p-103 + kUnit * std::fabs(computed), quad_error(w),
          star_l2_formula<double>(w, kDims)};
}
Judged star_most(const WeightedPoints& w, const PlainPoints& p, Chance&) {
  return {star_linf(p.view(2)), star_linf_formula<Quad>(w), 0x1p-51, quad_error(w), star_linf_formula<double>(w)};
}
Judged edge(const WeightedPoints& w, const PlainPoints& p, Chance&) {
  return {edge_l2_squared(p.view(2), LineLaw::isotropic), oracle::widen(edge_l2_formula<long double>(w)), 1e-15,
          extended_error(w), edge_l2_formula<double>(w)};
}
Judged edge_printed(const WeightedPoints& w, const PlainPoints& p, Chance&) {
  return {edge_l2_squared(p.view(2), LineLaw::printed), oracle::widen(edge_printed_formula<long double>(w)), 1e-15,
          extended_error(w), edge_printed_formula<double>(w)};
}
Judged edge_most(const WeightedPoints& w, const PlainPoints& p, Chance&) {
  const double computed = edge_linf(p.view(2));
  return {computed, HalfPlaneSearch(w).worst(), 2 * kUnit * computed, HalfPlaneSearch::kError, kNone};
}
Judged disk(const WeightedPoints& w, const PlainPoints& p, Chance&) {
  return {disk_l2_squared(p.view(2)), oracle::widen(disk_l2_formula<long double>(w)), 1e-15, 9 * extended_error(w),
          disk_l2_formula<double>(w)};
}
// Disks of one radius. The bound and what the oracle errs by shrink with the area, but for differences of coordinates
// across a side of the square, which are rounded to 2^-54: on two axes sqrt 2 of that, times the longest chord.
double rounding_across(const WeightedPoints& w, double radius) {
  const double share = mean_over_pairs<double>(w, [&](std::size_t i, std::size_t j) -> double {
    const double dx = std::fabs(w.x[i] - w.x[j]), dy = std::fabs(w.y[i] - w.y[j]);
    if (radius > 0.25) return 2;  // up to two images across
    if (dx < 0.5 && dy < 0.5) return 0;
    return std::hypot(std::min(dx, 1 - dx), std::min(dy, 1 - dy)) < 2 * radius + 0x1p-50 ? 1 : 0;
  });
  return share * 0x1.7p-54 * 2 * radius;
}
Judged disk_of_radius(const WeightedPoints& w, const PlainPoints& p, Chance& chance) {
  const auto which = chance.below(8);
  const double radius = which < 2 ? 0.5 : which == 2 ? 0.25 : chance.decades(which == 3 ? 1e-100 : 1e-12, 0.5);
  const double square = 4 * radius * radius;
  return {disk_l2_squared(p.view(2), radius), oracle::widen(disk_l2_formula<long double>(w, radius)),
          3e-15 * square + rounding_across(w, radius), 9 * extended_error(w) * square,
          disk_l2_formula<double>(w, radius)};
}

struct MeasureKind {
  std::string_view name;
  Judged (*judge)(const WeightedPoints&, const PlainPoints&, Chance&);
  std::uint64_t places;         // at most: brute force takes their square or cube
  std::uint64_t points, large;  // usual and largest numbers of points, by what the program takes for them
};
constexpr MeasureKind kMeasures[] = {{"star-l2", star<2>, 60, 4000, 1'000'000},
                                     {"star-l2 --dims 3", star<3>, 60, 2000, 100'000},
                                     {"star-linf", star_most, 20, 1000, 10'000},
                                     {"edge-l2", edge, 40, 1500, 16384},
                                     {"edge-l2-printed", edge_printed, 40, 1500, 16384},
                                     {"edge-linf", edge_most, 14, 200, 16384},
                                     {"disk-l2", disk, 30, 600, 4000},
                                     {"disk-l2 --radius", disk_of_radius, 30, 600, 4000}};

struct Case {
  const MeasureKind* measure;
  std::string_view kind;
  std::uint64_t points;
  std::string places;
  Judged judged;
};

Case run_case_of(CaseKey key, bool with_text) {
  Chance chance("discrepancies", key);
  Case c;
  c.measure = &kMeasures[key.index % std::size(kMeasures)];
  const std::size_t kind = key.index / std::size(kMeasures) % kPointKinds.size();
  c.kind = kPointKinds[kind];
  WeightedPoints w = hard_points(chance, kind, c.measure->places);
  const bool large = key.index % kLargeEvery < std::size(kMeasures) * kPointKinds.size();  // each measure, each kind
  if (large || chance.below(4) == 0) multiply(w, large ? c.measure->large : 1 + chance.below(c.measure->points));
  c.points = w.points();
  constexpr std::size_t kShown = 12;
  for (std::size_t i = 0; with_text && i < std::min(kShown, w.places()); ++i) {
    c.places += fmt::format("{}{:.17g},{:.17g},{:.17g} x {}", i == 0 ? "" : "; ", w.x[i], w.y[i], w.t[i], w.count[i]);
  }
  if (w.places() > kShown) c.places += fmt::format("; and {} more", w.places() - kShown);
  c.judged = c.measure->judge(w, spread(w, chance), chance);
  return c;
}

Outcome run(CaseKey key) {
  const Judged j = run_case_of(key, false).judged;
  const auto error_of = [&](double v) { return static_cast<double>(oracle::abs(oracle::widen(v) - j.truth)); };
  Outcome o;
  o.computed = j.computed;
  o.wanted = static_cast<double>(j.truth);
  o.error = error_of(j.computed);
  o.bound = j.bound;
  o.oracle_error = j.oracle_error;
  o.naive_error = error_of(j.naive);
  o.severity = 1 / std::max(std::fabs(o.wanted), 1e-20);
  return o;
}

std::string describe(CaseKey key) {
  const Case c = run_case_of(key, true);
  return fmt::format("{} of {} points, {}; x,y,t of places: {}", c.measure->name, c.points, c.kind, c.places);
}

}  // namespace

extern const Family discrepancies;
constinit const Family discrepancies = {
    .name = "discrepancies",
    .title = "clustered, collinear, coincident points, borders and grids, to 10^6 points",
    .quantity = "T^2 of star, edge and disk discrepancies, D of star and edges",
    .severity = "1 over the value: what cancels",
    .claim = "star_l2.h, star_linf.h, edge_l2.h, edge_linf.h, disk_l2.h",
    .share = 1,
    .run = run,
    .describe = describe};

}  // namespace moire::stress
