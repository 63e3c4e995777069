// Curves of every filter of the catalogue, against what its kernel and its metrics say.
#include "measure/filter_curves.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/radial_metrics.h"

namespace moire {
namespace {

FilterMetrics metrics_of(const Filter& filter) {
  return filter.is_radial() ? filter_metrics(filter.radial_kernel()) : filter_metrics(filter.kernel());
}

TEST_SUITE("unit") {
  TEST_CASE("every filter's response is 1 at zero and its Nyquist response at one half") {
    for (const std::string& name : filter_variants()) {
      CAPTURE(name);
      const Filter filter(parse_spec(name, "test"));
      const Curve response = filter_curves(filter).response;
      REQUIRE(response.x.size() == response.y.size());
      // Quadrature and series alike: some 1e-14 each; of a radial one times the Bessel functions' 1e-13.
      CHECK(response.y[0] == doctest::Approx(1).epsilon(1e-12));
      CHECK(response.x[32] == 0.5);
      CHECK(std::fabs(response.y[32] - metrics_of(filter).nyquist_response) < 1e-11);
    }
  }

  TEST_CASE("every filter's edge goes from 0 to 1, is odd about its middle and overshoots as its metrics say") {
    for (const std::string& name : filter_variants()) {
      CAPTURE(name);
      const Filter filter(parse_spec(name, "test"));
      const Curve edge = filter_curves(filter).edge;
      const std::size_t n = edge.x.size();
      CHECK(edge.y.front() == 0);
      CHECK(edge.y.back() == 1);
      double most = 0;
      for (std::size_t i = 0; i < n; ++i) {
        CHECK(edge.x[i] == -edge.x[n - 1 - i]);
        CHECK(std::fabs(edge.y[i] + edge.y[n - 1 - i] - 1) < 1e-12);  // the catalogue's kernels are even
        most = std::max(most, edge.y[i] - 1);
      }
      const double overshoot = metrics_of(filter).overshoot_percent / 100;
      CHECK(most <= overshoot + 1e-12);
      // The highest point is at most half a step from a drawn one. There the edge is flat, and falls by no more than
      // the steps beside it.
      CHECK(most >= 0.9 * overshoot - 1e-4);
    }
  }

  TEST_CASE("every filter's kernel is drawn to its knots, and its area is that of the kernel") {
    for (const std::string& name : filter_variants()) {
      CAPTURE(name);
      const Filter filter(parse_spec(name, "test"));
      const Curve kernel = filter_curves(filter).kernel;
      CHECK(kernel.y.front() == 0);
      CHECK(kernel.y.back() == 0);
      CHECK(std::is_sorted(kernel.x.begin(), kernel.x.end()));
      // Under the drawn line, or of the solid around the axis: twice around, half of it from each side. Chord by chord
      // a quadratic at most, which Simpson's rule integrates.
      const auto slice = [&](double x, double y) {
        return filter.is_radial() ? std::numbers::pi * std::fabs(x) * y : y;
      };
      double area = 0;
      for (std::size_t i = 1; i < kernel.x.size(); ++i) {
        const double x0 = kernel.x[i - 1], x1 = kernel.x[i], y0 = kernel.y[i - 1], y1 = kernel.y[i];
        area += (slice(x0, y0) + 4 * slice(0.5 * (x0 + x1), 0.5 * (y0 + y1)) + slice(x1, y1)) / 6 * (x1 - x0);
      }
      // Chords of 1/256 of the support lie beside a curve by an eighth of its curvature times that squared.
      CHECK(area == doctest::Approx(1).epsilon(1e-3));
    }
  }
}

}  // namespace
}  // namespace moire
