#include "testimages/board_radial.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "testimages/board_squares.h"
#include "testimages/half_covered.h"
#include "testimages/radial_series.h"

namespace moire {
namespace {

using Row = LocalHomography::Row;

// Windows of no more squares are clipped square by square. Of others so many are tried, from first to last, until the
// series does as asked on the rest; more, where more is asked than usual.
constexpr double kFewSquares = 300;
constexpr double kSquares[] = {300, 1000, 3000, 10000, 30000};
// The last, unless more is asked than usual, only where the bound would stay above this.
constexpr double kTarget = 1e-6;
// What a bound must have come down to for a series of many lines to be worth its time.
constexpr double kWorth = 0.5;
// More squares are not tried where what they can take away is less than this share of the bound.
constexpr double kLittle = 0.1;
// The largest notch around the centre, as a share of the radius; less than 1/2, where several kernels have a knot.
constexpr double kNotch = 0.45;

// What a notch leaves between its bottom and the horizon, of the way from there to the centre or to the chord.
struct Left {
  bool of_centre;
  double share;
};
constexpr Left kLeft[] = {{true, 0.3}, {true, 0.5}, {true, 0.65}, {false, 0.25}, {false, 0.5}};

// Behind about that depth.
RadialPart plain_part(const BoardWindow& window, double depth) {
  const Row& w = window.local.w;
  const double centre = w.c.value(), clear = RadialPart::clearance(window.half_width) * std::hypot(w.a, w.b);
  if (std::fabs(depth - centre) >= clear) return {depth};
  return {centre > clear ? centre - clear : centre + clear};
}

// With a notch that has about so many squares, if there is one of that kind.
std::optional<RadialPart> notched_part(const BoardWindow& window, double depth, double squares, const Left& left) {
  const Row& w = window.local.w;
  const double radius = window.half_width, least = RadialPart::clearance(radius);
  const double slope = std::hypot(w.a, w.b), centre = w.c.value(), clear = least * slope;
  if (!(slope > 0)) return std::nullopt;
  const double notch_depth = std::max(left.share * (left.of_centre ? centre : depth), centre - kNotch * radius * slope);
  if (!(notch_depth > 0 && std::fabs(centre - notch_depth) >= clear && notch_depth + clear < depth)) {
    return std::nullopt;
  }
  const Vec2 across{-w.b / slope, w.a / slope};
  const auto squares_in = [&](double half) {
    Polygon a, b;
    clip(window.board, {across.x, across.y, half}, a);
    clip(a, {-across.x, -across.y, half}, b);
    clip(b, {w.a, w.b, w.c.value() - notch_depth}, a);
    clip(a, {-w.a, -w.b, depth - w.c.value()}, b);
    return squares_met(window.local, b);
  };
  // Its corners are inside the support.
  const double rise = (depth - centre) / slope;
  double half = std::min(kNotch * radius, 0.9 * std::sqrt(std::max(0.0, (radius - rise) * (radius + rise))));
  while (half >= least && squares_in(half) > squares) half *= 0.8;
  if (half < least) return std::nullopt;
  return RadialPart{depth, half, notch_depth};
}

// A part of the window, and the series on it in its better form.
class Cut {
 public:
  Cut(const LocalHomography& local, const RadialWeight& weight, const RadialPart& part, double goal)
      : part_(part), series_(local.u, local.v, local.w, weight, part) {
    series_.lay_out(goal);
    RadialSeries other(local.v, local.u, local.w, weight, part);
    other.lay_out(goal);
    if (other.estimate() < series_.estimate()) series_ = std::move(other);
  }

  double estimate() const { return series_.estimate(); }
  double remainder() const { return series_.remainder(); }
  const RadialPart& part() const { return part_; }
  Bounded integrate() { return series_.integrate(); }

 private:
  RadialPart part_;
  RadialSeries series_;
};

// Appends the squares of one polygon of the window.
void append_squares_of(BoardWindow& window, const SharpPolygon& polygon, Boundary& rest) {
  if (polygon.empty()) return;
  window.part = polygon;
  window.board = rounded(polygon);
  append_squares(window, rest);
}

// Cuts the window into what is left to the series, and to the squares.
struct Pieces {
  SharpPolygon front, notch;
  std::vector<SharpPolygon> behind;
};
Pieces cut(BoardWindow& window, const RadialPart& part) {
  const Row& w = window.local.w;
  SharpClipper& clipper = window.clipper;
  const auto level = [&](double depth) { return sharp_line({w.a, w.b, w.c - Dd(depth), w.c_error}, w, 0, 1); };
  Pieces out;
  SharpPolygon behind, inner;
  clipper.set_line(BoardWindow::kCut, level(part.depth));
  clipper.split(window.part, BoardWindow::kCut, &out.front, &behind);
  if (part.notch > 0) {
    // The slots of an extent, of which there is none. Sides of the notch lie at half widths from the centre across the
    // slope, whose length is only rounded: so are those of the series.
    SharpPolygon next;
    int slot = SharpClipper::kWindow + 1;
    const double width = part.notch * std::hypot(w.a, w.b);
    for (const double sign : {1.0, -1.0}) {
      clipper.set_line(slot, {Dd(-sign * w.b), Dd(sign * w.a), Dd(width), 0});
      clipper.split(behind, slot, &inner, &next);
      if (!next.empty()) out.behind.push_back(next);
      behind = inner;
      ++slot;
    }
    clipper.set_line(slot, level(part.notch_depth));
    clipper.split(behind, slot, &out.notch, &next);
    behind = next;
  }
  if (!behind.empty()) out.behind.push_back(behind);
  return out;
}

}  // namespace

WeightIntegral board_radial(const LocalHomography& local, const Extent& extent, const RadialWeight& weight,
                            const WeightAim& aim, Boundary& rest) {
  BoardWindow window(local, extent, weight.radius());
  const double all = squares_met(local, window.board);
  const WeightAim usual;
  // No end of squares is what squares_met() calls so within rounding of the horizon.
  const bool horizon = std::isinf(all);
  const double goal = horizon ? aim.at_horizon : aim.bound, least = horizon ? usual.at_horizon : usual.bound;
  const SquaresAim by_squares{
      weight.bounds, goal, goal > least ? 100.0 : kMaxCellsOfMore,
      std::clamp(kMaxCellsOfMore * std::cbrt(usual.at_horizon / goal), 1.0 * kMaxCellsOfMore, 1.0 * kMaxCells)};
  std::optional<Cut> best;
  if (all > kFewSquares && !std::isfinite(extent.u0)) {
    std::vector<double> tries(std::begin(kSquares), std::end(kSquares));
    if (by_squares.most > tries.back()) tries.push_back(by_squares.most);
    for (const double squares : tries) {
      const bool last = squares > kMaxCellsOfMore && goal >= least;
      const double enough = 2 * (last ? std::max(goal, kTarget) : goal);
      if (squares >= all || (best && best->estimate() <= enough)) break;
      const double depth = depth_with(local, window.board, 0, largest_w(local, window.board), squares);
      if (!(depth > 0)) continue;
      const auto attempt = [&](const RadialPart& part) {
        Cut cut(local, weight, part, 2 * goal);
        if (!best || cut.estimate() < best->estimate()) best.emplace(std::move(cut));
      };
      attempt(plain_part(window, depth));
      for (const Left& left : kLeft) {
        const std::optional<RadialPart> part = notched_part(window, depth, squares, left);
        if (part && best->estimate() > 2 * goal) attempt(*part);
      }
      if (best->remainder() < kLittle * best->estimate()) break;
    }
  }
  // All squares, where they are not too many, are better than a series that does not do as asked.
  if (!best || (best->estimate() > 2 * goal && all <= kMaxCells)) {
    append_squares(window, by_squares, rest);
    return {};
  }
  Pieces parts = cut(window, best->part());
  double simple = 0;
  for (const SharpPolygon& p : parts.behind) simple += half_covered(local, p).bound(weight.bounds);
  const Bounded j = best->estimate() <= 2 * kWorth * simple ? best->integrate() : Bounded{0, HUGE_VAL};
  if (!(0.5 * j.error < simple)) {
    BoardWindow again(local, extent, weight.radius());
    append_squares(again, by_squares, rest);
    return {};
  }
  for (const SharpPolygon& p : parts.behind) {
    SharpClipper::append(p, 0.5, rest);
    rest.area_error += 12 * kUnit * window.half_width * window.half_width;
  }
  rest.area_error += window.clipper.area_error();
  append_squares_of(window, parts.front, rest);
  append_squares_of(window, parts.notch, rest);
  return {0.5 * j.value, 0.5 * j.error};
}

}  // namespace moire
