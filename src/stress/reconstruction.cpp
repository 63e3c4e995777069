// Hard reconstructions: few samples, kernels with deep negative lobes or narrower than a pixel, weight sums near zero:
// pixels of render() against sums of the same samples in 113 bits, with weights from ball arithmetic.
//
// The limit. Distances are those that the program rounds to doubles: x - d, and for radial filters the root of the sum
// of squares. A weight then errs by what its kernel claims and one rounding; sums of n terms by the additions that a
// term goes through times the sum of |k|. What that does to a quotient, to a control variate and to the choice between
// them is propagated in Interval; the condition number is sum |k| over |sum k|. Importance estimators weigh by signs
// alone; what is hard of them, the inverse of the filter's distribution, is in inverse_case.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/rounding.h"
#include "engine/active_rows.h"
#include "engine/estimator.h"
#include "engine/render.h"
#include "filters/filter.h"
#include "patterns/pattern.h"
#include "stress/ball_kernel.h"
#include "stress/chance.h"
#include "stress/family.h"
#include "stress/inverse_case.h"
#include "stress/scenes.h"
#include "stress/worst.h"

namespace moire::stress {
namespace {

using oracle::Quad;

// One case in so many inverts a distribution; prime to the number of filters, so that all filters have both kinds.
constexpr std::uint64_t kInverseEvery = 7;
constexpr int kJudged = 3;  // pixels of an image that are looked at, all others only rendered

constexpr std::string_view kFilters[] = {"catmull-rom",
                                         "mitchell:b=-8,c=8",
                                         "keys:a=-8",
                                         "keys:a=8",
                                         "lanczos:a=2",
                                         "box:width=0.0625",
                                         "box:width=3",
                                         "sinc:radius=2.5",
                                         "lagrange:order=5",
                                         "tent:radius=0.25",
                                         "gaussian:sigma=0.05",
                                         "windowed-sinc",
                                         "cubic-spline",
                                         "jinc:lobes=2",
                                         "radial-bc:b=0,c=0.7",
                                         "radial-gaussian:radius=0.3",
                                         "magic-kernel-sharp:version=2013",
                                         "disk:radius=1.5"};
constexpr std::string_view kPatterns[] = {
    "random", "jittered", "regular", "n-rooks", "hammersley", "zaremba", "zaremba:instance=shift"};
constexpr Estimator kEstimators[] = {Estimator::ratio, Estimator::ratio, Estimator::control_variate,
                                     Estimator::unnormalised};

// A value and how far the program's may be from it.
struct Interval {
  Quad value = 0;
  double error = 0;
};

double size(Quad a) { return std::fabs(static_cast<double>(a)); }

// The weights of one filter, each distance once.
class Weights {
 public:
  explicit Weights(const Filter& filter) : filter_(filter), truth_(filter) {}

  // The published one, pixels.
  double radius() const { return truth_.radius(); }

  // Of a sample at (x, y) in its cell for the pixel (dx, dy) cells away.
  Interval at(double x, double y, int dx, int dy) {
    const double from_x = x - (dx + 0.5), from_y = y - (dy + 0.5);
    if (filter_.is_radial()) return factor(std::sqrt(from_x * from_x + from_y * from_y));
    const Interval a = factor(from_x), b = factor(from_y);
    const Quad product = a.value * b.value;
    return {product, size(a.value) * b.error + size(b.value) * a.error + a.error * b.error + kUnit * size(product)};
  }
  // The textbook: formula in doubles.
  double naive(double x, double y, int dx, int dy) const {
    const double from_x = x - (dx + 0.5), from_y = y - (dy + 0.5);
    if (filter_.is_radial()) return truth_.naive_k(std::hypot(from_x, from_y));
    return truth_.naive_k(from_x) * truth_.naive_k(from_y);
  }

 private:
  const Interval& factor(double distance) {
    const auto [found, added] = known_.try_emplace(distance);
    if (added) {
      const Enclosed k = truth_.k(distance);
      found->second = {k.value, k.error + claimed(distance)};
    }
    return found->second;
  }
  double claimed(double distance) const {
    if (filter_.is_unit_box()) return 0;
    if (!filter_.is_radial()) return filter_.kernel().bounds(filter_.kernel().piece_of(distance)).k_error_at_x;
    const RadialKernel& kernel = filter_.radial_kernel();
    const int piece = kernel.piece_of(distance);
    return piece < kernel.pieces() ? kernel.bounds(piece).k_error : 0;
  }

  const Filter& filter_;
  BallKernel truth_;
  std::map<double, Interval> known_;
};

struct Sums {
  Interval k, kf;
  double absolute = 0;
  double naive_k = 0, naive_kf = 0;
  double own = 0, own_inside = 0;  // samples inside the pixel's own window
};

struct Scene {
  TestImage image;
  std::string text;
};

Scene hard_scene(Chance& chance, Grid grid) {
  const double x = chance.unit() * grid.width, y = chance.unit() * grid.height;
  const std::string sizes = fmt::format("width = {}; height = {}; ", grid.width, grid.height);
  if (chance.coin()) {
    const double angle = chance.below(3) == 0 ? 45 * static_cast<double>(chance.below(8)) : chance.between(0, 360);
    return {scenes::edge({x, y}, angle, grid),
            sizes + fmt::format("kind = \"edge\"; through = [{:.17g}, {:.17g}]; normal = {:.17g}", x, y, angle)};
  }
  const double radius = chance.decades(0.01, 10);
  return {scenes::disk({x, y}, radius, grid),
          sizes + fmt::format("kind = \"disk\"; center = [{:.17g}, {:.17g}]; radius = {:.17g}", x, y, radius)};
}

bool is_inside(const TestImage& scene, Pixel pixel, double x, double y) {
  std::uint8_t inside = 0;
  scene.contains({&pixel, 1}, {&x, 1}, {&y, 1}, {&inside, 1});
  return inside != 0;
}

Sums sums_of(const TestImage& scene, const Pattern& pattern, Weights& weights, Pixel pixel) {
  Sums s;
  // All cells that touch the window, be their samples' weights nothing: by the published radius, as the program's own
  // apron is what is judged.
  const double r = weights.radius();
  const int reach = static_cast<int>(std::floor(r + 0.5));
  const auto n = static_cast<std::size_t>(pattern.n());
  std::vector<double> x(n), y(n);
  for (int dy = reach; dy >= -reach; --dy) {
    for (int dx = reach; dx >= -reach; --dx) {
      // The cell from which the pixel is (dx, dy) away.
      const Pixel cell{pixel.x - dx, pixel.y - dy};
      pattern.fill({&cell, 1}, {x, y});
      for (std::size_t i = 0; i < n; ++i) {
        const double f = is_inside(scene, cell, x[i], y[i]) ? 1 : 0;
        const Interval w = weights.at(x[i], y[i], dx, dy);
        const double naive = weights.naive(x[i], y[i], dx, dy);
        s.k.value += w.value;
        s.k.error += w.error;
        s.absolute += size(w.value) + w.error;
        s.naive_k += naive;
        if (f != 0) {
          s.kf.value += w.value;
          s.kf.error += w.error;
          s.naive_kf += naive;
        }
        const double own_x = x[i] - 0.5, own_y = y[i] - 0.5;
        if (dx == 0 && dy == 0 && own_x >= -r && own_x < r && own_y >= -r && own_y < r) {
          s.own += 1;
          s.own_inside += f;
        }
      }
    }
  }
  // A term goes through the additions of its cell and those of all cells.
  const double additions = static_cast<double>(n) + (2 * reach + 1) * (2 * reach + 1) + 4;
  const double summed = 1.0001 * additions * kUnit * s.absolute;
  s.k.error += summed;
  s.kf.error += summed;
  return s;
}

// The two ways to a value.
Interval quotient(const Interval& kf, const Interval& k) {
  const Quad value = kf.value / k.value;
  const double least = size(k.value) - k.error;
  if (least <= 0) return {value, HUGE_VAL};
  return {value, (kf.error + size(value) * k.error) / least + 1.01 * kUnit * size(value)};
}
Interval varied(const Sums& s, double mean, double rho) {
  const Quad m = oracle::widen(mean), rest = s.kf.value - m * s.k.value;
  // `mean` is the program's own quotient, rounded; product, difference, quotient and sum are rounded, too.
  const double error = s.kf.error + mean * s.k.error + 1.01 * kUnit * (mean * size(s.k.value) + size(rest));
  const Quad value = m + rest / oracle::widen(rho);
  return {value, error / rho + 1.01 * kUnit * (size(rest) / rho + size(value))};
}

Measured measured(Pixel pixel, int width, double got, const Interval& want, double naive) {
  Measured m;
  m.quantity = "pixel (row-major)";
  m.at = static_cast<double>(pixel.y * width + pixel.x);
  m.computed = got;
  m.wanted = static_cast<double>(want.value);
  m.error = size(oracle::widen(got) - want.value);
  m.bound = want.error;
  m.oracle_error = 0x1p-105 * size(want.value);
  m.naive_error = size(oracle::widen(naive) - want.value);
  return m;
}

using Case = ManyValues;

// One pixel of the image; whether it fell back: -1 where the claims leave that open.
int judge(Estimator estimator, const Sums& s, double rho, double centre, Pixel pixel, int width, double got, Case& c) {
  const double mean = s.own > 0 ? s.own_inside / s.own : centre;
  const double condition = s.absolute / std::max(size(s.k.value), 1e-300);
  c.severity = std::max(c.severity, std::min(condition, 1e40));
  if (estimator == Estimator::unnormalised) {
    const Quad value = s.kf.value / oracle::widen(rho);
    c.worst.see(measured(pixel, width, got, {value, s.kf.error / rho + kUnit * size(value)}, s.naive_kf / rho));
    return 0;
  }
  const Interval variate = varied(s, mean, rho);
  const double naive_variate = mean + (s.naive_kf - mean * s.naive_k) / rho;
  if (estimator == Estimator::control_variate) {
    c.worst.see(measured(pixel, width, got, variate, naive_variate));
    return 0;
  }
  // Which way: by the sum of weights; both are right where its error does not tell.
  const double margin = static_cast<double>(s.k.value - oracle::widen(rho / 4));
  const bool certain = std::fabs(margin) > s.k.error;
  const Measured by_ratio = measured(pixel, width, got, quotient(s.kf, s.k), s.naive_kf / s.naive_k);
  const Measured by_variate = measured(pixel, width, got, variate, naive_variate);
  if (!certain) {
    c.worst.see(by_ratio.error * by_variate.bound <= by_variate.error * by_ratio.bound ? by_ratio : by_variate);
    return -1;
  }
  // Beside ours stands what the quotient alone would give.
  Measured m = margin > 0 ? by_ratio : by_variate;
  m.naive_error = size(oracle::widen(s.naive_kf / s.naive_k) - oracle::widen(m.wanted));
  c.worst.see(m);
  return margin > 0 ? 0 : 1;
}

Case run_case_of(CaseKey key) {
  Chance chance("reconstruction", key);
  if (key.index % kInverseEvery == kInverseEvery - 1) {
    return inverse_case(chance,
                        Filter(parse_spec(kFilters[key.index / kInverseEvery % std::size(kFilters)], "stress")));
  }
  const Filter filter(parse_spec(kFilters[key.index % std::size(kFilters)], "stress"));
  const Estimator estimator = chance.pick(kEstimators);
  const PatternChoice choice(parse_spec(chance.pick(kPatterns), "stress"));
  const int n = choice.info().counts(choice.args(), 1 + static_cast<int>(chance.below(4))).below;
  const Draw draw{chance.bits() % 1000, static_cast<std::uint32_t>(chance.below(1000))};
  const Grid grid{1 + static_cast<int>(chance.below(5)), 1 + static_cast<int>(chance.below(5))};
  const Scene scene = hard_scene(chance, grid);
  const Pattern pattern(choice, n, draw);
  Weights weights(filter);
  const ActiveRows rows = enumerate(scene.image, weights.radius());
  const Rendered rendered = render(scene.image, pattern, filter, estimator, rows);

  Case c;
  c.text = fmt::format("render of {} --pattern {} --spp {} --seed {} --trial {} --filter {} --estimator {}", scene.text,
                       choice.text(), n, draw.seed, draw.trial, filter.text(), name_of(estimator));
  // Pixels that fell back are counted over active ones: all of them, where these are few enough to be looked at.
  const std::size_t count = rendered.value.size();
  const std::size_t first = count > kJudged ? chance.below(count - kJudged + 1) : 0;
  std::size_t index = 0;
  std::int64_t least = 0, most = 0;
  for_each_rendered(rows, rendered, [&](int x, int y, Cover cover, double value) {
    const std::size_t at = index++;
    if (at < first || at >= first + kJudged) return;
    const Pixel pixel{x, y};
    const Sums s = sums_of(scene.image, pattern, weights, pixel);
    const double centre = is_inside(scene.image, pixel, 0.5, 0.5) ? 1 : 0;
    const int fell = judge(estimator, s, n, centre, pixel, grid.width, value, c);
    if (cover == Cover::partial) {
      least += fell > 0 ? 1 : 0;
      most += fell != 0 ? 1 : 0;
    }
  });
  if (count <= kJudged && (rendered.fallbacks < least || rendered.fallbacks > most)) {
    c.worst.fault(fmt::format("{} fallbacks, not {} to {}", rendered.fallbacks, least, most));
  }
  return c;
}

Outcome run(CaseKey key) { return run_case_of(key).outcome(); }

std::string describe(CaseKey key) {
  const Case c = run_case_of(key);
  return fmt::format("{} {} of {}", c.worst.worst().quantity, c.worst.worst().at, c.text);
}

}  // namespace

extern const Family reconstruction;
constinit const Family reconstruction = {
    .name = "reconstruction",
    .title = "1 to 4 samples a pixel, deep negative lobes, vanishing weight sums, windows without samples",
    .quantity = "pixels of ratio, control-variate and unnormalised estimators; inverse distributions of importance",
    .severity = "sum |k| over |sum k|",
    .claim = "kernel errors and roundings, propagated; sum k < rho / 4 decided as documented",
    .share = 0.3,
    .run = run,
    .describe = describe};

}  // namespace moire::stress
