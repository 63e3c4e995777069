// Checkerboards that hurt: their horizon on, between and across pixel rows, vanishing points inside pixels, rolled and
// grazing views, focal lengths from far too short to far too long, nearly singular homographies.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "oracle/one_point.h"
#include "stress/exact_case.h"
#include "stress/naive.h"
#include "stress/views.h"

namespace moire::stress {
namespace {

using scenes::Camera;
using scenes::Seen;
using scenes::View;

enum Kind : std::uint64_t {
  few_squares,      // any camera, below the horizon, the whole plane where that is few squares
  one_point,        // the whole plane, to its horizon: sums over periods are the oracle
  across_horizon,   // finite, rolled, the horizon through the window
  vanishing_point,  // of the columns, inside the pixel, finite
  grazing,          // pitch 1e-9 and less
  any_focal,        // focal length 1e-3 .. 1e9 pixels
  nearly_singular,  // u almost a function of v
  on_knots,         // lines on knot lines or tilted from them by 1e-14 .. 1e-3
  far_away,         // image offsets up to 2^40 pixels
  kKinds
};

// What the oracle clips one by one: squares of a closed form, of sections, of rings.
double most_squares(const CheckedFilter& f) { return f.is_box ? 150 : f.filter.is_radial() ? 6 : 16; }

// How a row's size and the determinant compare in the window: the oracle's corners are right to about this times
// 2^-112, in pixels, whatever the scale of the rows (two products and a sum for each entry of the adjugate, then the
// quotient).
double condition(const std::vector<double>& h, Pixel pixel, double reach) {
  using oracle::Quad;
  Quad m[3][3];
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) m[row][column] = oracle::widen(h[3 * row + column]);
    m[row][2] +=
        m[row][0] * (static_cast<Quad>(pixel.x) + Quad(1) / 2) + m[row][1] * (static_cast<Quad>(pixel.y) + Quad(1) / 2);
  }
  const Quad det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                   m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  Quad product = 1;
  for (const auto& row : m)
    product *= (oracle::abs(row[0]) + oracle::abs(row[1])) * oracle::widen(reach) + oracle::abs(row[2]);
  return static_cast<double>(product / oracle::abs(det));
}

ExactCase finished(TestImage image, Pixel pixel, FilterPtr filter) {
  const oracle::Board board = oracle::board_of(image);
  ExactCase c{std::move(image), pixel, std::move(filter)};
  const double reach = c.filter->filter.radius();
  c.severity = condition({board.homography.begin(), board.homography.end()}, pixel, reach);
  // Corners of that many squares, four each, whose sides are no longer than the window's.
  c.oracle_doubt = most_squares(*c.filter) * 4 * 0x1p-112 * c.severity / reach;
  if (c.filter->is_box) c.naive = naive_coverage(board, pixel, 2 * reach);
  return c;
}

// A finite board around the place, whole and broken rims.
ExactCase around(Chance& chance, const View& view, FilterPtr filter) {
  const Seen at = scenes::look(view.homography, view.at);
  const double side = std::sqrt(most_squares(*filter));
  const auto rims = [&](double place) {
    // Beyond 2^50 squares the program takes no board, and next to the horizon doubles do not know the place.
    const double middle = std::isfinite(place) ? std::clamp(place, -0x1p49, 0x1p49) : 0;
    const double low = std::floor(middle - side * chance.between(0.1, 0.5));
    const double high = middle + side * chance.between(0.2, 0.4);
    return Vec2{low, std::max(chance.coin() ? std::ceil(high) : high, low + 1)};
  };
  const Vec2 u = rims(at.u), v = rims(at.v);
  return finished(scenes::board(view.homography, {u.x, u.y, v.x, v.y}), view.pixel(), std::move(filter));
}

Camera any_camera(Chance& chance) {
  return {.focal = chance.decades(50, 2000),
          .principal = {chance.between(0, 512), chance.between(0, 512)},
          .height = chance.decades(0.2, 20),
          .pitch = chance.between(-10, 70),
          .yaw = chance.between(-180, 180),
          .roll = chance.coin() ? 0 : chance.between(-180, 180)};
}

// Mirrored, now and then: an exact change of the scene.
View mirrored(Chance& chance, View view) {
  if (chance.coin()) return view;
  for (std::size_t row = 0; row < 9; row += 3) view.homography[row] = -view.homography[row];
  view.at.x = -view.at.x;
  return view;
}

// The whole plane where its squares in the window are few.
ExactCase few_squares_case(Chance& chance, FilterPtr filter) {
  const View view =
      mirrored(chance, scenes::view_of(any_camera(chance), chance.decades(1, 300), chance.between(-1, 1)));
  const double reach = filter->filter.radius();
  const TestImage plane = scenes::plane(view.homography);
  const oracle::Board board = oracle::board_of(plane);
  const oracle::Quad half = oracle::widen(reach);
  const oracle::Polygon seen = oracle::clip_front(board, view.pixel(), half, 0);
  const bool off_horizon = oracle::area(seen) >= 4 * half * half * (1 - oracle::widen(1e-20L));
  if (off_horizon && oracle::squares_in(board, view.pixel(), seen) < oracle::widen(most_squares(*filter)))
    return finished(plane, view.pixel(), std::move(filter));
  return around(chance, view, std::move(filter));
}

// Rows (a b c), (0 e d), (0 w z) in numbers of few bits, so that the places where the rows of the window end are whole
// squares per unit of 1/W, as the oracle wants; then mirrored and turned, which is exact.
ExactCase one_point_case(Chance& chance) {
  // Filters whose knots are a power of two apart, and polynomials of low degree, as the oracle wants them. Those of
  // many knots take it some ten milliseconds.
  struct Choice {
    const char* filter;
    double apart;
  };
  constexpr Choice kBoxes[] = {
      {"box", 1},         {"box", 1},        {"box", 1}, {"box:width=0.25", 0.25}, {"box:width=0.5", 0.5},
      {"box:width=2", 2}, {"box:width=4", 4}};
  constexpr Choice kOthers[] = {
      {"tent", 1}, {"bspline:order=2", 1}, {"bspline", 1}, {"mitchell", 1}, {"catmull-rom", 1}};
  const bool is_box = chance.below(8) != 0;
  const Choice choice = is_box ? chance.pick(kBoxes) : chance.pick(kOthers);
  const FilterPtr filter = checked_filter(choice.filter);
  Pixel pixel{static_cast<std::int64_t>(chance.below(256)) - 128, static_cast<std::int64_t>(chance.below(256)) - 128};
  const double top = static_cast<double>(pixel.y);
  // The horizon: on a row's side, 2^-30 beside it, through the middle, anywhere in the row, some rows above.
  const double sub = std::round(chance.unit() * 0x1p30) * 0x1p-30;
  const double above = is_box ? std::round(chance.decades(1, 40)) : 0.75;
  const double rows[] = {0, 1, 0x1p-30, -0x1p-30, 1 - 0x1p-30, 0.5, sub, sub, -sub, -above};
  const double horizon = top + chance.pick(rows);
  const double w = std::ldexp(1, static_cast<int>(chance.below(is_box ? 9 : 5)) - 4), z = -w * horizon;
  const auto whole = [&](std::uint64_t most) { return static_cast<double>(chance.below(most)) + 1; };
  const double a = whole(is_box ? 8 : 2) / choice.apart;
  const double left = static_cast<double>(pixel.x) + 0.5 - filter->filter.radius();
  // Where the window's left side is, in squares per 1/W: around 0 the columns' vanishing point is in the window.
  const double begin = is_box ? whole(40) - 20 : whole(12) - 8, forward = chance.sign() * whole(is_box ? 60 : 12);
  const auto eighths = [&] { return (static_cast<double>(chance.below(33)) - 16) / 8; };
  const double phase_u = eighths(), phase_v = eighths();
  const std::vector<double> h{
      a, phase_u * w, begin - a * left + phase_u * z, 0, phase_v * w, forward + phase_v * z, 0, w, z};
  const oracle::Board canonical{{h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8]},
                                {-HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL}};
  const Pixel canonical_pixel = pixel;

  std::vector<double> turned = h;
  if (chance.coin())
    for (std::size_t i = 0; i < 3; ++i) std::swap(turned[i], turned[3 + i]);  // u and v
  if (chance.coin()) {
    for (std::size_t row = 0; row < 9; row += 3) std::swap(turned[row], turned[row + 1]);
    std::swap(pixel.x, pixel.y);
  }
  for (const std::size_t column : {std::size_t{0}, std::size_t{1}}) {
    if (chance.coin()) continue;
    for (std::size_t row = 0; row < 9; row += 3) turned[row + column] = 0 - turned[row + column];
    std::int64_t& number = column == 0 ? pixel.x : pixel.y;
    number = -1 - number;
  }
  ExactCase c = finished(scenes::plane(turned), pixel, filter);
  c.oracle_doubt = 0;  // no corners are sought
  c.truth = [canonical, canonical_pixel, filter] {
    return oracle::one_point(*filter->kernel, canonical, canonical_pixel);
  };
  return c;
}

// A few columns on both sides of the camera, some rows of them far ahead, and the pixel where they meet.
ExactCase vanishing_case(Chance& chance, FilterPtr filter) {
  Camera camera = any_camera(chance);
  camera.pitch = chance.between(-10, 30);
  camera.yaw = chance.between(-40, 40);
  View view{scenes::homography_of(camera), {}};
  // The image of the columns' direction: what U and W do not see, U = W = 0 there.
  const std::vector<double>& h = view.homography;
  const double x = h[1] * h[8] - h[2] * h[7], y = h[2] * h[6] - h[0] * h[8], scale = h[0] * h[7] - h[1] * h[6];
  view.at = {x / scale, y / scale};
  const double side = std::floor(std::sqrt(most_squares(*filter))), begin = chance.decades(1, 1e6);
  const double ahead = h[3] * view.at.x + h[4] * view.at.y + h[5] > 0 ? begin : -begin - side;
  const double half = std::ceil(side / 2);
  const double high = std::floor(ahead) + side - (chance.coin() ? 0 : 0.37);
  return finished(scenes::board(h, {-half, half, std::floor(ahead), high}), view.pixel(), std::move(filter));
}

ExactCase on_knots_case(Chance& chance, FilterPtr filter) {
  const std::vector<double> knots = filter->knots();
  const Pixel pixel{static_cast<std::int64_t>(chance.below(64)), static_cast<std::int64_t>(chance.below(64))};
  const double x = static_cast<double>(pixel.x) + 0.5 + chance.pick(knots);
  const double y = static_cast<double>(pixel.y) + 0.5 + chance.pick(knots);
  constexpr double kScales[] = {0.25, 0.5, 1, 1.0 / 3};
  const double a = chance.sign() * chance.pick(kScales), b = chance.sign() * chance.pick(kScales);
  const double tilt = chance.coin() ? 0 : chance.sign() * chance.decades(1e-14, 1e-3);
  const double depth = chance.coin() ? 0 : chance.decades(1e-14, 1e-3);
  const std::vector<double> h{a, tilt, -a * x, -tilt, b, -b * y, depth, -depth, 1 - depth * (x - y)};
  const double most = std::floor(std::sqrt(most_squares(*filter)) / 2);
  return finished(scenes::board(h, {-most, most, -most, most - 0.5}), pixel, std::move(filter));
}

ExactCase make_case(CaseKey key) {
  Chance chance("boards", key);
  const std::uint64_t kind = key.index % kKinds;
  if (kind == one_point) return one_point_case(chance);
  const FilterPtr filter = pick_filter(chance);
  if (kind == few_squares) return few_squares_case(chance, filter);
  if (kind == vanishing_point) return vanishing_case(chance, filter);
  if (kind == on_knots) return on_knots_case(chance, filter);
  Camera camera = any_camera(chance);
  // On the horizon's row of pixels, on its sides, or a little in front.
  double rows = chance.coin() ? chance.between(-0.7, 1) : chance.decades(1e-9, 60);
  double along = chance.between(-1, 1);
  if (kind == grazing) {
    camera.pitch = chance.sign() * chance.decades(1e-15, 1e-8);
    camera.principal = {256, 256};
    camera.roll = chance.coin() ? 0 : chance.sign() * chance.decades(1e-12, 1e-3);
    constexpr double kRows[] = {1e-9, 0.25, 0.5, 1, 3};
    rows = chance.pick(kRows);
  }
  if (kind == any_focal) {
    camera.focal = chance.decades(1e-3, 1e9);
    along = chance.sign() * chance.decades(1e-3, 1e3) / std::max(1.0, camera.focal / 512);
  }
  View view = mirrored(chance, scenes::view_of(camera, rows, along));
  std::vector<double>& h = view.homography;
  if (kind == nearly_singular) {
    const double apart = chance.decades(1e-9, 1e-1);
    for (std::size_t i = 0; i < 3; ++i) h[i] = h[3 + i] + apart * h[i];
  }
  if (kind == far_away) {
    const double x = std::round(chance.sign() * chance.decades(1, 0x1p40)),
                 y = std::round(chance.sign() * chance.decades(1, 0x1p40));
    for (std::size_t row = 0; row < 9; row += 3) h[row + 2] -= h[row] * x + h[row + 1] * y;
    view.at = {view.at.x + x, view.at.y + y};
  }
  return around(chance, view, filter);
}

}  // namespace

extern const Family boards;
constinit const Family boards = {
    .name = "boards",
    .title = "checkerboards to and across their horizon, rolled, grazing, nearly singular, far from the origin",
    .quantity = "exact value of a pixel under any filter",
    .severity = "condition of the homography",
    .claim = "the printed bound of `moire exact --pixels`",
    .share = 1,
    .run = [](CaseKey key) { return run(make_case(key)); },
    .describe = [](CaseKey key) { return describe(make_case(key)); }};

}  // namespace moire::stress
