// Properties of every filter in the catalogue, at its defaults and at the ends of its parameters.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "curve/quadrature.h"
#include "filter_list.h"
#include "filters/filter.h"

using namespace moire;

namespace {

// Each separable filter with its defaults, with each of its choices and with each number at either end; and some
// between.
std::vector<Filter> catalogue() {
  std::vector<std::string> texts = test::separable_texts();
  for (const FilterInfo* info : filters()) {
    if (info->symmetry() == Symmetry::radial) continue;
    if (std::any_of(info->params.begin(), info->params.end(), [](const Param& p) { return p.required; })) continue;
    for (const Param& p : info->params) {
      if (p.kind != Param::Kind::number && p.kind != Param::Kind::integer) continue;
      const std::string key = std::string(info->name) + ":" + std::string(p.name) + "=";
      texts.push_back(key + shortest(p.min));
      texts.push_back(key + shortest(p.max));
    }
  }
  for (const char* text : {"lagrange:order=2", "lagrange:order=8", "cubic-spline:lobes=3", "sinc:radius=3.7",
                           "lanczos:a=16,blur=2", "mitchell:b=8,c=8", "mitchell:b=-8,c=-8", "mitchell:b=-8,c=8",
                           "windowed-sinc:window=kaiser,beta=32,radius=1", "windowed-sinc:window=parzen,radius=2.5",
                           "windowed-sinc:window=bohman,radius=1.01", "pbrt-sinc:radius=16,tau=1"}) {
    texts.emplace_back(text);
  }
  std::vector<Filter> all;
  for (const std::string& text : texts) all.emplace_back(parse_spec(text, "test"));
  return all;
}

// Integral of k over [a, b] inside one piece, by 24 nodes.
double integrate(const Kernel& kernel, int piece, double a, double b) {
  const Rule rule = gauss_legendre(24);
  double sum = 0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    sum += rule.weight[i] * kernel.k_piece(piece, 0.5 * (a + b) + 0.5 * (b - a) * rule.node[i]);
  }
  return 0.5 * (b - a) * sum;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("filter names are unique and described") {
    std::set<std::string_view> names;
    for (const FilterInfo* f : filters()) {
      CHECK(names.insert(f->name).second);
      CHECK_FALSE(f->title.empty());
      CHECK_FALSE(f->cite.empty());
      for (const Param& p : f->params) CHECK_FALSE(p.help.empty());
    }
    CHECK_THROWS_AS(find_filter("bxo", "test"), Error);
  }

  TEST_CASE("K runs from 0 to 1, is the integral of k, and both stay within their stated bounds") {
    for (const Filter& f : catalogue()) {
      const Kernel& k = f.kernel();
      CAPTURE(f.text());
      const auto knots = k.knots();
      CHECK(knots.front() == -k.radius());
      CHECK(k.K(-k.radius()) <= k.K_error());
      CHECK(k.K(k.radius()) == 1.0);
      double sum = 0;
      for (int p = 0; p < k.pieces(); ++p) {
        const double a = knots[static_cast<std::size_t>(p)], b = knots[static_cast<std::size_t>(p) + 1];
        CHECK(a < b);
        for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
          const double x = a + t * (b - a);
          // 24 nodes integrate degree 47 exactly; k's error over the length, K's own, and those of the sum.
          const double tolerance = 2 * k.K_error() + (b - a) * (k.k_error() + 32 * 0x1p-53 * k.k_max()) + sum * 0x1p-50;
          CHECK(std::fabs(k.K_piece(p, x) - (sum + integrate(k, p, a, x))) <= tolerance + k.pieces() * 0x1p-52);
          CHECK(std::fabs(k.k_piece(p, x)) <= k.k_max() * (1 + 0x1p-50));
          CHECK(std::fabs(k.K_piece(p, x)) <= k.K_max() * (1 + 0x1p-50));
        }
        sum += integrate(k, p, a, b);
      }
    }
  }

  TEST_CASE("kernels are even, half-open and zero outside") {
    for (const Filter& f : catalogue()) {
      const Kernel& k = f.kernel();
      CAPTURE(f.text());
      const double r = k.radius();
      CHECK(k.k(r) == 0);
      CHECK(k.k(-std::nextafter(r, 100)) == 0);
      CHECK(k.k(100) == 0);
      CHECK(k.k(-100) == 0);
      for (int i = 0; i < 200; ++i) {
        const double x = r * (i + 0.5) / 200;
        CHECK(std::fabs(k.k(x) - k.k(-x)) <= 2 * k.k_error());
        CHECK(std::fabs(k.K(x) + k.K(-x) - 1) <= 2 * k.K_error() + 0x1p-53);
      }
    }
    // The box owns its left end: a sample on the left side of a pixel counts, one on the right side is the neighbour's.
    const Filter box(parse_spec("box", "test"));
    CHECK(box.kernel().k(-0.5) == 1);
    CHECK(box.kernel().is_unit_box());
    CHECK_FALSE(Filter(parse_spec("box:width=1.5", "test")).kernel().is_unit_box());
  }

  TEST_CASE("kernels equal their closed forms to the stated bound") {
    const auto check = [](const char* text, auto closed_form) {
      const Filter f(parse_spec(text, "test"));
      const Kernel& k = f.kernel();
      CAPTURE(text);
      for (int i = -1000; i <= 1000; ++i) {
        const double x = k.radius() * i / 1001.0;
        // The closed forms here are plain long double.
        CHECK(std::fabs(k.k(x) - static_cast<double>(closed_form(static_cast<long double>(x)))) <= k.k_error() + 1e-17);
      }
      CHECK(k.k_error() <= 1e-14);
    };
    check("tent", [](long double x) { return 1 - std::fabs(x); });
    const auto bc = [](long double b, long double c) {
      return [b, c](long double x) {
        const long double a = std::fabs(x);
        if (a < 1) return ((12 - 9 * b - 6 * c) * a * a * a + (-18 + 12 * b + 6 * c) * a * a + (6 - 2 * b)) / 6;
        return ((-b - 6 * c) * a * a * a + (6 * b + 30 * c) * a * a + (-12 * b - 48 * c) * a + (8 * b + 24 * c)) / 6;
      };
    };
    check("mitchell", bc(1.0L / 3, 1.0L / 3));
    check("mitchell:b=0.5,c=0.25", bc(0.5L, 0.25L));
    check("catmull-rom", bc(0, 0.5L));
    const auto gauss = [](long double sigma, long double radius, bool offset) {
      // Integral by erf, an independent route to the normalisation.
      const long double low = offset ? std::exp(-radius * radius / (2 * sigma * sigma)) : 0;
      const long double integral =
          sigma * std::sqrt(2 * 3.14159265358979323846264338L) * std::erf(radius / (sigma * std::sqrt(2.0L))) -
          2 * radius * low;
      return [=](long double x) { return (std::exp(-x * x / (2 * sigma * sigma)) - low) / integral; };
    };
    check("gaussian", gauss(0.5L, 1.5L, true));
    check("gaussian:cut=cut", gauss(0.5L, 1.5L, false));
    check("gaussian:sigma=0.375,radius=2.25", gauss(0.375L, 2.25L, true));
  }

  TEST_CASE("aprons are the pixels whose samples a window touches") {
    CHECK(Filter(parse_spec("box", "test")).apron() == 0);
    CHECK(Filter(parse_spec("box:width=1.5", "test")).apron() == 1);
    CHECK(Filter(parse_spec("tent", "test")).apron() == 1);
    CHECK(Filter(parse_spec("gaussian", "test")).apron() == 1);
    CHECK(Filter(parse_spec("mitchell", "test")).apron() == 2);
  }

  TEST_CASE("bulk weights are the same bits as single ones") {
    for (const Filter& f : catalogue()) {
      std::vector<double> x, w;
      for (int i = 0; i < 37; ++i) x.push_back(-f.radius() * 1.1 + f.radius() * 2.2 * i / 36);
      w.resize(x.size());
      f.kernel().weights(x, w);
      for (std::size_t i = 0; i < x.size(); ++i) CHECK(w[i] == f.kernel().k(x[i]));
    }
  }
}
