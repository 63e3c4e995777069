// Previews: exact neutral zero, symmetric ends, honest counts.
#include "reports/preview.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

namespace moire {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Rgb pixel(const Raster& raster, std::size_t i) {
  return {raster.pixels[3 * i], raster.pixels[3 * i + 1], raster.pixels[3 * i + 2]};
}

std::string text(const Raster& raster, const std::string& keyword) {
  for (const auto& [key, value] : raster.text) {
    if (key == keyword) return value;
  }
  return "(none)";
}

// Relative luminance of an 8-bit sRGB colour, 0 to 1.
double luminance(const Rgb& c) {
  const auto linear = [](std::uint8_t v) {
    return v <= 10 ? v / 255.0 / 12.92 : std::pow((v / 255.0 + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}

TEST_SUITE("unit") {
  TEST_CASE("the sRGB transfer meets the standard's fixed points, is monotonic and inverts") {
    CHECK(srgb8(0) == 0);
    CHECK(srgb8(1) == 255);
    CHECK(srgb8(-3) == 0);
    CHECK(srgb8(7) == 255);
    CHECK(srgb8(0.5) == 188);   // 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354 of 255
    CHECK(srgb8(0.18) == 118);  // middle grey: 0.4614 of 255
    for (int v = 0; v < 256; ++v) {
      const double s = v / 255.0;
      CHECK(srgb8(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4)) == v);
    }
    for (int i = 1; i <= 10000; ++i) REQUIRE(srgb8(i / 1e4) >= srgb8((i - 1) / 1e4));
  }

  TEST_CASE("zero is a neutral light grey, both ends are as dark, and lightness falls evenly towards them") {
    const Rgb zero = diverging_colour(0), low = diverging_colour(-1), high = diverging_colour(1);
    CHECK(zero[0] == zero[1]);
    CHECK(zero[1] == zero[2]);
    CHECK(zero[0] > 200);
    CHECK(low[2] > low[0]);
    CHECK(high[0] > high[2]);
    CHECK(diverging_colour(-5) == low);
    CHECK(diverging_colour(5) == high);
    // Ends of equal lightness: L* differs by less than 3, of which the eye sees about 1.
    const auto lightness = [](const Rgb& c) { return 116 * std::cbrt(luminance(c)) - 16; };
    CHECK(std::fabs(lightness(low) - lightness(high)) < 3);
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i < 100; ++i) {
        const double here = lightness(diverging_colour(side * i / 100));
        const double next = lightness(diverging_colour(side * (i + 1) / 100));
        // The whole way is about 50 of L*, in 100 steps; a colour's rounding to 8 bits is worth up to 0.4 of them.
        CHECK(next < here + 0.4);
        CHECK(next > here - 1.3);
      }
    }
    CHECK(diverging_colour(0.5) != diverging_colour(-0.5));
  }

  TEST_CASE(
      "an error of zero is exactly neutral, +range and -range are the map's ends, beyond is clipped and counted") {
    const std::vector<float> error{0.0f, -0.0f, 0.25f, -0.25f, 0.5f, -0.5f, 1.0f, -1e30f, 0.125f, -0.125f};
    const Raster raster = error_preview({10, 1}, error, 0.5);
    CHECK(raster.channels == 3);
    CHECK(pixel(raster, 0) == diverging_colour(0));
    CHECK(pixel(raster, 1) == diverging_colour(0));
    CHECK(pixel(raster, 4) == diverging_colour(1));
    CHECK(pixel(raster, 5) == diverging_colour(-1));
    CHECK(pixel(raster, 6) == diverging_colour(1));
    CHECK(pixel(raster, 7) == diverging_colour(-1));
    // Linear: half the range lies half way, to the nearest of 255 steps.
    CHECK(pixel(raster, 2) == diverging_colour(128.0 / 255));
    CHECK(pixel(raster, 3) == diverging_colour(-128.0 / 255));
    CHECK(pixel(raster, 8) == diverging_colour(64.0 / 255));
    CHECK(text(raster, "moire:range") == "0.5");
    CHECK(text(raster, "moire:range_is") == "p99.5 of |error| over active pixels");
    CHECK(text(raster, "moire:clipped") == "2");
    CHECK(text(raster, "moire:nan") == "0");
  }

  TEST_CASE("NaN is magenta and counted, in both kinds") {
    const std::vector<float> values{0.25f, kNan};
    const Raster error = error_preview({2, 1}, values, 1);
    CHECK(pixel(error, 1) == kNanColour);
    CHECK(text(error, "moire:nan") == "1");
    const Raster image = reconstruction_preview({2, 1}, values);
    CHECK(image.channels == 3);
    CHECK(pixel(image, 1) == kNanColour);
    CHECK(pixel(image, 0) == Rgb{srgb8(0.25), srgb8(0.25), srgb8(0.25)});
    CHECK(text(image, "moire:nan") == "1");
    CHECK(text(image, "moire:clipped") == "0");
  }

  TEST_CASE("an image without error is neutral all over, and few errors still show") {
    const std::vector<float> none(6, 0.0f);
    const Raster clean = error_preview({3, 2}, none, 0);
    for (std::size_t i = 0; i < 6; ++i) CHECK(pixel(clean, i) == diverging_colour(0));
    CHECK(text(clean, "moire:range") == "0");

    std::vector<float> one = none;
    one[4] = -0.125f;
    for (const double range : {0.0, static_cast<double>(kNan)}) {
      const Raster raster = error_preview({3, 2}, one, range);
      CHECK(pixel(raster, 4) == diverging_colour(-1));
      CHECK(pixel(raster, 3) == diverging_colour(0));
      CHECK(text(raster, "moire:range") == "0.125");
      CHECK(text(raster, "moire:range_is") == "max |error|");
    }
  }

  TEST_CASE("a reconstruction's clipped pixels are counted, and only those outside 0 to 1") {
    const std::vector<float> values{0.0f, 1.0f, -0.0f, -1e-6f, 1.000001f, 0.5f, 1.2f, -0.1f};
    const Raster raster = reconstruction_preview({4, 2}, values);
    CHECK(raster.channels == 1);
    CHECK(raster.pixels == std::vector<std::uint8_t>{0, 255, 0, 0, 255, 188, 255, 0});
    CHECK(text(raster, "moire:clipped") == "4");
    CHECK(text(raster, "moire:transfer") == "sRGB");
  }
}

}  // namespace
}  // namespace moire
