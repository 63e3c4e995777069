// Pictures of spectra: what each power looks like, and what the file says of its scale.
#include "reports/spectrum_preview.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "reports/preview.h"

using namespace moire;

namespace {

std::string text_of(const Raster& raster, const std::string& keyword) {
  for (const auto& [key, text] : raster.text)
    if (key == keyword) return text;
  return "(none)";
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("on the linear scale random points' power looks like a middle grey and four times that is white") {
    const std::vector<float> power = {0, 1, 4, 5, 1e30F, 0.25F, 1, 2, 1};
    const Raster raster = spectrum_preview({3, 3}, power, PowerScale::linear);
    REQUIRE(raster.channels == 1);
    CHECK(raster.pixels ==
          std::vector<std::uint8_t>{0, srgb8(0.25), 255, 255, 0, srgb8(0.0625), srgb8(0.25), srgb8(0.5), srgb8(0.25)});
    CHECK(text_of(raster, "moire:kind") == "spectrum");
    CHECK(text_of(raster, "moire:scale") == "linear");
    CHECK(text_of(raster, "moire:range") == "0 4");
    CHECK(text_of(raster, "moire:dc") == "blanked");
    CHECK(text_of(raster, "moire:clipped") == "1");  // zero frequency, in the middle, is not counted
    CHECK(text_of(raster, "moire:nan") == "0");
  }

  TEST_CASE("on the logarithmic scale six powers of ten below the largest are black to white") {
    // 4 x 2: zero frequency at column 2, row 1.
    const std::vector<float> power = {1000, 1, 0.001F, 1e-4F, 0, -1, 1e30F, 1000};
    const Raster raster = spectrum_preview({4, 2}, power, PowerScale::logarithmic);
    CHECK(raster.pixels == std::vector<std::uint8_t>{255, 128, 0, 0, 0, 0, 0, 255});
    CHECK(text_of(raster, "moire:scale") == "log10");
    CHECK(text_of(raster, "moire:range") == "0.001 1000");
    CHECK(text_of(raster, "moire:clipped") == "0");
  }

  TEST_CASE("no power at all is black, and NaN is magenta") {
    for (const PowerScale scale : {PowerScale::linear, PowerScale::logarithmic}) {
      const Raster black = spectrum_preview({2, 2}, std::vector<float>(4, 0.0F), scale);
      CHECK(black.pixels == std::vector<std::uint8_t>(4, 0));
      const float nan = std::numeric_limits<float>::quiet_NaN();
      const Raster raster = spectrum_preview({3, 1}, std::vector<float>{nan, 7, 8}, scale);
      CHECK(raster.pixels == std::vector<std::uint8_t>{255, 0, 255, 0, 0, 0, 255, 255, 255});
      CHECK(text_of(raster, "moire:nan") == "1");
    }
  }

  TEST_CASE("decoding inverts the sRGB transfer function at every code") {
    for (int code = 0; code < 256; ++code) CHECK(srgb8(linear_of_srgb8(static_cast<std::uint8_t>(code))) == code);
    CHECK(linear_of_srgb8(255) == 1);
    CHECK(linear_of_srgb8(0) == 0);
  }
}
