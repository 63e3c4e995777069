// Properties of every radial filter in the catalogue, at its defaults and at the ends of its parameters.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "filter_list.h"
#include "filters/filter.h"
#include "filters/jinc_function.h"

using namespace moire;

namespace {

std::vector<Filter> radial_catalogue() {
  std::vector<std::string> texts = test::radial_texts();
  for (const FilterInfo* info : filters()) {
    if (info->symmetry() != Symmetry::radial) continue;
    for (const Param& p : info->params) {
      if (p.kind != Param::Kind::number && p.kind != Param::Kind::integer) continue;
      const std::string key = std::string(info->name) + ":" + std::string(p.name) + "=";
      // Far out in the BC family the integral over the plane is negative, and the filter refused.
      texts.push_back(key + (info->name == "radial-bc" && p.min < 0 ? "-1" : shortest(p.min)));
      texts.push_back(key + (info->name == "radial-bc" && p.min < 0 ? "1" : shortest(p.max)));
    }
  }
  std::vector<Filter> all;
  for (const std::string& text : texts) all.emplace_back(parse_spec(text, "test"));
  return all;
}

// The derivative of f at r by three points to either side: what they miss is below h^6 of the seventh derivative.
template <class F>
double slope(const F& f, double r, double h) {
  return (45 * (f(r + h) - f(r - h)) - 9 * (f(r + 2 * h) - f(r - 2 * h)) + (f(r + 3 * h) - f(r - 3 * h))) / (60 * h);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("every radial kernel has a whole integral of 1 and is nothing from its radius on") {
    for (const Filter& f : radial_catalogue()) {
      CAPTURE(f.text());
      REQUIRE(f.is_radial());
      const RadialKernel& k = f.radial_kernel();
      CHECK(k.knots().front() == 0);
      CHECK(k.knots().back() == f.radius());
      CHECK(f.apron() == static_cast<int>(std::ceil(f.radius() - 0.5)));
      CHECK(k.k(k.radius()) == 0);
      CHECK(k.k(std::nextafter(k.radius(), 99.0)) == 0);
      CHECK(std::fabs(2 * std::numbers::pi * k.G(k.radius()) - 1) <= 4 * 0x1p-53);
      // Up to the radius from inside; G is continuous there.
      const double inside = std::nextafter(k.radius(), 0.0);
      CHECK(std::fabs(2 * std::numbers::pi * k.G(inside) - 1) <=
            2 * std::numbers::pi * (k.G_error() + k.k_max() * k.radius() * k.radius() * 0x1p-52));
      CHECK(std::fabs(k.q(0) - k.k(0) / 2) <= k.q_error() + k.k_error() / 2);
      CHECK(k.k_error() <= 1e-14 * std::max(1.0, k.k_max()));
    }
  }

  TEST_CASE("q grows as k - 2 q over r, and the bounds of every piece hold") {
    for (const Filter& f : radial_catalogue()) {
      CAPTURE(f.text());
      const RadialKernel& k = f.radial_kernel();
      for (int p = 0; p < k.pieces(); ++p) {
        const RadialKernel::PieceBounds& b = k.bounds(p);
        const auto i = static_cast<std::size_t>(p);
        const double left = k.knots()[i], length = k.knots()[i + 1] - left, h = length / 200;
        for (int j = 4; j <= 196; ++j) {
          const double r = left + j * h, k_here = k.k_piece(p, r), q_here = k.q_piece(p, r);
          CHECK(std::fabs(k_here) <= b.k);
          CHECK(std::fabs(q_here) <= b.q);
          CHECK(std::fabs(k_here - 2 * q_here) <= b.growth);
          const double q_slope = slope([&](double at) { return k.q_piece(p, at); }, r, h);
          // The formula's remainder is (6 h)^7 / h of the next derivative, whose Cauchy bound is 7! over the piece's
          // length to the 7th: 1e-8 of k here. Rounding of q is magnified by 2 / h.
          CHECK(std::fabs(r * q_slope - (k_here - 2 * q_here)) <= 1e-6 * b.k + 4 * r / h * b.q_error);
        }
        CHECK(b.slope <= k.slope_max());
        CHECK(b.jump <= k.jump_max());
        CHECK(b.q <= 0.5000005 * k.k_max());
      }
    }
  }

  TEST_CASE("many weights at once are the weights one by one, bit for bit") {
    for (const Filter& f : radial_catalogue()) {
      CAPTURE(f.text());
      const RadialKernel& k = f.radial_kernel();
      for (const std::size_t n : {0, 1, 5, 37, 128}) {
        std::vector<double> x, y, w(n);
        for (std::size_t i = 0; i < n; ++i) {
          const double t = 7.3 * static_cast<double>(i);
          x.push_back(1.2 * f.radius() * std::cos(t));
          y.push_back(f.radius() * std::sin(0.61 * t));
        }
        k.weights(x, y, w);
        for (std::size_t i = 0; i < n; ++i) CHECK(w[i] == k.k(std::sqrt(x[i] * x[i] + y[i] * y[i])));
      }
    }
  }

  TEST_CASE("the jinc is 1 at 0, 0 at its zeros, and what tables say between") {
    const JincFunction jinc(17);
    CHECK(std::fabs(jinc(0.0).value() - 1) <= 0x1p-53);
    for (int i = 1; i <= kJincZeros; ++i) {
      CAPTURE(i);
      const double z = jinc_zero(i);
      // The zero's rounding, half an ulp, times a slope of at most 1.
      CHECK(std::fabs(jinc(z).value()) <= z * 0x1p-53);
      CHECK(jinc(z - 0.1).value() * jinc(z + 0.1).value() < 0);
    }
    // 2 J1(y) / y for y = 1, 2, 5, 10 (Abramowitz and Stegun, table 9.1).
    const double known[][2] = {
        {1, 0.4400505857449335}, {2, 0.5767248077568734}, {5, -0.3275791375914652}, {10, 0.0434727461688614}};
    for (const auto& [y, j1] : known) {
      CHECK(std::fabs(jinc(Dd(y / std::numbers::pi)).value() - 2 * j1 / y) <= 4e-16);
    }
  }

  TEST_CASE("OSPRay's Mitchell ends where it would turn negative, and presets refuse what they set") {
    const Filter clamped(parse_spec("radial-bc:preset=ospray-mitchell", "test"));
    CHECK(clamped.radius() == 8.0 / 7);
    const RadialKernel& k = clamped.radial_kernel();
    for (int i = 0; i < 1000; ++i) CHECK(k.k(clamped.radius() * i / 1000) >= 0);
    CHECK_THROWS_AS(Filter(parse_spec("radial-bc:preset=ospray-mitchell,b=1", "test")), Error);
    CHECK_THROWS_AS(Filter(parse_spec("radial-bc:b=-1,c=2", "test")), Error);  // its integral is negative
  }

  TEST_CASE("separable and radial variants are all variants, and what is for separable ones says so") {
    const std::vector<std::string> separable = filter_variants(Symmetry::separable),
                                   radial = filter_variants(Symmetry::radial);
    std::vector<std::string> both = separable;
    both.insert(both.end(), radial.begin(), radial.end());
    CHECK(both == filter_variants());
    for (const std::string& text : separable) {
      const Filter filter(parse_spec(text, "test"));
      CHECK_FALSE(filter.is_radial());
      CHECK_NOTHROW(require_separable(filter, "this"));
    }
    CHECK_THROWS_WITH_AS(require_separable(Filter(parse_spec("cone", "test")), "this"),
                         "filter \"cone\": a radial filter; this is for separable ones only", Error);
  }
}
