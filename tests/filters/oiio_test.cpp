// Our kernels against those of OpenImageIO's Filter1D and Filter2D (src/libutil/filter.cpp, version 2.4), which are not
// normalised and computed in float: an interoperability test, entry by entry. Also what its table says wrongly.
#include <OpenImageIO/filter.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "filters/filter.h"

namespace moire {
namespace {

struct Destroy {
  void operator()(OIIO::Filter1D* f) const { OIIO::Filter1D::destroy(f); }
  void operator()(OIIO::Filter2D* f) const { OIIO::Filter2D::destroy(f); }
};
using Filter1 = std::unique_ptr<OIIO::Filter1D, Destroy>;
using Filter2 = std::unique_ptr<OIIO::Filter2D, Destroy>;

// Null for a name that it does not know. `width` is full, in pixels.
Filter1 filter_1d(const std::string& name, float width) { return Filter1(OIIO::Filter1D::create(name, width)); }
Filter2 filter_2d(const std::string& name, float width) { return Filter2(OIIO::Filter2D::create(name, width, width)); }

// One entry of OpenImageIO's table and the filter of ours that means the same kernel at its default width.
struct Entry {
  std::string name;
  float width;       // the default of its table, full
  std::string ours;  // "" where no separable filter means it
  // k(0), and the integral of k as far as float tells: the factors between its kernel and ours.
  double peak, integral;
  // The largest distance of its float arithmetic from the kernel that it means, at its own scale, as measured with
  // version 2.4.7; the reason stands beside it.
  double error;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {"box", 1, "box", 1, 1, 0},
      {"triangle", 2, "tent", 1, 1, 4e-8},  // 1 - t, t rounded once: less than one rounding of 2^-24
      // Its fast_exp, a polynomial good to 7e-6.
      {"gaussian", 3, "gaussian:preset=oiio", 1, 1.794432, 6.9e-6},
      {"sharp-gaussian", 2, "gaussian:preset=oiio-sharp", 1, 0.882081, 6.9e-6},
      // Terms up to 16 in a polynomial that ends at 0: up to 33 roundings.
      {"catmull-rom", 4, "catmull-rom", 2, 2, 2e-6},
      // pi x / R is rounded once for all three cosines, at the ends of the table by 4e-7.
      {"blackman-harris", 3, "blackman-harris:preset=oiio", 1, 1.07625, 5e-7},
      {"sinc", 4, "sinc:preset=oiio", 1, 0.902823, 1e-7},  // pi x rounded, then a sine and a quotient
      {"lanczos3", 6, "lanczos", 1, 0.997055, 4e-7},       // and its scale of 3 to and fro
      {"nuke-lanczos6", 6, "lanczos", 1, 0.997055, 4e-7},
      {"radial-lanczos3", 6, "", 1, 0, 0},
      {"mitchell", 4, "mitchell", 8.0 / 9, 1, 1.2e-6},  // terms up to 19 in a polynomial that ends at 0
      {"bspline", 4, "bspline", 2.0 / 3, 1, 7e-8},
      {"disk", 1, "", 1, 0, 0},
      {"cubic", 4, "hermite", 1, 1, 1.1e-6},  // terms up to 20 a in a polynomial that ends at 0
      {"keys", 4, "keys", 1, 1, 1.1e-6},
      {"simon", 4, "simon", 1, 1, 1.1e-6},
      {"rifman", 4, "rifman", 1, 1, 1.1e-6},
  };
  return all;
}

// 2^10 steps a pixel: exact in float, as are the sums below. From -R to R, the ends left out: whether a closed or a
// half-open interval is meant is asked elsewhere.
std::vector<double> dense(double radius) {
  std::vector<double> x;
  for (double at = -radius + 0x1p-10; at < radius; at += 0x1p-10) x.push_back(at);
  return x;
}

// Our kernel at the scale of theirs, which has that value at 0.
double scaled(const Kernel& k, const Entry& e, double x) { return k.k(x) / k.k(0) * e.peak; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("every filter of OpenImageIO has an entry here, at the default width of its table") {
    std::vector<std::string> covered;
    for (const Entry& e : entries()) covered.push_back(e.name);
    for (int i = 0; i < OIIO::Filter2D::num_filters(); ++i) {
      const OIIO::FilterDesc& d = OIIO::Filter2D::get_filterdesc(i);
      CAPTURE(std::string(d.name));  // not covered by this test when the next check fails
      const auto entry =
          std::find_if(entries().begin(), entries().end(), [&](const Entry& e) { return e.name == d.name; });
      REQUIRE(entry != entries().end());
      CHECK(d.width == entry->width);
      std::erase(covered, entry->name);
    }
    for (int i = 0; i < OIIO::Filter1D::num_filters(); ++i) {
      const OIIO::FilterDesc& d = OIIO::Filter1D::get_filterdesc(i);
      CAPTURE(std::string(d.name));
      const auto entry =
          std::find_if(entries().begin(), entries().end(), [&](const Entry& e) { return e.name == d.name; });
      REQUIRE(entry != entries().end());
      CHECK(d.width == entry->width);
    }
    for (const std::string& gone : covered) {
      CAPTURE(gone);
      CHECK(false);
    }
  }

  TEST_CASE("kernels in one dimension agree with OpenImageIO's to the error of its float arithmetic") {
    for (const Entry& e : entries()) {
      if (e.ours.empty()) continue;
      CAPTURE(e.name);
      const Filter ours(parse_spec(e.ours, "test"));
      const Kernel& k = ours.kernel();
      // Hermite's cubic ends at 1, though the table says 2.
      const double radius = static_cast<double>(e.width) / 2;
      CHECK(k.radius() == (e.name == "cubic" ? 1 : radius));
      const Filter1 f = filter_1d(e.name, e.width);
      REQUIRE(f);
      double worst = 0, sum = 0;
      for (const double x : dense(radius)) {
        const double theirs = static_cast<double>((*f)(static_cast<float>(x)));
        worst = std::max(worst, std::fabs(theirs - scaled(k, e, x)));
        sum += theirs * 0x1p-10;
      }
      CHECK(worst <= e.error);
      MESSAGE(e.name << " = " << e.ours << ": largest difference " << worst);
      // The trapezoidal rule with kernels cut to zero at both ends: half a step of k(R) and h^2 of its slope there.
      CHECK(sum == doctest::Approx(e.integral).epsilon(1e-3));
      // Ours is the same integral, which is what a peak of the normalised kernel says.
      CHECK(1 / k.k(0) * e.peak == doctest::Approx(e.integral).epsilon(2e-6));
    }
  }

  TEST_CASE("kernels in two dimensions are OpenImageIO's products, to twice the error in one") {
    for (const Entry& e : entries()) {
      if (e.ours.empty()) continue;
      CAPTURE(e.name);
      const Filter ours(parse_spec(e.ours, "test"));
      const Kernel& k = ours.kernel();
      const Filter2 f = filter_2d(e.name, e.width);
      REQUIRE(f);
      CHECK(f->separable());
      const double radius = static_cast<double>(e.width) / 2;
      double worst = 0;
      // 2^-4 apart and off the lattice, so that no point lies on a knot by itself.
      for (double y = -radius + 0x1p-6; y < radius; y += 0x1p-4)
        for (double x = -radius + 0x1p-6; x < radius; x += 0x1p-4) {
          const double theirs = static_cast<double>((*f)(static_cast<float>(x), static_cast<float>(y)));
          worst = std::max(worst, std::fabs(theirs - scaled(k, e, x) * scaled(k, e, y)));
        }
      CHECK(worst <= 2 * e.error * e.peak + 0x1p-22);  // and the rounding of a product of up to 4
    }
  }

  TEST_CASE("OpenImageIO: the box is closed at both ends, so that two neighbours count a sample between them") {
    const Filter1 f = filter_1d("box", 1);
    CHECK((*f)(-0.5f) == 1);
    CHECK((*f)(0.5f) == 1);
    const Filter box(parse_spec("box", "test"));
    CHECK(box.kernel().k(-0.5) == 1);
    CHECK(box.kernel().k(0.5) == 0);
  }

  TEST_CASE("OpenImageIO: sharp-gaussian calls itself gaussian, and bspline b-spline") {
    CHECK(filter_2d("sharp-gaussian", 2)->name() == "gaussian");
    CHECK(filter_1d("sharp-gaussian", 2)->name() == "gaussian");
    CHECK(filter_2d("bspline", 4)->name() == "b-spline");
    CHECK(filter_1d("bspline", 4)->name() == "b-spline");
  }

  TEST_CASE("OpenImageIO: nuke-lanczos6 is lanczos3, and separable though its table says not") {
    const Filter2 nuke = filter_2d("nuke-lanczos6", 6), plain = filter_2d("lanczos3", 6);
    CHECK(nuke->name() == "lanczos3");
    CHECK(nuke->separable());
    for (int i = 0; i < OIIO::Filter2D::num_filters(); ++i) {
      const OIIO::FilterDesc& d = OIIO::Filter2D::get_filterdesc(i);
      if (std::string(d.name) == "nuke-lanczos6") CHECK_FALSE(d.separable);
    }
    for (const float x : {0.0f, 0.25f, 1.5f, 2.75f}) CHECK((*nuke)(x, 0.5f) == (*plain)(x, 0.5f));
  }

  TEST_CASE("OpenImageIO: radial-lanczos3 is a function of the distance, and no product") {
    const Filter2 f = filter_2d("radial-lanczos3", 6);
    CHECK_FALSE(f->separable());
    const double d = std::numbers::pi * std::numbers::sqrt2;
    const double lanczos = std::sin(d) / d * std::sin(d / 3) / (d / 3);  // at distance sqrt 2: -0.1459
    // Its error in float, 4e-7 of the peak (1), is 3e-6 of this value.
    CHECK(static_cast<double>((*f)(1, 1)) == doctest::Approx(lanczos).epsilon(4e-6));
    // Its factors are those of the separable kernel, both zero there: their product is another filter.
    CHECK(std::fabs(f->xfilt(1) * f->yfilt(1)) < 1e-13f);
    CHECK(std::fabs((*filter_2d("lanczos3", 6))(1, 1)) < 1e-13f);
  }

  TEST_CASE("OpenImageIO: cubic is Hermite's smoothstep, zero from 1 on though its width is 4") {
    const Filter1 f = filter_1d("cubic", 4);
    CHECK(f->width() == 4);
    CHECK((*f)(0.5f) == 0.5f);
    // a (z^3 - 5 z^2 + 8 z - 4) with a = 0: zero of either sign.
    for (const double x : dense(2))
      if (std::fabs(x) >= 1) CHECK((*f)(static_cast<float>(x)) == 0);
  }

  TEST_CASE("OpenImageIO: the width of sinc truncates, though its table calls it scalable") {
    const Filter1 narrow = filter_1d("sinc", 4), wide = filter_1d("sinc", 8);
    for (const double x : dense(2)) CHECK((*narrow)(static_cast<float>(x)) == (*wide)(static_cast<float>(x)));
    CHECK((*narrow)(2.5f) == 0);
    CHECK((*wide)(2.5f) == doctest::Approx(2 / (5 * std::numbers::pi)).epsilon(1e-6));
    for (int i = 0; i < OIIO::Filter1D::num_filters(); ++i) {
      const OIIO::FilterDesc& d = OIIO::Filter1D::get_filterdesc(i);
      if (std::string(d.name) == "sinc") CHECK(d.scalable);
    }
    // Of the wide ones whose width is a scale: k(x; 2 w) = k(x / 2; w).
    const Filter1 lanczos = filter_1d("lanczos3", 6), stretched = filter_1d("lanczos3", 12);
    for (const double x : dense(2)) {
      const double a = static_cast<double>((*lanczos)(static_cast<float>(x)));
      CHECK(static_cast<double>((*stretched)(static_cast<float>(2 * x))) == doctest::Approx(a).epsilon(1e-6));
    }
  }

  TEST_CASE("OpenImageIO: the peak and the integral of catmull-rom are 2, and its width is always 4 in one dimension") {
    CHECK((*filter_1d("catmull-rom", 4))(0) == 2);
    CHECK((*filter_2d("catmull-rom", 4))(0, 0) == 4);
    CHECK(filter_1d("catmull-rom", 8)->width() == 4);
    CHECK((*filter_1d("keys", 4))(0) == 1);
  }

  TEST_CASE("OpenImageIO: disk is open and radial, without a filter of ours") {
    const Filter2 f = filter_2d("disk", 1);
    CHECK_FALSE(f->separable());
    CHECK((*f)(0.5f, 0) == 0);
    CHECK((*f)(0.25f, 0.25f) == 1);
    CHECK((*f)(0.375f, 0.375f) == 0);
  }
}

}  // namespace moire
