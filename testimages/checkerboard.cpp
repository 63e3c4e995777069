// A checkerboard in perspective: squares of unit side on a plane, (floor u + floor v) even inside. All frequencies at
// once towards the horizon: Heckbert's and everybody's hard case for antialiasing.
//
// A point on a line between squares belongs to the square that floor() says; the sides of a finite board belong to it.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/expansion.h"
#include "core/rounding.h"
#include "testimages/board_box.h"
#include "testimages/board_cover.h"
#include "testimages/board_radial.h"
#include "testimages/board_squares.h"
#include "testimages/board_weight.h"
#include "testimages/homography.h"
#include "testimages/point_signs.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    numbers("homography", false, "none: a camera", "3 x 3, pixels (x, y, 1) to the plane's (U, V, W)"),
    numbers("extent", false, "the whole plane", "[u0, u1, v0, v1], the board's sides in squares"),
    numbers("camera.focal", false, "none: a homography", "focal length in pixels, above 0"),
    numbers("camera.principal", false, "the image's centre", "[x, y] in pixels"),
    numbers("camera.height", false, "1", "camera above the plane, in squares"),
    numbers("camera.pitch", false, "0", "degrees down from level"),
    numbers("camera.yaw", false, "0", "degrees"),
    numbers("camera.roll", false, "0", "degrees")};

using Row = LocalHomography::Row;

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
    const SignLoops& loops = sign_loops().back();
    for (std::size_t p = 0; p < run.size(); ++p) {
      const LocalHomography local = localize(h_, run[p], 0);
      const double uc = local.u.c.value(), vc = local.v.c.value(), wc = local.w.c.value();
      // Rounding of a row at a point of the pixel: three sums, two products, the rounded constant.
      const auto error = [](const Row& r) {
        return 6 * kUnit * (std::fabs(r.a) + std::fabs(r.b) + std::fabs(r.c.hi)) + r.c_error;
      };
      const double eu = error(local.u), ev = error(local.v), ew = error(local.w);
      const BoardSign board{{local.u.a, local.u.b, uc, eu},
                            {local.v.a, local.v.b, vc, ev},
                            {local.w.a, local.w.b, wc, ew},
                            extent_.u0,
                            extent_.u1,
                            extent_.v0,
                            extent_.v1};
      if (!loops.mark_squares(board, x.subspan(p * n, n), y.subspan(p * n, n), &inside[p * n])) continue;
      for (std::size_t i = p * n; i < (p + 1) * n; ++i) {
        if (inside[i] != kDoubtful) continue;
        const auto at = [&](const BoardSign::Row& r) { return r.a * x[i] + r.b * y[i] + r.c; };
        inside[i] = classify_point(run[p], {x[i], y[i]}, at(board.u), at(board.v), at(board.w), eu, ev, ew);
      }
    }
  }

  Cover cover(Pixel origin, Rect r) const noexcept {
    if (const auto quick = quick_cover(h_, extent_, origin, r)) return *quick;
    const LocalHomography local = localize(h_, origin, 0);
    const double ax = std::max(std::fabs(r.lo.x), std::fabs(r.hi.x)),
                 ay = std::max(std::fabs(r.lo.y), std::fabs(r.hi.y));
    const Vec2 corners[] = {r.lo, {r.hi.x, r.lo.y}, r.hi, {r.lo.x, r.hi.y}};
    // Signs of a line at the four corners, doubtful ones apart: +1 all beyond it, -1 all before it, 0 neither.
    const auto side = [&](const BoardLine& l) {
      const double doubt = l.doubt(ax, ay);
      int above = 0, below = 0;
      for (const Vec2 c : corners) {
        const double s = l.plane.at(c);
        above += s > doubt;
        below += s < -doubt;
      }
      return above == 4 ? 1 : below == 4 ? -1 : 0;
    };
    const auto row_side = [&](const Row& row) { return side({{row.a, row.b, row.c.value()}, row.c_error}); };
    const int front = row_side(local.w);
    if (front < 0) return Cover::none;
    bool inside_extent = true;
    const auto off_board = [&](const Row& row, double k, double sign) {
      if (!std::isfinite(k)) return false;
      const int s = side(board_line(row, local.w, k, sign));
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
    if (side(board_line(local.u, local.w, k, 1)) <= 0 || side(board_line(local.u, local.w, k + 1, -1)) <= 0 ||
        side(board_line(local.v, local.w, l, 1)) <= 0 || side(board_line(local.v, local.w, l + 1, -1)) <= 0) {
      return Cover::partial;
    }
    if (!even_square(k, l)) return Cover::none;  // also where the rectangle reaches beyond the board
    return inside_extent ? Cover::all : Cover::partial;
  }

  void boundary(Pixel origin, double half_width, Boundary& out) const;
  std::optional<BoxIntegral> box_integral(Pixel origin, double half_width) const {
    return board_box(h_, extent_, origin, half_width);
  }
  std::optional<WeightIntegral> weight_integral(Pixel origin, std::span<const PieceWeight> pieces, const WeightAim& aim,
                                                Boundary& rest) const {
    return board_weight(localize(h_, origin, 0.5), extent_, pieces, aim, rest);
  }
  WeightIntegral radial_integral(Pixel origin, const RadialWeight& weight, const WeightAim& aim, Boundary& rest) const {
    return board_radial(localize(h_, origin, 0.5), extent_, weight, aim, rest);
  }

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
    if (std::isfinite(extent_.u0))
      s.emplace_back("extent", std::vector{extent_.u0, extent_.u1, extent_.v0, extent_.v1});
    return s;
  }

 private:
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

  // Squares that floor() may be off before a point counts as too near to the horizon to be told.
  static constexpr double kMaxDoubt = 64;

  // floor(row r / W) at a point with W > 0, settled exactly when the quotient is within its rounding of an integer.
  // `quotient` is the rounded one and `doubt`, at most kMaxDoubt, bounds its error.
  double exact_floor(std::size_t r, double quotient, double doubt, Pixel origin, Vec2 p) const noexcept {
    double k = std::nearbyint(quotient);
    if (std::fabs(quotient - k) > doubt && doubt < 0.25) return std::floor(quotient);
    while (exact_sign(r, k, origin, p) < 0) --k;
    while (exact_sign(r, k + 1, origin, p) >= 0) ++k;
    return k;
  }

  std::uint8_t classify_point(Pixel origin, Vec2 p, double U, double V, double W, double eu, double ev,
                              double ew) const noexcept {
    if (W <= ew && exact_sign(6, 0, origin, p) <= 0) return 0;
    const double u = U / W, v = V / W;
    // Also false for W = 0 and NaN.
    if (!(std::fabs(u) < kMaxSquares && std::fabs(v) < kMaxSquares)) return 0;
    const double du = W > 4 * ew ? quotient_error(u, eu, ew, 1 / W) : HUGE_VAL;
    const double dv = W > 4 * ew ? quotient_error(v, ev, ew, 1 / W) : HUGE_VAL;
    if (!(du <= kMaxDoubt && dv <= kMaxDoubt)) return 0;  // within rounding of the horizon: no square can be named
    const auto beyond = [&](std::size_t r, double k, double q, double doubt) {
      return std::fabs(q - k) > doubt ? (q > k ? 1 : -1) : exact_sign(r, k, origin, p);
    };
    if (std::isfinite(extent_.u0)) {
      if (beyond(0, extent_.u0, u, du) < 0 || beyond(0, extent_.u1, u, du) > 0 || beyond(3, extent_.v0, v, dv) < 0 ||
          beyond(3, extent_.v1, v, dv) > 0) {
        return 0;
      }
    }
    return even_square(exact_floor(0, u, du, origin, p), exact_floor(3, v, dv, origin, p));
  }

  Matrix3 stored_{}, h_{};
  Extent extent_;
};

void Checkerboard::boundary(Pixel origin, double half_width, Boundary& out) const {
  BoardWindow window(localize(h_, origin, 0.5), extent_, half_width);
  append_squares(window, out);
}

}  // namespace

extern constinit const TestImageInfo checkerboard_testimage;
constinit const TestImageInfo checkerboard_testimage =
    describe<Checkerboard>({.name = "checkerboard",
                            .title = "Checkerboard in perspective",
                            .cite = "Heckbert, \"Fundamentals of Texture Mapping and Image Warping\", 1989",
                            .params = kParams});

}  // namespace moire
