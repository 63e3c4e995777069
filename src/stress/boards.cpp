// Checkerboards that hurt: their horizon on, between and across pixel rows, vanishing points inside pixels, rolled and
// grazing views, focal lengths from far too short to far too long, nearly singular homographies.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "oracle/coverage.h"
#include "oracle/filtered.h"
#include "oracle/one_point.h"
#include "oracle/one_point_radial.h"
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
  endless,          // the whole plane, however many squares: the program's values against sums of others of its own
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

// The whole plane by a camera of the program's own making or by a homography, where its squares are many: at the
// horizon, in front of it or a little beyond.
struct PlaneView {
  TestImage image;
  Pixel pixel;
};

// Columns and horizon with slopes of small whole numbers.
PlaneView resonant_plane(Chance& chance, double rows) {
  const auto whole = [&](double most) { return std::round(chance.between(-most, most)); };
  const double a = whole(4) + 5, b = whole(4), d = whole(4);
  const double w = chance.sign() * std::ldexp(1, static_cast<int>(chance.below(7)) - 6), lean = whole(2) * w / 2;
  const View view{{a, b, chance.between(-20, 20), d, b * d >= 0 ? -5.0 : 5.0, chance.between(-20, 20), lean, w,
                   -w * chance.between(0, 64)},
                  {}};
  const std::vector<double>& h = view.homography;
  const double x = chance.between(0, 64), depth = rows * std::hypot(lean, w);
  const Vec2 at{x, (depth - h[6] * x - h[8]) / h[7]};
  return {scenes::plane(h), View{h, at}.pixel()};
}

PlaneView any_plane(Chance& chance) {
  Camera camera = any_camera(chance);
  const double rows = chance.coin() ? chance.between(-0.7, 1) : chance.decades(1e-9, 20);
  double along = chance.between(-1, 1);
  const std::uint64_t way = chance.below(5);
  if (way == 0) return resonant_plane(chance, rows);
  if (way == 1) camera.pitch = chance.sign() * chance.decades(1e-15, 1e-8);
  if (way == 2) {
    camera.focal = chance.decades(1e-3, 1e9);
    along = chance.sign() * chance.decades(1e-3, 1e3) / std::max(1.0, camera.focal / 512);
  }
  View view = scenes::view_of(camera, rows, along);
  if (way == 3) {
    std::vector<double>& h = view.homography;
    const double apart = chance.decades(1e-9, 1e-1);
    for (std::size_t i = 0; i < 3; ++i) h[i] = h[3 + i] + apart * h[i];
  } else if (chance.coin()) {
    return {scenes::plane(camera), view.pixel()};
  }
  view = mirrored(chance, view);
  return {scenes::plane(view.homography), view.pixel()};
}

// A kernel that is a sum of narrow ones at whole pixels, with these weights along each axis over their sum: in the
// image itself, or in one of twice as many pixels a side, whose homography is the same but for a power of two.
struct Refinement {
  const char *wide, *narrow;
  double finer;        // 1 or 2: pixels of the narrow kernel's image in one of the wide one's
  std::int64_t first;  // its first pixel, counted from `finer` times the wide one's
  std::vector<double> weight;
};

// The sum, from the program's values, and the sum of their bounds.
oracle::Value refined(const Refinement& r, const TestImage& plane, Pixel pixel) {
  const oracle::Board board = oracle::board_of(plane);
  std::vector<double> h(board.homography.begin(), board.homography.end());
  for (const std::size_t i : {0, 1, 3, 4, 6, 7}) h[i] /= r.finer;
  const TestImage finer = scenes::plane(h);
  const FilterPtr narrow = checked_filter(r.narrow);
  const auto times = static_cast<std::int64_t>(r.finer), count = static_cast<std::int64_t>(r.weight.size());
  double total = 0;
  for (const double w : r.weight) total += w;
  oracle::Value sum;
  for (std::int64_t j = 0; j < count; ++j)
    for (std::int64_t i = 0; i < count; ++i) {
      const Exact part =
          exact_pixel(finer, narrow->filter, {times * pixel.x + r.first + i, times * pixel.y + r.first + j});
      const double weight = r.weight[static_cast<std::size_t>(i)] * r.weight[static_cast<std::size_t>(j)];
      const long double share = static_cast<long double>(weight) / static_cast<long double>(total * total);
      sum += {share * static_cast<long double>(part.value), share * static_cast<long double>(part.bound)};
    }
  sum.error += 0x1p-57L;  // at most 36 products and sums, of 64 bits and below 1
  return sum;
}

ExactCase wide_window_case(Chance& chance) {
  static const std::vector<Refinement> kBoxes{{"box", "box", 2, 0, {1, 1}},
                                              {"box:width=2", "box", 2, -1, {1, 1, 1, 1}},
                                              {"box:width=3", "box", 1, -1, {1, 1, 1}},
                                              {"box:width=5", "box", 1, -2, {1, 1, 1, 1, 1}}};
  static const std::vector<Refinement> kOthers{{"tent:radius=2", "tent", 1, -1, {1, 2, 1}},
                                               {"tent:radius=3", "tent", 1, -2, {1, 2, 3, 2, 1}},
                                               {"bspline:order=2", "bspline:order=2", 2, -1, {1, 3, 3, 1}},
                                               {"bspline:order=4", "bspline:order=4", 2, -2, {1, 5, 10, 10, 5, 1}}};
  const PlaneView view = any_plane(chance);
  const Refinement r = chance.pick(chance.below(32) == 0 ? kOthers : kBoxes);
  ExactCase c = finished(view.image, view.pixel, checked_filter(r.wide));
  c.oracle_doubt = 0;
  c.truth = [r, view] { return refined(r, view.image, view.pixel); };
  return c;
}

// Of the half-plane in front of the horizon, as the oracle has it.
oracle::Value value_in_front(const oracle::Board& board, const CheckedFilter& f, Pixel pixel) {
  using oracle::Quad;
  const Quad nx = oracle::widen(board.homography[6]), ny = oracle::widen(board.homography[7]);
  const Quad x = static_cast<Quad>(pixel.x) + Quad(1) / 2, y = static_cast<Quad>(pixel.y) + Quad(1) / 2;
  const oracle::HalfPlane seen{nx, ny, nx * x + ny * y + oracle::widen(board.homography[8])};
  const double reach = f.filter.radius();
  if (f.is_box) return oracle::coverage(seen, 2 * reach);
  if (f.kernel) return oracle::filtered(*f.kernel, seen);
  // As an edge across pixel 0, 0: its point in doubles is within a unit in the last place of 1/2 and of the window's
  // size, and moves the value by no more than that times the kernel's largest integral along a line. Beyond the window
  // any distance will do.
  const double n[2] = {board.homography[6], board.homography[7]}, size = std::hypot(n[0], n[1]);
  const double away = std::clamp(-static_cast<double>(seen.offset / oracle::widen(size)), -2 * reach, 2 * reach);
  const oracle::Edge edge{{0.5 + away * n[0] / size, 0.5 + away * n[1] / size}, {n[0], n[1]}};
  oracle::Value value = oracle::filtered(*f.rings, edge, {0, 0});
  value.error += static_cast<long double>(0x1p-50 * (1 + reach) * 2 * reach * f.filter.radial_kernel().k_max());
  return value;
}

// Mirrored in u, the squares have each other's colours: both values add to that of the half-plane in front of the
// horizon. The image is turned by a quarter, too, so that rows and columns of the window change places.
oracle::Value without_other_colour(const TestImage& plane, const CheckedFilter& f, Pixel pixel) {
  const oracle::Board board = oracle::board_of(plane);
  const std::array<double, 9>& h = board.homography;
  const TestImage other = scenes::plane({-h[1], h[0], -h[2], h[4], -h[3], h[5], h[7], -h[6], h[8]});
  const Exact part = exact_pixel(other, f.filter, {pixel.y, -1 - pixel.x});
  const oracle::Value all = value_in_front(board, f, pixel);
  return {all.value - static_cast<long double>(part.value),
          all.error + static_cast<long double>(part.bound) + 0x1p-62L};
}

ExactCase two_colours_case(Chance& chance) {
  const PlaneView view = any_plane(chance);
  // On the horizon other separable kernels take a second, and far more at focal lengths of 1e9.
  FilterPtr filter = chance.below(8) == 0 ? pick_filter(chance) : checked_filter("box");
  const double low = 0.5 - filter->filter.radius(), high = 0.5 + filter->filter.radius();
  if (filter->kernel && view.image.meets_horizon(view.pixel, {{low, low}, {high, high}}))
    filter = checked_filter("box");
  ExactCase c = finished(view.image, view.pixel, filter);
  c.oracle_doubt = 0;
  c.truth = [filter, view] { return without_other_colour(view.image, *filter, view.pixel); };
  return c;
}

// Radial filters on the whole plane in one-point perspective, to its horizon: chords are the oracle's way. Columns are
// no further to the side and squares no finer than it can do in some ten milliseconds.
ExactCase chords_case(Chance& chance) {
  static const std::vector<std::string> kFilters = filter_variants(Symmetry::radial);
  const FilterPtr filter = checked_filter(chance.pick(kFilters));
  const double reach = filter->filter.radius(), focal = chance.decades(5, 100);
  const Camera camera{.focal = focal,
                      .principal = {std::round(chance.between(0, 64)) + 0.25 * static_cast<double>(chance.below(4)),
                                    chance.between(0, 64)},
                      .height = std::min(chance.decades(0.2, 5), 100 / focal),
                      .pitch = chance.between(-10, 40),
                      .yaw = 0,
                      .roll = chance.coin() ? 0 : chance.between(-180, 180)};
  // The horizon through the support, now and then touching its rim, or a little above it.
  constexpr double kTouching[] = {-1, 1, 0};
  const double rows = chance.below(6) == 0 ? reach * chance.pick(kTouching) + chance.sign() * chance.decades(1e-9, 1e-2)
                                           : reach * chance.between(-0.98, 1.2);
  View view = mirrored(chance, scenes::view_of(camera, rows, chance.between(-0.3, 0.3)));
  if (chance.coin())
    for (std::size_t i = 0; i < 3; ++i) std::swap(view.homography[i], view.homography[3 + i]);  // u and v
  ExactCase c = finished(scenes::plane(view.homography), view.pixel(), filter);
  c.oracle_doubt = 0;
  c.truth = [filter, board = oracle::board_of(c.image), pixel = c.pixel] {
    return oracle::one_point(oracle::ChordKernel(filter->filter.text()), board, pixel);
  };
  return c;
}

ExactCase make_case(CaseKey key) {
  Chance chance("boards", key);
  const std::uint64_t kind = key.index % kKinds;
  if (kind == one_point) return one_point_case(chance);
  if (kind == endless) {
    if (chance.below(30) == 0) return chords_case(chance);
    return chance.below(6) == 0 ? wide_window_case(chance) : two_colours_case(chance);
  }
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
    .claim =
        "the printed bound of `moire exact --pixels`; of planes without end, that and those of the program's other "
        "values that make up the same one",
    .share = 1,
    .run = [](CaseKey key) { return run(make_case(key)); },
    .describe = [](CaseKey key) { return describe(make_case(key)); }};

}  // namespace moire::stress
