// A checkerboard in perspective: squares of unit side on a plane, (floor u + floor v) even inside. All frequencies at
// once towards the horizon: Heckbert's and everybody's hard case for antialiasing.
//
// A point on a line between squares belongs to the square that floor() says; the sides of a finite board belong to it.
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/expansion.h"
#include "curve/polygon.h"
#include "testimages/homography.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr double kUnit = 0x1p-53;
// Relative accuracy of constants from double-double, sums of three products: 2^-98 with room to spare.
constexpr double kDdUnit = 0x1p-98;
// Windows with more squares than this are not resolved: the rest of the window counts as half covered, and its area is
// in the bound.
constexpr int kMaxCells = 200000;
// Beyond this many squares from the plane's origin floor() has no meaning in doubles; points there count as outside.
constexpr double kMaxSquares = 0x1p50;

constexpr Param kParams[] = {
    numbers("homography", false, "none: a camera", "3 x 3, pixels (x, y, 1) to the plane's (U, V, W)"),
    numbers("extent", false, "the whole plane", "[u0, u1, v0, v1], the board's sides in squares"),
    numbers("camera.focal", false, "none: a homography", "focal length in pixels, above 0"),
    numbers("camera.principal", false, "the image's centre", "[x, y] in pixels"),
    numbers("camera.height", false, "1", "camera above the plane, in squares"),
    numbers("camera.pitch", false, "0", "degrees down from level"),
    numbers("camera.yaw", false, "0", "degrees"),
    numbers("camera.roll", false, "0", "degrees")};

// u0 <= u <= u1, v0 <= v <= v1; infinite without an extent.
struct Extent {
  double u0 = -HUGE_VAL, u1 = HUGE_VAL, v0 = -HUGE_VAL, v1 = HUGE_VAL;
};

using Row = LocalHomography::Row;

// The line through the plane where row r equals k times row w, as sign * (r - k w) >= 0, with the rounding of its value.
struct Line {
  HalfPlane plane;
  double constant_error;  // of c, from cancellation in double-double
  double doubt(double ax, double ay) const {
    return 6 * kUnit * (std::fabs(plane.a) * ax + std::fabs(plane.b) * ay + std::fabs(plane.c)) + constant_error;
  }
};

Line line(const Row& r, const Row& w, double k, double sign) {
  const Dd a = Dd(r.a) - two_prod(k, w.a), b = Dd(r.b) - two_prod(k, w.b), c = r.c - Dd(k) * w.c;
  const double error = kDdUnit * (std::fabs(r.c.hi) + std::fabs(k * w.c.hi));
  return {{sign * a.value(), sign * b.value(), sign * c.value()}, error};
}

class Checkerboard {
 public:
  Checkerboard(const Args& args, Grid grid) {
    const Value* h = args.find("homography");
    const bool camera = args.find("camera.focal") != nullptr;
    for (const Param& p : kParams) {
      if (!p.name.starts_with("camera.") || args.find(p.name) == nullptr) continue;
      if (h != nullptr) throw Error(args.find(p.name)->place, "both a homography and a camera; give one of them");
      if (!camera) throw Error(args.find(p.name)->place, "the camera needs \"focal\", its focal length in pixels");
    }
    if (h != nullptr) {
      if (h->rank != 2 || h->numbers.size() != 9 || h->columns != 3) {
        throw Error(h->place, "\"homography\" must be three rows of three numbers");
      }
      std::copy(h->numbers.begin(), h->numbers.end(), stored_.begin());
    } else if (camera) {
      stored_ = camera_homography(args, grid);
    } else {
      throw Error(args.place(), "scene kind \"checkerboard\" needs a \"homography\" or a [camera] with \"focal\"");
    }
    require_invertible(stored_, h != nullptr ? h->place : args.find("camera.focal")->place);
    // Only ratios and the sign of W count: scaled by a power of two, which is exact, so that nothing overflows.
    double size = 0;
    for (const double x : stored_) size = std::max(size, std::fabs(x));
    int exponent = 0;
    std::frexp(size, &exponent);
    for (std::size_t i = 0; i < 9; ++i) h_[i] = std::ldexp(stored_[i], -exponent);
    if (const Value* e = args.find("extent")) {
      if (e->rank != 1 || e->numbers.size() != 4) throw Error(e->place, "\"extent\" must be [u0, u1, v0, v1]");
      extent_ = {e->numbers[0], e->numbers[1], e->numbers[2], e->numbers[3]};
      if (!(extent_.u0 < extent_.u1) || !(extent_.v0 < extent_.v1)) {
        throw Error(e->place, "\"extent\" is empty; it must be [u0, u1, v0, v1] with u0 < u1 and v0 < v1");
      }
      for (const double x : e->numbers) {
        if (std::fabs(x) > kMaxSquares) throw Error(e->place, "\"extent\" goes beyond 2^50 squares");
      }
    }
  }

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept {
    const std::size_t n = x.size() / run.size();
    for (std::size_t p = 0; p < run.size(); ++p) {
      const LocalHomography local = localize(h_, run[p], 0);
      const double uc = local.u.c.value(), vc = local.v.c.value(), wc = local.w.c.value();
      // Rounding of a row at a point of the pixel: three sums, two products, the rounded constant.
      const auto error = [](const Row& r) { return 6 * kUnit * (std::fabs(r.a) + std::fabs(r.b) + std::fabs(r.c.hi)); };
      const double eu = error(local.u), ev = error(local.v), ew = error(local.w);
      const std::size_t end = (p + 1) * n;
      for (std::size_t i = p * n; i < end; ++i) {
        const double U = local.u.a * x[i] + local.u.b * y[i] + uc;
        const double V = local.v.a * x[i] + local.v.b * y[i] + vc;
        const double W = local.w.a * x[i] + local.w.b * y[i] + wc;
        if (W < -ew) {
          inside[i] = 0;
          continue;
        }
        // Clear of every line by more than rounding: the common case, by floor() alone.
        const double r = 1 / W, u = U * r, v = V * r;
        if (W > 4 * ew && std::fabs(u) < kMaxSquares && std::fabs(v) < kMaxSquares) {
          const double du = quotient_error(u, eu, ew, r), dv = quotient_error(v, ev, ew, r);
          const auto k = floor_integer(u), l = floor_integer(v);
          const double fu = u - static_cast<double>(k), fv = v - static_cast<double>(l);
          if (fu > du && 1 - fu > du && fv > dv && 1 - fv > dv && u > extent_.u0 + du && u < extent_.u1 - du &&
              v > extent_.v0 + dv && v < extent_.v1 - dv) {
            inside[i] = ((k + l) & 1) == 0;
            continue;
          }
        }
        inside[i] = classify_point(run[p], {x[i], y[i]}, U, V, W, eu, ev, ew);
      }
    }
  }

  Cover cover(Pixel origin, Rect r) const noexcept {
    const LocalHomography local = localize(h_, origin, 0);
    const double ax = std::max(std::fabs(r.lo.x), std::fabs(r.hi.x)), ay = std::max(std::fabs(r.lo.y), std::fabs(r.hi.y));
    const Vec2 corners[] = {r.lo, {r.hi.x, r.lo.y}, r.hi, {r.lo.x, r.hi.y}};
    // Signs of a line at the four corners, doubtful ones apart: +1 all beyond it, -1 all before it, 0 neither.
    const auto side = [&](const Line& l) {
      const double doubt = l.doubt(ax, ay);
      int above = 0, below = 0;
      for (const Vec2 c : corners) {
        const double s = l.plane.at(c);
        above += s > doubt;
        below += s < -doubt;
      }
      return above == 4 ? 1 : below == 4 ? -1 : 0;
    };
    const auto row_side = [&](const Row& row) { return side({{row.a, row.b, row.c.value()}, kDdUnit * std::fabs(row.c.hi)}); };
    const int front = row_side(local.w);
    if (front < 0) return Cover::none;
    bool inside_extent = true;
    const auto off_board = [&](const Row& row, double k, double sign) {
      if (!std::isfinite(k)) return false;
      const int s = side(line(row, local.w, k, sign));
      inside_extent &= s > 0;
      return s < 0;
    };
    if (off_board(local.u, extent_.u0, 1) || off_board(local.u, extent_.u1, -1) || off_board(local.v, extent_.v0, 1) ||
        off_board(local.v, extent_.v1, -1)) {
      return Cover::none;
    }
    if (front <= 0) return Cover::partial;
    const Vec2 mid{0.5 * (r.lo.x + r.hi.x), 0.5 * (r.lo.y + r.hi.y)};
    const auto at = [&](const Row& row) { return row.a * mid.x + row.b * mid.y + row.c.value(); };
    const double k = std::floor(at(local.u) / at(local.w)), l = std::floor(at(local.v) / at(local.w));
    if (!(std::fabs(k) < kMaxSquares && std::fabs(l) < kMaxSquares)) return Cover::partial;
    if (side(line(local.u, local.w, k, 1)) <= 0 || side(line(local.u, local.w, k + 1, -1)) <= 0 ||
        side(line(local.v, local.w, l, 1)) <= 0 || side(line(local.v, local.w, l + 1, -1)) <= 0) {
      return Cover::partial;
    }
    if (!even(k, l)) return Cover::none;  // also where the rectangle reaches beyond the board
    return inside_extent ? Cover::all : Cover::partial;
  }

  void boundary(Pixel origin, double half_width, Boundary& out) const;

  // Where W = 0, for a board without end.
  bool meets_horizon(Pixel origin, Rect r) const noexcept {
    if (std::isfinite(extent_.u0)) return false;
    const Row w = localize(h_, origin, 0).w;
    const double low = std::min(w.a * r.lo.x, w.a * r.hi.x) + std::min(w.b * r.lo.y, w.b * r.hi.y) + w.c.value();
    const double high = std::max(w.a * r.lo.x, w.a * r.hi.x) + std::max(w.b * r.lo.y, w.b * r.hi.y) + w.c.value();
    return low <= 0 && high >= 0;
  }

  StoredDoubles stored() const {
    StoredDoubles s{{"homography", {stored_.begin(), stored_.end()}}};
    if (std::isfinite(extent_.u0)) s.emplace_back("extent", std::vector{extent_.u0, extent_.u1, extent_.v0, extent_.v1});
    return s;
  }

 private:
  // Bound on the error of q = U / W, by division or by the reciprocal r of W, where U may be off by eu and W, at least
  // 4 ew, by ew: half as much again for the second order, and the rounding of quotient and reciprocal.
  static double quotient_error(double q, double eu, double ew, double r) {
    return (eu + std::fabs(q) * ew) * (1.5 * r) + 4 * kUnit * std::fabs(q);
  }

  // floor of |x| < 2^50, without the call that baseline x86-64 makes of std::floor.
  static std::int64_t floor_integer(double x) {
    const auto towards_zero = static_cast<std::int64_t>(x);
    return towards_zero - (static_cast<double>(towards_zero) > x);
  }

  static bool even(double k, double l) {
    const double sum = k + l;
    return sum == 2 * std::floor(sum / 2);
  }

  // Exact sign of (row at r) - k W at origin + p; r indexes h_: 0 for U, 3 for V, 6 for W itself with k = 0.
  int exact_sign(std::size_t r, double k, Pixel origin, Vec2 p) const noexcept {
    Expansion sum;
    const Dd ox = dd_from_integer(origin.x), oy = dd_from_integer(origin.y);
    // a b (p + o) in one coordinate, exactly.
    const auto add = [&](double a, double b, double offset, Dd o) {
      const Dd product = two_prod(a, b);
      for (const double term : {offset, o.hi, o.lo}) {
        sum.add_product(product.hi, term);
        sum.add_product(product.lo, term);
      }
    };
    const auto add_row = [&](std::size_t row, double factor) {
      add(h_[row], factor, p.x, ox);
      add(h_[row + 1], factor, p.y, oy);
      sum.add_product(h_[row + 2], factor);
    };
    constexpr double kScale = 0x1p400;  // away from underflow
    add_row(r, kScale);
    if (k != 0) add_row(6, -k * kScale);
    return sum.sign();
  }

  // floor(row r / W) at a point with W > 0, settled exactly when the quotient is within its rounding of an integer.
  // `quotient` is the rounded one and `doubt` bounds its error.
  double exact_floor(std::size_t r, double quotient, double doubt, Pixel origin, Vec2 p) const noexcept {
    const double nearest = std::nearbyint(quotient);
    if (std::fabs(quotient - nearest) > doubt) return std::floor(quotient);
    return exact_sign(r, nearest, origin, p) >= 0 ? nearest : nearest - 1;
  }

  std::uint8_t classify_point(Pixel origin, Vec2 p, double U, double V, double W, double eu, double ev,
                              double ew) const noexcept {
    if (W <= ew && exact_sign(6, 0, origin, p) <= 0) return 0;
    const double u = U / W, v = V / W;
    // Also false for W = 0 and NaN.
    if (!(std::fabs(u) < kMaxSquares && std::fabs(v) < kMaxSquares)) return 0;
    const double du = W > 4 * ew ? quotient_error(u, eu, ew, 1 / W) : HUGE_VAL;
    const double dv = W > 4 * ew ? quotient_error(v, ev, ew, 1 / W) : HUGE_VAL;
    if (!(du < 0.25 && dv < 0.25)) return 0;  // within rounding of the horizon: no square can be named
    const auto beyond = [&](std::size_t r, double k, double q, double doubt) {
      return std::fabs(q - k) > doubt ? (q > k ? 1 : -1) : exact_sign(r, k, origin, p);
    };
    if (std::isfinite(extent_.u0)) {
      if (beyond(0, extent_.u0, u, du) < 0 || beyond(0, extent_.u1, u, du) > 0 || beyond(3, extent_.v0, v, dv) < 0 ||
          beyond(3, extent_.v1, v, dv) > 0) {
        return 0;
      }
    }
    return even(exact_floor(0, u, du, origin, p), exact_floor(3, v, dv, origin, p));
  }

  Matrix3 stored_{}, h_{};
  Extent extent_;
};

// Cuts a polygon by lines of one family and keeps the error of what it cut.
class Cutter {
 public:
  Cutter(double half_width) : half_width_(half_width) {}

  // Cuts `in` by sign (r - k w) >= 0 into `out`.
  void cut(const Polygon& in, const Row& r, const Row& w, double k, double sign, Polygon& out) {
    const Line l = line(r, w, k, sign);
    clip(in, l.plane, out);
    const double doubt = l.doubt(half_width_, half_width_);
    // A line that stays clear of the polygon cuts nothing and errs in nothing.
    bool clear = true;
    for (const Vec2 p : in) clear &= l.plane.at(p) > doubt;
    if (clear || in.empty()) return;
    const double size = std::hypot(l.plane.a, l.plane.b);
    // polygon.h: twice the rounding of the line's value, along its normal, plus 8 u of the window.
    const double distance = size > 0 ? 2 * doubt / size : 4 * half_width_;
    distance_ = std::max(distance_, std::min(distance, 4 * half_width_) + 8 * kUnit * half_width_);
  }
  // Largest distance of a vertex from the lines it should be on, so far.
  double distance() const { return distance_; }

 private:
  double half_width_, distance_ = 0;
};

// The range of row / W over a polygon in front of the horizon; clamped to what `low` and `high` allow.
struct Range {
  double low, high;
};
Range range(const Polygon& polygon, const Row& r, const Row& w, double low, double high) {
  Range out{HUGE_VAL, -HUGE_VAL};
  for (const Vec2 p : polygon) {
    const double W = w.a * p.x + w.b * p.y + w.c.value();
    const double q = W > 0 ? (r.a * p.x + r.b * p.y + r.c.value()) / W : HUGE_VAL;
    // On the horizon (within rounding) the quotient has no bound but the board's.
    if (!(std::fabs(q) < kMaxSquares)) return {low, high};
    out.low = std::min(out.low, q);
    out.high = std::max(out.high, q);
  }
  return {std::max(out.low, low), std::min(out.high, high)};
}

void Checkerboard::boundary(Pixel origin, double half_width, Boundary& out) const {
  const LocalHomography local = localize(h_, origin, 0.5);
  const Row &u = local.u, &v = local.v, &w = local.w;
  Cutter cutter(half_width);
  Polygon board = square(half_width), next;
  const auto keep = [&](const Row& r, double k, double sign) {
    if (!std::isfinite(k)) return;
    cutter.cut(board, r, w, k, sign, next);
    board.swap(next);
  };
  // In front of the camera, W >= 0, written as 0 - (-1) w. A finite board is there by itself: u0 W <= U <= u1 W.
  if (!std::isfinite(extent_.u0)) {
    cutter.cut(board, {0, 0, 0.0}, w, -1, 1, next);
    board.swap(next);
  }
  keep(u, extent_.u0, 1);
  keep(u, extent_.u1, -1);
  keep(v, extent_.v0, 1);
  keep(v, extent_.v1, -1);

  const double window = 2.83 * half_width;  // a line's longest stretch inside the window
  const auto slack = [&] { return 2 * cutter.distance() * window; };
  double error = 0;  // of areas, square pixels
  // What is not resolved counts as half covered.
  const auto unresolved = [&](const Polygon& part) {
    double area = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vec2 a = part[i], b = part[i + 1 < part.size() ? i + 1 : 0];
      out.segments.push_back({a, b, 0.5});
      area += 0.5 * (a.x * b.y - b.x * a.y);
    }
    error += 0.5 * std::fabs(area) * (1 + 0x1p-40) + slack();
  };

  const Range rows = range(board, v, w, extent_.v0, extent_.v1);
  Polygon strip, rest, cell, above;
  if (!board.empty()) {
    const double first = std::floor(rows.low), last = std::floor(rows.high);
    if (!(last - first < kMaxCells)) {
      unresolved(board);
    } else {
      int cells = 0;
      rest = board;
      for (double l = first; l <= last && !rest.empty(); ++l) {
        // Below line l + 1, and what remains above it.
        cutter.cut(rest, v, w, l + 1, -1, strip);
        cutter.cut(rest, v, w, l + 1, 1, above);
        if (!strip.empty()) {
          const Range columns = range(strip, u, w, extent_.u0, extent_.u1);
          const double left = std::floor(columns.low), right = std::floor(columns.high);
          if (!(right - left < kMaxCells - cells)) {
            unresolved(strip);
          } else {
            cells += static_cast<int>(right - left) + 1;
            for (double k = left; k <= right; ++k) {
              if (!even(k, l)) continue;
              cutter.cut(strip, u, w, k, 1, next);
              cutter.cut(next, u, w, k + 1, -1, cell);
              for (std::size_t i = 0; i < cell.size(); ++i) {
                out.segments.push_back({cell[i], cell[i + 1 < cell.size() ? i + 1 : 0]});
              }
              error += 2 * cutter.distance() * (perimeter(cell) + 8 * cutter.distance());
            }
            // Slivers that were lost between squares: at most the neighbourhood of the strip's sides.
            error += 2 * cutter.distance() * perimeter(strip);
          }
        } else {
          error += slack();
        }
        rest.swap(above);
      }
    }
  }
  // And those of the board's own sides.
  out.area_error += error + 5 * slack();
}

}  // namespace

extern constinit const TestImageInfo checkerboard_testimage;
constinit const TestImageInfo checkerboard_testimage =
    describe<Checkerboard>({.name = "checkerboard",
                            .title = "Checkerboard in perspective",
                            .cite = "Heckbert, \"Fundamentals of Texture Mapping and Image Warping\", 1989",
                            .params = kParams});

}  // namespace moire
