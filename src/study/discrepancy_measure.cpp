// The catalogue of discrepancies.
#include "study/discrepancy_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/names.h"
#include "core/parallel.h"
#include "measure/discrepancy/disk_l2.h"
#include "measure/discrepancy/edge_l2.h"
#include "measure/discrepancy/edge_linf.h"
#include "measure/discrepancy/expected.h"
#include "measure/discrepancy/monte_carlo.h"
#include "measure/discrepancy/star_l2.h"
#include "measure/discrepancy/star_linf.h"
#include "study/discrepancy_mean.h"

namespace moire {
namespace {

constexpr Param kMethod = choice("method", "closed-form", "closed-form|monte-carlo",
                                 "the mean over all tests by its closed form, or over random ones");
constexpr Param kTests = integer("tests", 10000, 1, 1e9, "random tests per set, for method=monte-carlo");
constexpr Param kCounted = choice("counted", "all", "all|without-first",
                                  "without-first leaves out the set's first point but divides by N, which is what "
                                  "Mitchell's table 4 seems to hold; for method=monte-carlo");
constexpr Param kSquareParams[] = {kMethod, kTests, kCounted};
constexpr Param kDiskParams[] = {number("radius", 0, 0, 0.5, "of all disks; 0: uniformly distributed from 0 to 1/2"),
                                 kMethod, kTests, kCounted};

// What the last two numbers allow: 2^24 where time is N log N, 2^21 in three
// dimensions, 2^18 for all pairs, less where pairs are dear.
constexpr DiscrepancyInfo kDiscrepancies[] = {
    {"star-l2", "T over boxes [0, x) x [0, y), in three dimensions x [0, t)", "Warnock 1972; Heinrich 1996", "star_l2",
     true, true, std::int64_t{1} << 24, std::int64_t{1} << 21, kSquareParams},
    {"star-linf",
     "D over boxes [0, x) x [0, y): the star discrepancy",
     "Niederreiter 1978",
     "star_linf",
     false,
     false,
     std::int64_t{1} << 18,
     0,
     {}},
    {"edge-l2", "T over half-planes, their lines isotropic: all positions and directions alike",
     "Mitchell 1992, with the invariant measure of lines", "edge_l2", true, false, std::int64_t{1} << 18, 0,
     kSquareParams},
    {"edge-l2-printed", "T over half-planes, their lines as the paper's generator draws them", "Mitchell 1992",
     "edge_l2_printed", true, false, std::int64_t{1} << 18, 0, kSquareParams},
    {"edge-linf",
     "D over half-planes",
     "Dobkin, Eppstein and Mitchell 1996",
     "edge_linf",
     false,
     false,
     std::int64_t{1} << 15,
     0,
     {}},
    {"disk-l2", "T over disks on the unit torus, centres uniform", "Mitchell 1992", "disk_l2", true, false,
     std::int64_t{1} << 18, 0, kDiskParams},
};

std::vector<std::string_view> names() {
  std::vector<std::string_view> names;
  for (const DiscrepancyInfo& info : kDiscrepancies) names.push_back(info.name);
  return names;
}

const DiscrepancyInfo& find_discrepancy(std::string_view name, const std::string& place) {
  for (const DiscrepancyInfo& info : kDiscrepancies) {
    if (info.name == name) return info;
  }
  throw Error(place, unknown_name("discrepancy", name, names()));
}

// The parameters given, and those defaults that the discrepancy knows and that are not given.
Given with_defaults(const DiscrepancyInfo& info, Given given, const Given& defaults) {
  for (const auto& [key, value] : defaults) {
    const auto is_key = [&key = key](const auto& known) { return known.first == key; };
    if (std::any_of(given.begin(), given.end(), is_key)) continue;
    if (std::any_of(info.params.begin(), info.params.end(), [&key = key](const Param& p) { return p.name == key; })) {
      given.emplace_back(key, value);
    }
  }
  return given;
}

LineLaw line_law(std::string_view name) { return name == "edge-l2" ? LineLaw::isotropic : LineLaw::printed; }

}  // namespace

std::span<const DiscrepancyInfo> discrepancies() { return kDiscrepancies; }

bool is_discrepancy(std::string_view name) {
  return std::any_of(std::begin(kDiscrepancies), std::end(kDiscrepancies),
                     [&](const DiscrepancyInfo& info) { return info.name == name; });
}

std::string discrepancy_column(const DiscrepancyInfo& info, bool with_time) {
  return std::string(info.column) + (with_time ? "_3d" : "");
}

DiscrepancyChoice::DiscrepancyChoice(const Spec& spec, const Given& defaults)
    : info_(&find_discrepancy(spec.name, spec.place)),
      args_(fmt::format("discrepancy \"{}\"", info_->name), info_->params, with_defaults(*info_, spec.given, defaults),
            spec.place),
      text_(spec.text) {
  if (is_without_first() && !is_monte_carlo()) {
    throw Error(spec.place, fmt::format("\"{}\" counts without the first point, which has no closed form here; give "
                                        "method=monte-carlo, too",
                                        text_));
  }
  constexpr double kLeastRadius = 1e-100;  // squares of smaller ones come near the smallest number
  if (!is_plain() && *radius() < kLeastRadius) {
    throw Error(spec.place, fmt::format("radius {} is too small; give 0 (uniformly distributed) or {} to 0.5",
                                        shortest(*radius()), shortest(kLeastRadius)));
  }
}

bool DiscrepancyChoice::is_monte_carlo() const { return info_->is_square && args_.text("method") == "monte-carlo"; }

std::string_view DiscrepancyChoice::method() const { return info_->is_square ? args_.text("method") : "exact"; }

bool DiscrepancyChoice::is_without_first() const {
  return info_->is_square && args_.text("counted") == "without-first";
}

std::int64_t DiscrepancyChoice::tests() const { return args_.integer("tests"); }

bool DiscrepancyChoice::is_plain() const { return info_->name != "disk-l2" || !radius(); }

std::optional<double> DiscrepancyChoice::radius() const {
  const double r = args_.number("radius");
  return r > 0 ? std::optional<double>(r) : std::nullopt;
}

void DiscrepancyChoice::require(std::int64_t n, int dims) const {
  if (dims == 3 && !info_->has_3d) {
    throw Error(args_.place(),
                fmt::format("\"{}\" is of points in 2 dimensions; star-l2 is the one in 3", info_->name));
  }
  const std::int64_t most = dims == 3 ? info_->most_points_3d : info_->most_points;
  if (n > most && !is_monte_carlo()) {
    throw Error(args_.place(), fmt::format("\"{}\" of {} points would take too long; at most {}{}", info_->name, n,
                                           most, info_->is_square ? ", or method=monte-carlo" : ""));
  }
  // A random test looks at every point.
  constexpr double kMostLooks = 0x1p42;
  if (is_monte_carlo() && static_cast<double>(n) * static_cast<double>(tests()) > kMostLooks) {
    throw Error(args_.place(), fmt::format("\"{}\": {} tests of {} points would take too long; at most {} tests", text_,
                                           tests(), n, static_cast<std::int64_t>(kMostLooks / static_cast<double>(n))));
  }
}

std::optional<LineLaw> DiscrepancyChoice::test_lines() const {
  const bool edge = info_->name == "edge-l2" || info_->name == "edge-l2-printed";
  return edge && is_monte_carlo() ? std::optional(line_law(info_->name)) : std::nullopt;
}

Discrepancy DiscrepancyChoice::operator()(PointView points, const Key& key, std::span<const MeasuredLine> lines) const {
  const std::string_view name = info_->name;
  if (!info_->has_3d) points.t = {};
  if (name == "star-linf") return {star_linf(points)};
  if (name == "edge-linf") return {edge_linf(points)};
  if (is_monte_carlo()) {
    const Counted counted = is_without_first() ? Counted::without_first : Counted::all;
    const MonteCarlo mean = name == "star-l2"   ? star_l2_monte_carlo(points, tests(), key, counted)
                            : name == "disk-l2" ? disk_l2_monte_carlo(points, radius(), tests(), key, counted)
                            : !lines.empty()    ? edge_l2_monte_carlo(points, lines, counted)
                                                : edge_l2_monte_carlo(points, line_law(name), tests(), key, counted);
    const double value = std::sqrt(mean.mean_square);
    return {value, value > 0 ? mean.standard_error / (2 * value) : 0};
  }
  const double square = name == "star-l2"   ? star_l2_squared(points)
                        : name != "disk-l2" ? edge_l2_squared(points, line_law(name))
                        : radius()          ? disk_l2_squared(points, *radius())
                                            : disk_l2_squared(points);
  return {std::sqrt(std::max(0.0, square))};  // its rounding error may be below 0
}

std::optional<double> DiscrepancyChoice::expected_square(const PatternChoice& pattern, std::int64_t n, int dims) const {
  if (!info_->is_square || is_without_first()) return std::nullopt;
  const std::string_view of = pattern.info().name, name = info_->name;
  const bool edge = name == "edge-l2" || name == "edge-l2-printed";
  if (of == "random") {
    if (name == "star-l2") return expected_star_l2_squared_random(n, dims);
    if (edge) return expected_edge_l2_squared_random(n, line_law(name));
    return expected_disk_l2_squared_random(n, radius());
  }
  // jittered-random-time is jittered where time is not looked at.
  if ((of == "jittered" && dims == 2) || of == "jittered-random-time") {
    const auto side = std::llround(std::sqrt(static_cast<double>(n)));
    if (pattern.args().number("amount") != 1 || side * side != n) return std::nullopt;
    if (name == "star-l2") return expected_star_l2_squared_jittered(n, dims);
    if (edge) return expected_edge_l2_squared_jittered(n, line_law(name));
  }
  if (of == "n-rooks" && dims == 2) {
    if (name == "star-l2") return expected_star_l2_squared_n_rooks(n);
    if (edge) return expected_edge_l2_squared_n_rooks(n, line_law(name));
  }
  return std::nullopt;
}

std::vector<SetsDiscrepancy> discrepancies_of(const PatternChoice& pattern, int n, bool with_time, std::uint64_t seed,
                                              std::span<const DiscrepancyChoice> choices) {
  std::vector<SetsDiscrepancy> all(choices.size());
  std::vector<std::size_t> measured;  // those that theory does not know
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const int dims = with_time && choices[i].info().has_3d ? 3 : 2;
    if (const auto expected = choices[i].expected_square(pattern, n, dims)) {
      all[i].rms = std::sqrt(*expected);
    } else {
      measured.push_back(i);
    }
  }
  if (measured.empty()) return all;
  constexpr std::size_t kSets = 100;
  const std::size_t sets = pattern.varies(with_time) ? kSets : 1;
  std::vector<std::vector<double>> values(measured.size(), std::vector<double>(sets));
  parallel_for(sets, [&](std::size_t trial) {
    const auto count = static_cast<std::size_t>(n);
    std::vector<double> x(count), y(count), t(with_time ? count : 0);
    const Draw draw{seed, static_cast<std::uint32_t>(trial)};
    Pattern(pattern, n, draw).fill_set({x, y, t});
    const Key key = pixel_key(draw_hash(draw.seed, draw.trial), {});
    for (std::size_t m = 0; m < measured.size(); ++m) values[m][trial] = choices[measured[m]]({x, y, t}, key).value;
  });
  for (std::size_t m = 0; m < measured.size(); ++m) {
    const DiscrepancyMean mean = mean_over_sets(values[m]);
    all[measured[m]] = {mean.rms, sets > 1 && mean.rms > 0 ? mean.square_error / (2 * mean.rms) : 0};
  }
  return all;
}

}  // namespace moire
