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
// And under a weight of one piece, whose squares take a microsecond each.
constexpr double kMostSquaresOfBox = 40000;
// As many take about as long as the series, and are clipped in its place where its bound is above what is asked.
constexpr double kSomeSquares = 1000;
// More rectangles than this, of tabulated kernels, would take longer than they are worth.
constexpr std::size_t kMostRectangles = 1024;
// Pieces that a side is cut into, of some 20 ns each under a box.
constexpr double kMostPieces = 300000;
// Lines between which the sides of a window are integrated where that does not do as asked: half a second and more.
constexpr double kManyLines = 3e6;
// From this many times the aim on, what some rectangles lose says how much the others are worth: each this share of it,
// over their number.
constexpr double kFailed = 100, kShareOfLost = 0.05;
// About what rounding comes to in a rectangle, and in one on the horizon.
constexpr double kRounding = 0x1p-44, kRoundingAtHorizon = 0x1p-42;

double area_of(const Polygon& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    area += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return area;
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
  // Appends the squares that are clipped, at most so many, and all else as half covered. The result is what to expect
  // of the bound on what is more or less than that.
  SeriesOutlook clip(double most_squares, Boundary& rest);
  // What is more or less. `lost`: what the horizon may cost at least, as more than that is lost elsewhere; `quick` as
  // in SeriesAim.
  WeightIntegral operator()(double lost, bool quick);

 private:
  void series(const SharpPolygon& part, Boundary& rest);
  void lay_out(bool quick);

  PieceWeight x_, y_;
  Share share_;
  BoardWindow window_;
  double deepest_ = 0, depth_ = 0, squares_ = 0;  // largest W; that below which the series does as asked
  std::optional<CheckerSeries> along_u_, along_v_;
  // What is left to the series, its area, and the integral of |k k| over it, which is known beforehand.
  Polygon polygon_;
  double area_ = 0, most_ = 0;
};

RectangleIntegral::RectangleIntegral(const LocalHomography& local, const Extent& extent, const PieceWeight& x,
                                     const PieceWeight& y, const Share& share)
    : x_(x), y_(y), share_(share), window_(local, extent, Rect{{x.low, y.low}, {x.high, y.high}}) {
  squares_ = squares_met(local, window_.board);
  if (squares_ <= kFewInRectangle) return;
  deepest_ = largest_w(local, window_.board);
  if (!(deepest_ > 0)) return;
  along_u_.emplace(local.u, local.v, local.w, x_, y_, deepest_);
  along_v_.emplace(local.v, local.u, local.w, x_, y_, deepest_);
  const double area = area_of(window_.board) * (1 + 0x1p-40) + 12 * kUnit;
  depth_ = std::max(along_u_->reach(window_.board, area, share.remainder),
                    along_v_->reach(window_.board, area, share.remainder));
  squares_ = depth_ < deepest_ ? squares_before(local, window_.board, depth_) : 0;
}

SeriesOutlook RectangleIntegral::clip(double most_squares, Boundary& rest) {
  const LocalHomography& local = window_.local;
  if (window_.board.empty()) return {};
  if (!along_u_) {
    append_squares(window_, rest);
    return {};
  }
  if (depth_ >= deepest_) {
    series(window_.part, rest);
  } else {
    const double depth = depth_with(local, window_.board, depth_, deepest_, most_squares);
    SharpPolygon front, behind;
    window_.clipper.set_line(BoardWindow::kCut,
                             sharp_line({local.w.a, local.w.b, local.w.c - Dd(depth), local.w.c_error}, local.w, 0, 1));
    window_.clipper.split(window_.part, BoardWindow::kCut, &front, &behind);
    series(behind, rest);
    window_.part = front;
    window_.board = rounded(front);
    append_squares(window_, rest);
  }
  if (polygon_.empty()) return {};
  lay_out(false);
  const CheckerSeries& better = along_v_->estimate() < along_u_->estimate() ? *along_v_ : *along_u_;
  if (!(better.estimate() < most_)) return {0.5 * most_, 0, 0.5 * most_, 0.5 * most_};
  const auto [doubt, lines, quick, laid_out] = better.outlook();
  const auto bound = [&](double of_j) { return 0.5 * std::min(of_j, most_); };
  return {bound(doubt), lines, bound(quick), bound(laid_out)};
}

// Leaves a part to the series: appends it to `rest` as half covered.
void RectangleIntegral::series(const SharpPolygon& part, Boundary& rest) {
  if (part.empty()) return;
  polygon_ = rounded(part);
  SharpClipper::append(part, 0.5, rest);
  rest.area_error += window_.clipper.area_error() + 2 * kUnit * window_.half_width * perimeter(polygon_);
  area_ = area_of(polygon_) * (1 + 0x1p-40) + 12 * kUnit * window_.half_width * window_.half_width;
  most_ = area_ * x_.top * y_.top;
}

void RectangleIntegral::lay_out(bool quick) {
  const SeriesAim aim{share_.remainder, share_.horizon, kMostPieces, quick};
  along_u_->lay_out(polygon_, area_, aim);
  along_v_->lay_out(polygon_, area_, aim);
}

WeightIntegral RectangleIntegral::operator()(double lost, bool quick) {
  if (polygon_.empty()) return {};
  if (lost > share_.horizon || quick) {
    share_.horizon = std::max(share_.horizon, lost);
    lay_out(quick);
  }
  CheckerSeries *first = &*along_u_, *second = &*along_v_;
  if (second->estimate() < first->estimate()) std::swap(first, second);
  if (!(first->estimate() < most_)) return {0, 0.5 * most_};
  Bounded j = first->integrate();
  // A side that runs along a line of the board is a jump to one form of the series and none to the other.
  const auto expected = [quick](const CheckerSeries& s) { return quick ? s.outlook().quick : s.outlook().doubt; };
  if (j.error > 16 * (first->estimate() + share_.horizon) && second->estimate() < j.error &&
      expected(*second) < 0.5 * j.error) {
    const Bounded other = second->integrate();
    if (other.error < j.error) j = other;
  }
  const double fit = x_.error * (y_.top + y_.error) + x_.top * y_.error;
  if (!(j.error + area_ * fit < most_)) return {0, 0.5 * most_};
  return {0.5 * j.value, 0.5 * (j.error + area_ * fit)};
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
  double left = rectangles.size() == 1 ? kMostSquaresOfBox : kMostSquares;
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
  const std::size_t segments = rest.segments.size();
  const double area_error = rest.area_error;
  const auto n = static_cast<double>(pieces.size());
  bool horizon = false;
  for (const Vec2 p : window.board) horizon |= row_at(local.w, p).hi <= 0x1p-40 * largest_w(local, window.board);
  const double goal = std::max(horizon ? aim.at_horizon : aim.bound, finest_of(n, horizon));
  const Share share{0.2 * goal / (n * n), horizon ? 0.25 * goal / n : 0.25 * goal / (n * n)};
  std::vector<RectangleIntegral> rectangles;
  rectangles.reserve(pieces.size() * pieces.size());
  for (const PieceWeight& y : pieces) {
    for (const PieceWeight& x : pieces) rectangles.emplace_back(local, extent, x, y, share);
  }
  const double most_squares = squares_for_each(rectangles);
  Sum sum;
  SeriesOutlook outlook;
  for (RectangleIntegral& rectangle : rectangles) outlook.add(rectangle.clip(most_squares, rest));
  // Many lines, to no avail: few of them, and long stretches cut into short ones, are known no worse than the lines
  // would be without such cuts.
  const bool quick = outlook.lines > kManyLines && outlook.doubt > goal && outlook.quick <= outlook.laid_out;
  double bound = 0;
  for (RectangleIntegral& rectangle : rectangles) {
    // Where others fail by far, this one need not be perfect.
    const double failed = std::max(bound, quick ? outlook.quick : outlook.doubt);
    const double lost = failed > kFailed * goal ? kShareOfLost * failed / (n * n) : 0;
    const WeightIntegral part = rectangle(lost, quick);
    sum.add(part.value);
    bound += part.bound;
  }
  // Squares that are all but lines: the series does not tell where theirs are, but single squares are clipped sharply.
  const double worth = bound > kFailed * goal                      ? kMostSquares
                       : bound > std::max(goal, WeightAim{}.bound) ? kSomeSquares
                                                                   : 0;
  if (worth > 0 && squares_met(local, window.board) <= worth) {
    rest.segments.resize(segments);
    rest.area_error = area_error;
    return std::nullopt;
  }
  return WeightIntegral{sum.value(), bound * (1 + 0x1p-20) + 2 * kUnit * std::fabs(sum.value())};
}

}  // namespace moire
