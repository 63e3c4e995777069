#include "testimages/board_weight.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/rounding.h"
#include "core/sum.h"
#include "testimages/board_squares.h"
#include "testimages/checker_series.h"

namespace moire {
namespace {

// Windows with no more squares than this are left to boundary(): the first for a weight of one piece, where the area of
// a square is quickly found.
constexpr double kFewSquares = 50, kFewSquaresOfMany = 200;
// Rectangles with no more are clipped square by square.
constexpr double kFewInRectangle = 12;
// The most squares of a window that are clipped where the series' remainder stays above what is asked.
constexpr double kMostSquares = 10000;
// More rectangles than this, of tabulated kernels, would take longer than they are worth.
constexpr std::size_t kMostRectangles = 1024;
// Pieces that a side is cut into, of some 20 ns each under a box.
constexpr double kMostPieces = 300000;
// From this many times the aim on, the bound of some rectangles says how much the others are worth.
constexpr double kFailed = 100;
// About what rounding comes to in a rectangle, and in one on the horizon.
constexpr double kRounding = 0x1p-44, kRoundingAtHorizon = 0x1p-42;

using Row = LocalHomography::Row;

double largest_w(const Row& w, const Polygon& polygon) {
  double largest = 0;
  for (const Vec2 p : polygon) largest = std::max(largest, row_at(w, p).value());
  return largest;
}

double area_of(const Polygon& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    area += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return area;
}

Polygon rounded(const SharpPolygon& part) {
  Polygon polygon;
  for (std::size_t i = 0; i < part.size(); ++i) polygon.push_back(part.at(i));
  return polygon;
}

// Squares of the part of a polygon with W >= depth.
double squares_before(const LocalHomography& local, const Polygon& polygon, double depth) {
  Polygon front;
  clip(polygon, {local.w.a, local.w.b, local.w.c.value() - depth}, front);
  return squares_met(local, front);
}

// The smallest W, at least `depth`, with at most so many squares before it.
double depth_with(const LocalHomography& local, const Polygon& polygon, double depth, double deepest, double squares) {
  if (squares_before(local, polygon, depth) <= squares) return depth;
  double low = depth, high = deepest;
  for (int step = 0; step < 24; ++step) {
    const double mid = 0.5 * (low + high);
    (squares_before(local, polygon, mid) <= squares ? high : low) = mid;
  }
  return high;
}

// What is asked of one rectangle: bounds on the integral of the square waves' product.
struct Share {
  double remainder, horizon;
};

// The part of the window between two knots in x and two in y.
class RectangleIntegral {
 public:
  RectangleIntegral(const LocalHomography& local, const Extent& extent, const PieceWeight& x, const PieceWeight& y,
                    const Share& share);

  // Squares that are to be clipped, if at most so many.
  double squares() const { return squares_; }
  // `lost`: what the horizon may cost at least, as more than that is lost elsewhere.
  WeightIntegral operator()(double most_squares, double lost, Boundary& rest);

 private:
  WeightIntegral series(const SharpPolygon& part, Boundary& rest);

  PieceWeight x_, y_;
  Share share_;
  BoardWindow window_;
  double deepest_ = 0, depth_ = 0, squares_ = 0;  // largest W; that below which the series does as asked
  std::optional<CheckerSeries> along_u_, along_v_;
};

RectangleIntegral::RectangleIntegral(const LocalHomography& local, const Extent& extent, const PieceWeight& x,
                                     const PieceWeight& y, const Share& share)
    : x_(x), y_(y), share_(share), window_(local, extent, Rect{{x.low, y.low}, {x.high, y.high}}) {
  squares_ = squares_met(local, window_.board);
  if (squares_ <= kFewInRectangle) return;
  deepest_ = largest_w(local.w, window_.board);
  if (!(deepest_ > 0)) return;
  along_u_.emplace(local.u, local.v, local.w, x_, y_, deepest_);
  along_v_.emplace(local.v, local.u, local.w, x_, y_, deepest_);
  const double area = area_of(window_.board) * (1 + 0x1p-40) + 12 * kUnit;
  depth_ = std::max(along_u_->reach(window_.board, area, share.remainder),
                    along_v_->reach(window_.board, area, share.remainder));
  squares_ = depth_ < deepest_ ? squares_before(local, window_.board, depth_) : 0;
}

WeightIntegral RectangleIntegral::operator()(double most_squares, double lost, Boundary& rest) {
  share_.horizon = std::max(share_.horizon, lost);
  const LocalHomography& local = window_.local;
  if (window_.board.empty()) return {};
  if (!along_u_) {
    append_squares(window_, rest);
    return {};
  }
  if (depth_ >= deepest_) return series(window_.part, rest);

  const double depth = depth_with(local, window_.board, depth_, deepest_, most_squares);
  SharpPolygon front, behind;
  window_.clipper.set_line(BoardWindow::kCut,
                           sharp_line({local.w.a, local.w.b, local.w.c - Dd(depth), local.w.c_error}, local.w, 0, 1));
  window_.clipper.split(window_.part, BoardWindow::kCut, &front, &behind);
  const WeightIntegral known = series(behind, rest);
  window_.part = front;
  window_.board = rounded(front);
  append_squares(window_, rest);
  return known;
}

// The part as half covered to `rest`; the result is what is more or less than that.
WeightIntegral RectangleIntegral::series(const SharpPolygon& part, Boundary& rest) {
  if (part.empty()) return {};
  const Polygon polygon = rounded(part);
  SharpClipper::append(part, 0.5, rest);
  rest.area_error += window_.clipper.area_error() + 2 * kUnit * window_.half_width * perimeter(polygon);
  const double area = area_of(polygon) * (1 + 0x1p-40) + 12 * kUnit * window_.half_width * window_.half_width;
  const SeriesAim aim{share_.remainder, share_.horizon, kMostPieces};
  CheckerSeries *first = &*along_u_, *second = &*along_v_;
  first->lay_out(polygon, area, aim);
  second->lay_out(polygon, area, aim);
  if (second->estimate() < first->estimate()) std::swap(first, second);
  // Known beforehand: the integral of |k k|.
  const double most = area * x_.top * y_.top;
  if (!(first->estimate() < most)) return {0, 0.5 * most};
  Bounded j = first->integrate();
  // A side that runs along a line of the board is a jump to one form of the series and none to the other.
  if (j.error > 16 * (first->estimate() + share_.horizon) && second->estimate() < j.error) {
    const Bounded other = second->integrate();
    if (other.error < j.error) j = other;
  }
  const double fit = x_.error * (y_.top + y_.error) + x_.top * y_.error;
  if (!(j.error + area * fit < most)) return {0, 0.5 * most};
  return {0.5 * j.value, 0.5 * (j.error + area * fit)};
}

// The aim below which bounds only grow, for n pieces, because smaller remainders are had from more squares and more
// pieces of sides, each with its own rounding; in no case above the usual aim.
double finest_of(double n, bool horizon) {
  const WeightAim usual;
  return horizon ? std::min(usual.at_horizon, kRoundingAtHorizon * n * n) : std::min(usual.bound, kRounding * n * n);
}

// The most squares for each of these rectangles with at most kMostSquares for all.
double squares_for_each(const std::vector<RectangleIntegral>& rectangles) {
  std::vector<double> squares;
  for (const RectangleIntegral& r : rectangles) squares.push_back(r.squares());
  std::sort(squares.begin(), squares.end());
  double left = kMostSquares;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const double even = left / static_cast<double>(squares.size() - i);
    if (squares[i] > even) return even;
    left -= squares[i];
  }
  return HUGE_VAL;
}

}  // namespace

std::optional<WeightIntegral> board_weight(const LocalHomography& local, const Extent& extent,
                                           std::span<const PieceWeight> pieces, const WeightAim& aim, Boundary& rest) {
  if (pieces.size() * pieces.size() > kMostRectangles) return std::nullopt;
  const double few = pieces.size() == 1 ? kFewSquares : kFewSquaresOfMany;
  const Rect whole{{pieces.front().low, pieces.front().low}, {pieces.back().high, pieces.back().high}};
  const BoardWindow window(local, extent, whole);
  if (window.board.empty() || squares_met(local, window.board) <= few) return std::nullopt;

  // The value is half of the product's integral, and rounding and squares come on top; the horizon crosses about one
  // row of rectangles.
  const auto n = static_cast<double>(pieces.size());
  bool horizon = false;
  for (const Vec2 p : window.board) horizon |= row_at(local.w, p).hi <= 0x1p-40 * largest_w(local.w, window.board);
  const double goal = std::max(horizon ? aim.at_horizon : aim.bound, finest_of(n, horizon));
  const Share share{0.2 * goal / (n * n), horizon ? 0.25 * goal / n : 0.25 * goal / (n * n)};
  std::vector<RectangleIntegral> rectangles;
  rectangles.reserve(pieces.size() * pieces.size());
  for (const PieceWeight& y : pieces) {
    for (const PieceWeight& x : pieces) rectangles.emplace_back(local, extent, x, y, share);
  }
  const double most_squares = squares_for_each(rectangles);
  Sum sum;
  double bound = 0;
  for (RectangleIntegral& rectangle : rectangles) {
    // Where others have failed by far, this one need not be perfect.
    const double lost = bound > kFailed * goal ? 0.05 * bound / (n * n) : 0;
    const WeightIntegral part = rectangle(most_squares, lost, rest);
    sum.add(part.value);
    bound += part.bound;
  }
  return WeightIntegral{sum.value(), bound * (1 + 0x1p-20) + 2 * kUnit * std::fabs(sum.value())};
}

}  // namespace moire
