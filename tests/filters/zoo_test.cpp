// What each family of filters is by definition, by a second way to its kernel; and where families meet.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "filters/filter.h"

using namespace moire;

namespace {

using Real = long double;
using Form = std::function<Real(Real)>;

constexpr Real kPiL = std::numbers::pi_v<Real>;

Filter make(const std::string& text) { return Filter(parse_spec(text, "test")); }

Real sinc(Real x) { return x == 0 ? 1 : std::sin(kPiL * x) / (kPiL * x); }

// The filter is the form divided by the kernel's own integral, which is rounded to double: 2^-53 of the value, and
// rounding of the long double form.
void check_form(const std::string& text, const Form& form) {
  const Filter filter = make(text);
  const Kernel& k = filter.kernel();
  CAPTURE(text);
  for (int i = -1000; i <= 1000; ++i) {
    const double x = k.radius() * i / 1001.0;
    const double want = static_cast<double>(form(static_cast<Real>(x)) / static_cast<Real>(k.integral()));
    CAPTURE(x);
    CHECK(std::fabs(k.k(x) - want) <= k.k_error() + 0x1p-52 * std::fabs(want) + 0x1p-60 * k.k_max());
  }
}

// Two filters with one kernel, up to the errors that each states.
void check_same(const std::string& a, const std::string& b) {
  const Filter fa = make(a), fb = make(b);
  const Kernel &ka = fa.kernel(), &kb = fb.kernel();
  CAPTURE(a);
  CAPTURE(b);
  for (int i = -1000; i <= 1000; ++i) {
    const double x = std::max(ka.radius(), kb.radius()) * i / 1001.0;
    CHECK(std::fabs(ka.k(x) - kb.k(x)) <= ka.k_error() + kb.k_error());
    CHECK(std::fabs(ka.K(x) - kb.K(x)) <= ka.K_error() + kb.K_error());
  }
}

// max |sum over integers j of k(x + j) - 1|
double ripple(const Kernel& k) {
  const int reach = static_cast<int>(std::ceil(k.radius())) + 1;
  double worst = 0;
  for (int phase = 0; phase < 500; ++phase) {
    double sum = 0;
    for (int j = -reach; j <= reach; ++j) sum += k.k((phase + 0.5) / 500 + j);
    worst = std::max(worst, std::fabs(sum - 1));
  }
  return worst;
}

// The natural cubic spline through y at 0, 1, 2, ..., at s past sample i: its second derivatives by elimination.
Real natural_spline(const std::vector<Real>& y, std::size_t i, Real s) {
  const std::size_t n = y.size();
  std::vector<Real> m(n, 0), pivot(n, 4);
  for (std::size_t j = 1; j + 1 < n; ++j) {
    m[j] = 6 * (y[j - 1] - 2 * y[j] + y[j + 1]);
    if (j == 1) continue;
    m[j] -= m[j - 1] / pivot[j - 1];
    pivot[j] -= 1 / pivot[j - 1];
  }
  for (std::size_t j = n - 2; j > 0; --j) m[j] = (m[j] - m[j + 1]) / pivot[j];
  const Real t = 1 - s;
  return t * y[i] + s * y[i + 1] + ((t * t * t - t) * m[i] + (s * s * s - s) * m[i + 1]) / 6;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("kernels that interpolate are 1 at their centre and 0 at the other whole pixels") {
    for (const char* text : {"tent",
                             "hermite",
                             "catmull-rom",
                             "keys:a=-2",
                             "keys:a=0.5",
                             "simon",
                             "rifman",
                             "lagrange:order=1",
                             "lagrange:order=2",
                             "lagrange",
                             "lagrange:order=4",
                             "lagrange:order=5",
                             "lagrange:order=6",
                             "lagrange:order=7",
                             "lagrange:order=8",
                             "lagrange:order=9",
                             "cubic-spline:lobes=2",
                             "cubic-spline:lobes=3",
                             "cubic-spline:lobes=4",
                             "lanczos",
                             "lanczos:preset=imagemagick2",
                             "sinc:radius=5",
                             "pbrt-sinc",
                             "windowed-sinc",
                             "windowed-sinc:window=hamming",
                             "windowed-sinc:window=blackman",
                             "windowed-sinc:window=kaiser",
                             "windowed-sinc:window=welch",
                             "windowed-sinc:window=bohman",
                             "windowed-sinc:window=cosine",
                             "windowed-sinc:window=blackman-harris",
                             "windowed-sinc:window=bartlett"}) {
      const Filter f = make(text);
      const Kernel& k = f.kernel();
      CAPTURE(text);
      CHECK(k.k(0) == doctest::Approx(1 / k.integral()).epsilon(1e-14));
      for (int j = 1; j < k.radius(); ++j) {
        CHECK(std::fabs(k.k(j)) <= k.k_error());
        CHECK(std::fabs(k.k(-j)) <= k.k_error());
      }
    }
  }

  TEST_CASE("partitions of unity are ones") {
    for (const char* text : {"box",
                             "box:width=2",
                             "tent",
                             "tent:preset=pbrt",
                             "bspline:order=0",
                             "bspline:order=1",
                             "bspline:order=2",
                             "bspline",
                             "bspline:order=4",
                             "bspline:order=5",
                             "mitchell",
                             "mitchell:b=3,c=-2",
                             "mitchell:radius=4",
                             "catmull-rom",
                             "hermite",
                             "notch",
                             "robidoux",
                             "robidoux-sharp",
                             "keys:a=-2",
                             "simon",
                             "rifman",
                             "lagrange:order=1",
                             "lagrange:order=2",
                             "lagrange",
                             "lagrange:order=4",
                             "lagrange:order=5",
                             "lagrange:order=6",
                             "lagrange:order=7",
                             "lagrange:order=8",
                             "lagrange:order=9",
                             "o-moms",
                             "cubic-spline:lobes=2",
                             "cubic-spline:lobes=3",
                             "cubic-spline:lobes=4",
                             "magic-kernel-sharp",
                             "magic-kernel-sharp:version=2013",
                             "blackman-harris"}) {
      const Filter f = make(text);
      CAPTURE(text);
      // 2 R values, each with its error and a rounding of the sum.
      CHECK(ripple(f.kernel()) <= 2 * f.radius() * (f.kernel().k_error() + f.kernel().k_max() * 0x1p-53));
    }
  }

  TEST_CASE("the others have the integral and the ripple that are known of them") {
    struct Known {
      const char* text;
      double integral, ripple;
    };
    // Six and two digits, computed apart from this program.
    for (const Known& known : {Known{"gaussian:preset=oiio", 1.794432, 3.2e-2},
                               {"gaussian:preset=oiio-sharp", 0.882081, 0.166},
                               {"blackman-harris:preset=oiio", 1.07625, 3.3e-2},
                               {"sinc:preset=oiio", 0.902823, 0.108},
                               {"lanczos", 0.997055, 3.0e-3},
                               {"pbrt-sinc", 1.0118, 1.2e-2},
                               {"windowed-sinc:window=kaiser", 0.99943, 7e-4}}) {
      const Filter f = make(known.text);
      CAPTURE(known.text);
      CHECK(f.kernel().integral() == doctest::Approx(known.integral).epsilon(1e-4));
      CHECK(ripple(f.kernel()) == doctest::Approx(known.ripple).epsilon(0.06));
    }
  }

  TEST_CASE("families meet where their definitions do") {
    check_same("lagrange:order=1", "tent");
    check_same("bspline:order=1", "tent");
    check_same("mitchell:b=1,c=0", "bspline");
    check_same("mitchell:b=0,c=0", "hermite");
    check_same("mitchell:b=1.5,c=-0.25", "notch");
    check_same("mitchell:b=0.37821575509399867,c=0.31089212245300067", "robidoux");
    check_same("mitchell:b=0.2620145123990142,c=0.3689927438004929", "robidoux-sharp");
    check_same("keys", "catmull-rom");
    check_same("keys:a=-0.75", "simon");
    check_same("keys:a=-1", "rifman");
    check_same("keys:a=0", "hermite");
    check_same("pbrt-sinc:radius=3,tau=3", "lanczos");
    check_same("windowed-sinc:window=kaiser,beta=0,radius=4", "sinc:radius=4");
    check_same("pbrt-sinc:radius=1,tau=1", "lanczos:a=1");
  }

  TEST_CASE("presets are what they say") {
    check_same("tent:preset=pbrt", "tent:radius=2");
    check_same("blackman-harris:preset=oiio", "blackman-harris:width=3");
    check_same("blackman-harris:preset=cycles", "blackman-harris:width=3");
    check_same("lanczos:preset=imagemagick-sharp", "lanczos:a=3,blur=0.9812505644269356");
    check_same("lanczos:preset=imagemagick2", "lanczos:a=2");
    check_same("lanczos:preset=imagemagick2-sharp", "lanczos:a=2,blur=0.9549963639785485");
    check_same("sinc:preset=oiio", "sinc:radius=2");
    check_same("sinc:preset=imagemagick", "sinc:radius=4");
    check_same("windowed-sinc:preset=imagemagick", "windowed-sinc:radius=4");
    check_same("windowed-sinc:preset=imagemagick,window=welch", "windowed-sinc:radius=3,window=welch");
    check_same("windowed-sinc:preset=imagemagick,window=cosine", "windowed-sinc:radius=3,window=cosine");
    check_same("windowed-sinc:preset=imagemagick,window=kaiser", "windowed-sinc:radius=4,window=kaiser,beta=6.5");
    check_form("sinc:preset=renderman", [](Real x) { return x == 0 ? 1 : std::sin(x) / x; });
    check_form("gaussian:preset=oiio", [](Real x) { return std::exp(-2 * x * x / (1.5L * 1.5L)); });
  }

  TEST_CASE("a preset stands in place of the numbers that it sets") {
    int refused = 0;
    for (const FilterInfo* info : filters()) {
      const auto has_preset = [](const Param& p) { return p.name == "preset"; };
      const auto preset = std::find_if(info->params.begin(), info->params.end(), has_preset);
      if (preset == info->params.end()) continue;
      const std::string name(info->name), choices(preset->choices);
      REQUIRE(choices.starts_with("none|"));
      const std::string first = choices.substr(5, choices.find('|', 5) - 5);
      for (const Param& p : info->params) {
        if (p.kind == Param::Kind::choice) continue;
        const std::string text = name + ":preset=" + first + "," + std::string(p.name) + "=" + shortest(p.fallback);
        CAPTURE(text);
        std::string message;
        try {
          make(text);
        } catch (const Error& e) {
          message = e.what();
        }
        CHECK(message.starts_with("test: filter \"" + name + "\": a preset sets "));
        CHECK(message.find("\"" + std::string(p.name) + "\", not both") != std::string::npos);
        CHECK_NOTHROW(make(name + ":preset=none," + std::string(p.name) + "=" + shortest(p.fallback)));
        ++refused;
      }
    }
    CHECK(refused == 14);
  }

  TEST_CASE("a stretched kernel is the kernel of a stretched distance") {
    const Filter plain = make("mitchell"), narrow = make("mitchell:radius=0.7"), lanczos = make("lanczos"),
                 sharp = make("lanczos:blur=0.75");
    CHECK(narrow.radius() == 0.7);
    CHECK(sharp.radius() == 2.25);
    for (int i = -100; i <= 100; ++i) {
      const double x = 2.9 * i / 100, scale = 2 / 0.7;
      // The stretched position is rounded: an ulp of it times the slope.
      const auto moved = [&](const Filter& f) { return 0x1p-51 * f.kernel().slope_max() * f.radius(); };
      CHECK(std::fabs(narrow.kernel().k(x / scale) - scale * plain.kernel().k(x)) <=
            narrow.kernel().k_error() + scale * (plain.kernel().k_error() + moved(plain)));
      CHECK(std::fabs(sharp.kernel().k(x * 0.75) - lanczos.kernel().k(x) / 0.75) <=
            sharp.kernel().k_error() + 2 * (lanczos.kernel().k_error() + moved(lanczos)));
    }
  }

  TEST_CASE("Lagrange kernels are what local interpolation makes of one sample") {
    for (int order = 1; order <= 9; ++order) {
      check_form("lagrange:order=" + std::to_string(order), [order](Real x) {
        // Interpolate 1 at 0 and 0 elsewhere, at x, from the order + 1 samples around x, by Neville's algorithm.
        const Real middle = order % 2 == 0 ? std::floor(x + 0.5L) : std::floor(x);
        const Real first = middle - static_cast<Real>(order % 2 == 0 ? order / 2 : (order - 1) / 2);
        std::vector<Real> p;
        for (int i = 0; i <= order; ++i) p.push_back(first + i == 0);
        for (int m = 1; m <= order; ++m)
          for (std::size_t i = 0; i + static_cast<std::size_t>(m) <= static_cast<std::size_t>(order); ++i) {
            const Real left = first + static_cast<Real>(i);
            p[i] = ((left + m - x) * p[i] + (x - left) * p[i + 1]) / m;
          }
        return p[0];
      });
    }
    check_form("lagrange", [](Real x) {
      const Real a = std::fabs(x);
      return a < 1 ? (1 - x * x) * (2 - a) / 2 : (1 - a) * (2 - a) * (3 - a) / 6;
    });
  }

  TEST_CASE("interpolating cubic splines are the natural splines through as many samples as they reach") {
    for (std::size_t lobes = 2; lobes <= 4; ++lobes) {
      check_form("cubic-spline:lobes=" + std::to_string(lobes), [lobes](Real x) {
        // Samples at 0 .. 2 lobes - 1; the sample at 0 of the kernel is the one that x is past, seen from the middle.
        const Real cell = std::floor(x);
        std::vector<Real> y(2 * lobes, 0);
        y[static_cast<std::size_t>(static_cast<Real>(lobes) - 1 - cell)] = 1;
        return natural_spline(y, lobes - 1, x - cell);
      });
    }
  }

  TEST_CASE("the cubic o-MOMS has its published pieces") {
    check_form("o-moms", [](Real x) {
      const Real a = std::fabs(x);
      return a < 1 ? a * a * a / 2 - a * a + a / 14 + 13.0L / 21 : -a * a * a / 6 + a * a - 85 * a / 42 + 29.0L / 21;
    });
  }

  TEST_CASE("Magic Kernel Sharp has the pieces that ImageMagick has") {
    check_form("magic-kernel-sharp:version=2013", [](Real x) {
      const Real a = std::fabs(x);
      if (a < 0.5L) return 17.0L / 16 - 7 * a * a / 4;
      if (a < 1.5L) return (1 - a) * (1.75L - a);
      return -(2.5L - a) * (2.5L - a) / 8;
    });
    check_form("magic-kernel-sharp", [](Real x) {
      const Real a = std::fabs(x);
      if (a < 0.5L) return 577.0L / 576 - 239 * a * a / 144;
      if (a < 1.5L) return 35 * (a - 1) * (a - 239.0L / 140) / 36;
      if (a < 2.5L) return (a - 2) * (65.0L / 24 - a) / 6;
      if (a < 3.5L) return (a - 3) * (a - 3.75L) / 36;
      return -(a - 4.5L) * (a - 4.5L) / 288;
    });
  }

  TEST_CASE("windowed sincs are the sinc times their window") {
    // The windows' decimals are doubles, here as in the program.
    const auto cosines = [](const std::vector<double>& a) {
      return [a](Real t) {
        Real sum = 0;
        for (std::size_t m = 0; m < a.size(); ++m)
          sum += static_cast<Real>(a[m]) * std::cos(static_cast<Real>(m) * kPiL * t);
        return sum;
      };
    };
    const auto check = [](const std::string& window, const Form& form) {
      for (const char* radius : {"3", "1", "2.5", "4.75", "16"}) {
        const Real r = std::stold(radius);
        check_form("windowed-sinc:window=" + window + ",radius=" + radius,
                   [&](Real x) { return sinc(x) * form(x / r); });
      }
    };
    check("hann", cosines({0.5, 0.5}));
    check("hamming", cosines({0.54, 0.46}));
    check("blackman", cosines({0.42, 0.5, 0.08}));
    check("blackman-harris", cosines({0.35875, 0.48829, 0.14128, 0.01168}));
    check("welch", [](Real t) { return 1 - t * t; });
    check("bartlett", [](Real t) { return 1 - std::fabs(t); });
    check("cosine", [](Real t) { return std::cos(kPiL * t / 2); });
    check("bohman", [](Real t) {
      const Real a = std::fabs(t);
      return (1 - a) * std::cos(kPiL * a) + std::sin(kPiL * a) / kPiL;
    });
    // The box of a quarter convolved three times with itself; Parzen's form, 2/3 in the middle.
    check("parzen", [](Real t) {
      const Real a = std::fabs(t);
      return (a < 0.5L ? 1 - 6 * a * a * (1 - a) : 2 * (1 - a) * (1 - a) * (1 - a)) * 2 / 3;
    });
    for (const Real beta : {6.5L, 0.5L, 32.0L}) {
      check("kaiser,beta=" + shortest(static_cast<double>(beta)), [&](Real t) {
        return std::cyl_bessel_il(0, beta * std::sqrt(std::fmax(0.0L, 1 - t * t))) / std::cyl_bessel_il(0, beta);
      });
    }
  }
}
