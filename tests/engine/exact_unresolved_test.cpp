// Windows of the board with too many squares to clip, and with its horizon: radial filters, and separable ones on the
// way of radial ones, against the exact way of separable filters.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/boundary_integral.h"
#include "engine/exact.h"
#include "engine/random_scenes.h"
#include "engine/weight_bounds.h"

namespace moire {
namespace {

Filter filter_of(const std::string& text) { return Filter(parse_spec(text, "test")); }

struct Case {
  TestImage image;
  Pixel pixel;
};

// So many rows below the horizon, in a random column.
Case board(Draw& draw, double height, double rows) {
  const scenes::Camera camera{.focal = draw.log_uniform(200, 1000),
                              .principal = {0, 0},
                              .height = height,
                              .pitch = draw.uniform(-5, 30),
                              .yaw = draw.coin() ? 0 : draw.uniform(-180, 180),
                              .roll = draw.coin() ? 0 : draw.uniform(-45, 45)};
  const std::vector<double> h = scenes::homography_of(camera);
  const double size = std::hypot(h[6], h[7]), along = draw.uniform(-0.5, 0.5) * camera.focal;
  const double nx = h[6] / size, ny = h[7] / size, down = -h[8] / size + rows;
  return {scenes::plane(camera),
          {static_cast<std::int64_t>(std::floor(down * nx - along * ny)),
           static_cast<std::int64_t>(std::floor(down * ny + along * nx))}};
}

// The squares that are clipped, the rest half covered; `by_area` is the bound if nothing is known but the rest's area.
Exact clipped(const Case& c, const Filter& filter, double* by_area) {
  Boundary boundary;
  c.image.boundary(c.pixel, filter.radius(), boundary);
  const Kernel& kernel = filter.kernel();
  BoundaryIntegral integral(kernel);
  integral.reset();
  for (const Segment& s : boundary.segments) integral.add(s);
  const double k_error = 2.1 * kernel.k_max() * kernel.k_error();
  *by_area = integral.bound() + boundary.area_doubt() * kernel.k_max() * kernel.k_max();
  return {integral.value(), integral.bound() + doubt(boundary, weight_bounds(kernel), k_error)};
}

struct Summary {
  std::vector<double> bound, by_area;
  void add(double b, double a) { bound.push_back(b), by_area.push_back(a); }
  static double median(std::vector<double> x) {
    std::sort(x.begin(), x.end());
    return x[x.size() / 2];
  }
  std::string text() const {
    return "bound median " + std::to_string(median(bound)) + ", by area alone " + std::to_string(median(by_area));
  }
};

TEST_SUITE("heavy") {
  TEST_CASE("the unresolved rest of a window is within its bound for separable kernels") {
    Draw draw(81);
    for (const std::string name : {"mitchell", "tent", "gaussian"}) {
      const Filter filter = filter_of(name);
      Summary summary;
      for (int n = 0; n < 4; ++n) {
        const Case c = board(draw, n % 2 == 0 ? 1 : 8, draw.uniform(-1, 1.5));
        double by_area = 0;
        const Exact got = clipped(c, filter, &by_area), truth = exact_pixel(c.image, filter, c.pixel);
        CHECK(std::fabs(got.value - truth.value) <= got.bound + truth.bound);
        // But for the rounding of sums of bounds.
        CHECK(got.bound <= by_area * (1 + 1e-9));
        summary.add(got.bound, by_area);
      }
      MESSAGE(name << ": " << summary.text());
      CHECK(Summary::median(summary.bound) < 0.1 * Summary::median(summary.by_area));
    }
  }

  TEST_CASE("a radial Gaussian sees the board up to its horizon as the separable one does") {
    // Both are cut at 6 sigma, where exp(-18) = 1.5e-8 is left: by a disk and by a square. Beyond the disk there are
    // exp(-18) of the integral, and as much again comes with the normalisation.
    const Filter radial = filter_of("radial-gaussian:sigma=0.25,radius=1.5,cut=cut"),
                 separable = filter_of("gaussian:sigma=0.25,radius=1.5,cut=cut");
    Draw draw(82);
    Summary summary;
    for (int n = 0; n < 4; ++n) {
      const Case c = board(draw, 1, draw.uniform(-0.5, 0.5));
      const Exact got = exact_pixel(c.image, radial, c.pixel), truth = exact_pixel(c.image, separable, c.pixel);
      CHECK(std::fabs(got.value - truth.value) <= got.bound + truth.bound + 3.1e-8);
      summary.add(got.bound, 0.5 * radial.radial_kernel().k_max());
    }
    MESSAGE(summary.text());
    CHECK(Summary::median(summary.bound) < 0.05);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("bounds of radial kernels on slopes and second derivatives hold, and are no fantasy") {
    for (const char* name :
         {"cone", "radial-gaussian", "radial-bc", "radial-lanczos", "jinc", "disk", "radial-gaussian:cut=cut"}) {
      const Filter filter = filter_of(name);
      const RadialKernel& k = filter.radial_kernel();
      const WeightBounds bounds = weight_bounds(k);
      CAPTURE(name);
      double curvature = 0, kink = 0;
      for (int p = 0; p < k.pieces(); ++p) {
        const double from = k.knots()[static_cast<std::size_t>(p)], to = k.knots()[static_cast<std::size_t>(p) + 1];
        const double h = (to - from) / 1000;
        for (int n = 1; n < 1000; ++n) {
          const double r = from + n * h;
          curvature =
              std::max(curvature, std::fabs(k.k_piece(p, r + h) - 2 * k.k_piece(p, r) + k.k_piece(p, r - h)) / (h * h));
        }
        // Slopes on both sides of the knot at `to`, by short differences: right to h times the curvature.
        const double left = (k.k_piece(p, to) - k.k_piece(p, to - 1e-3 * h)) / (1e-3 * h);
        const double right =
            p + 1 < k.pieces() ? (k.k_piece(p + 1, to + 1e-3 * h) - k.k_piece(p + 1, to)) / (1e-3 * h) : 0;
        kink += std::fabs(left - right);
      }
      // 1e-8: rounding of second differences, 4e-16 over h^2 = 1e-6, with room for k above 1; 1e-5: over 1e-6 once.
      CHECK(bounds.curvature >= curvature - 1e-8);
      CHECK(bounds.curvature <= 2 * curvature + 0.2 * bounds.top);
      CHECK(bounds.kink >= kink - 1e-5 * (1 + curvature));
      CHECK(bounds.kink <= kink + 0.02 * (1 + curvature));
    }
  }
}

}  // namespace
}  // namespace moire
