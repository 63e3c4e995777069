// Exact values of endless boards under radial filters for different aims: each takes other parts, other numbers of
// squares and other terms, and all are to mean one value.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "engine/exact.h"
#include "engine/random_scenes.h"
#include "filter_list.h"

namespace moire {
namespace {

constexpr double kAims[] = {1e-2, 1e-4, 1e-6, 1e-9, 1e-12};

struct Case {
  std::vector<double> homography;
  Pixel pixel;
};

// A camera of any yaw and roll whose horizon passes through the filter's support, near it or a few radii away; and any
// plane: nearly affine ones, and coordinates up to 1e9 squares from the origin.
Case random_case(Draw& draw, double radius) {
  double rows = 0;
  switch (draw.integer(0, 3)) {
    case 0:
      rows = draw.uniform(-1, 1) * radius;
      break;
    case 1:
      rows = (draw.coin() ? 1 : -1) * radius * (1 - draw.log_uniform(1e-9, 1e-1));
      break;
    case 2:
      rows = radius * (1 + draw.log_uniform(1e-9, 1));
      break;
    default:
      rows = radius + draw.uniform(0, 10);
  }
  if (draw.integer(0, 3) > 0) {
    const scenes::Camera camera{.focal = draw.log_uniform(20, 2000),
                                .principal = {draw.uniform(-100, 100), draw.uniform(-100, 100)},
                                .height = draw.log_uniform(0.3, 20),
                                .pitch = draw.uniform(-10, 40),
                                .yaw = draw.coin() ? draw.uniform(-180, 180) : 0,
                                .roll = draw.uniform(-180, 180)};
    // The principal point is moved so that the pixel's centre is so many rows below the horizon, to the last bit or so.
    const scenes::View view = scenes::view_of(camera, rows, draw.uniform(-1, 1));
    scenes::Camera moved = camera;
    moved.principal.x += 0.5 - view.at.x;
    moved.principal.y += 0.5 - view.at.y;
    return {scenes::homography_of(moved), {0, 0}};
  }
  const double squares = draw.log_uniform(5, 60) / radius, tilt = draw.log_uniform(1e-12, 1e-2);
  const double far = draw.log_uniform(1, 1e9);
  std::vector<double> h;
  for (int row = 0; row < 2; ++row) {
    const double angle = draw.uniform(0, 7);
    h.insert(h.end(), {squares * std::cos(angle), squares * std::sin(angle), draw.uniform(-1, 1) * far});
  }
  const double angle = draw.uniform(0, 7);
  h.insert(h.end(), {tilt * std::cos(angle), tilt * std::sin(angle), 1});
  return {h, {draw.integer(-100, 100), draw.integer(-100, 100)}};
}

void compare_aims(std::uint64_t seed, int cases, std::span<const double> aims) {
  Draw draw(seed);
  const std::vector<std::string> texts = test::radial_texts();
  double worst = 0;
  int fine = 0, coarse = 0;
  for (int i = 0; i < cases; ++i) {
    const std::string& text = texts[static_cast<std::size_t>(i) % texts.size()];
    const Filter filter(parse_spec(text, "test"));
    const Case c = random_case(draw, filter.radius());
    const TestImage image = scenes::plane(c.homography);
    CAPTURE(i);
    CAPTURE(text);
    std::vector<Exact> all;
    for (const double aim : aims) {
      all.push_back(exact_pixel(image, filter, c.pixel, WeightAim::everywhere(aim)));
      CAPTURE(aim);
      for (const Exact& other : all) {
        const double miss = std::fabs(all.back().value - other.value), bound = all.back().bound + other.bound;
        CHECK(miss <= bound);
        if (bound > 0) worst = std::max(worst, miss / bound);
      }
      // More is asked, and what was asked before is known no less, but for rounding, which counts more where there are
      // more squares. Beyond that bounds may grow: parts are chosen by estimates without what sides lose.
      if (all.size() > 1) {
        const std::size_t before = all.size() - 2;
        CHECK(all.back().bound <= 1.5 * std::max(all[before].bound, aims[before]) + 1e-12);
      }
      coarse += aim < 1e-4 || all.back().bound <= aim;
    }
    fine += all.back().bound < 10 * aims.back();
  }
  MESSAGE(fine << " of " << cases << " as well known as the finest aim asks; largest difference over bounds " << worst);
  CHECK(fine > cases / 4);
  // Coarse aims are met but where squares are finer than 1e-6 pixels, so that agreement is of values that are known.
  CHECK(coarse > 0.95 * static_cast<double>(aims.size()) * cases);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("coarse aims agree with finer ones within their bounds, which shrink with the aim") {
    compare_aims(131, 27, std::span(kAims).first(3));
  }

  // Where lines by the ten thousand cross a side in front of the horizon, and where the last side of a rim was chosen
  // too long by half. The bounds of 1e-12 were 4.7, 1.7 and 1.5 times those of 1e-9.
  TEST_CASE("what is asked to 1e-12 is known as well as what is asked to 1e-9") {
    struct Hard {
      const char* filter;
      std::vector<double> homography;
      double old_bound;
    };
    const Hard kPixels[] = {
        {"jinc:preset=imagemagick2",
         {0.0002008925399185289, 0.00031634479276457098, 0.14880913679878952, 4.2258885355165355e-05,
          -2.683620848927049e-05, 0.63740346972301731, -0.00049636799913268517, 0.00031521501336756328,
          -0.00099132151078026864},
         2.45e-9},
        {"disk",
         {-0.48584205495227178, -0.12825840129037075, -14.362159191386608, -0.037539598517063968, 0.14219977406644072,
          20.008261214007856, 0.006405320041509165, -0.024263313906029642, 0.0026394725689651843},
         2.0e-8},
        {"disk:radius=1.25",
         {-0.01500378463442619, -0.0087901621470535592, -3.6758727262553967, -0.0047267196810769577,
          0.0080679608562117464, 21.636780981383836, 0.00040628612540102155, -0.0006934831716973169,
          -0.00011884860141853082},
         6.7e-6}};
    for (const Hard& p : kPixels) {
      CAPTURE(p.filter);
      const Filter filter(parse_spec(p.filter, "test"));
      const TestImage image = scenes::plane(p.homography);
      const Exact coarse = exact_pixel(image, filter, {0, 0}, WeightAim::everywhere(1e-9));
      const Exact fine = exact_pixel(image, filter, {0, 0}, WeightAim::everywhere(1e-12));
      CHECK(std::fabs(fine.value - coarse.value) <= fine.bound + coarse.bound);
      CHECK(fine.bound <= coarse.bound);
      CHECK(fine.bound < 0.7 * p.old_bound);
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("all aims agree within their bounds, which shrink with the aim") { compare_aims(132, 54, kAims); }
}

TEST_SUITE("slow") {
  TEST_CASE("all aims agree within their bounds in many random windows") { compare_aims(133, 540, kAims); }
}

}  // namespace moire
