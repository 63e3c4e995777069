// Halves, planes, gzip and base64 of a page's images, against their definitions.
#include "reports/page_encoding.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "reports/gzip.h"
#include "reports/page_reading.h"

namespace moire {
namespace {

std::vector<double> decoded(const EncodedPixels& image) {
  return page::pixel_values({{"type", image.half ? "f16" : "f32"},
                             {"shuffle", image.shuffle},
                             {"gzip", image.gzip},
                             {"scale", image.scale},
                             {"data", image.data}});
}

std::string noise(std::size_t size, std::uint32_t seed) {
  std::mt19937 bits(seed);
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(bits() & 0xffU);
  return bytes;
}

TEST_SUITE("unit") {
  TEST_CASE("every half is its own nearest half") {
    for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
      const auto half = static_cast<std::uint16_t>(bits);
      const double value = page::half_value(half);
      if (std::isnan(value)) {
        CHECK(std::isnan(page::half_value(half_bits(static_cast<float>(value)))));
      } else if (half_bits(static_cast<float>(value)) != half) {
        FAIL_CHECK("half " << bits);
      }
    }
  }

  TEST_CASE("between two halves the nearer one is taken, and in the middle the even one") {
    // Neighbours with at most 11 bits have their middle among the floats, subnormal ones too.
    for (std::uint32_t bits = 0; bits < 0x7c00; ++bits) {
      const auto low = static_cast<std::uint16_t>(bits), high = static_cast<std::uint16_t>(bits + 1);
      // The largest half is as far from infinity as if the next power of two stood there.
      const double above = bits + 1 == 0x7c00 ? 65536 : page::half_value(high);
      const auto middle = static_cast<float>((page::half_value(low) + above) / 2);
      const std::uint16_t even = bits % 2 == 0 ? low : high;
      const bool right = half_bits(middle) == even && half_bits(std::nextafter(middle, 0.0F)) == low &&
                         half_bits(std::nextafter(middle, HUGE_VALF)) == high && half_bits(-middle) == (even | 0x8000);
      if (!right) FAIL_CHECK("half " << bits);
    }
    CHECK(half_bits(65519.996F) == 0x7bff);
    CHECK(half_bits(65520.0F) == 0x7c00);
    CHECK(half_bits(std::numeric_limits<float>::max()) == 0x7c00);
    CHECK(half_bits(std::numeric_limits<float>::denorm_min()) == 0);
    CHECK(half_bits(-0.0F) == 0x8000);
  }

  TEST_CASE("planes hold the bytes of each place together") {
    CHECK(shuffled("a1b2c3", 2) == "abc123");
    CHECK(shuffled("a12xb34y", 4) == "ab1324xy");
    CHECK(shuffled("", 4).empty());
  }

  TEST_CASE("base64 is that of the RFC's examples") {
    const char* kPairs[][2] = {{"", ""},
                               {"f", "Zg=="},
                               {"fo", "Zm8="},
                               {"foo", "Zm9v"},
                               {"foob", "Zm9vYg=="},
                               {"fooba", "Zm9vYmE="},
                               {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : kPairs) CHECK(base64(bytes) == text);
    const std::string all("\x00\x10\x83\x10\x51\x87\x20\x92\x8b\x30\xd3\x8f\xff\xff\xff", 15);
    CHECK(base64(all) == "ABCDEFGHIJKLMNOP////");
  }

  TEST_CASE("gzip and base64 give back every byte, and gzip has no time") {
    for (std::size_t size = 0; size < 200; ++size) {
      const std::string bytes = noise(size, static_cast<std::uint32_t>(size)), packed = gzip(bytes);
      CHECK(page::gunzip(packed) == bytes);
      CHECK(page::from_base64(base64(bytes)) == bytes);
      CHECK(packed.substr(0, 8) == std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00", 8));  // RFC 1952: no flags, mtime 0
    }
    const std::string large = noise(300'000, 1) + std::string(300'000, 'a');  // more than one block of output
    CHECK(page::gunzip(gzip(large)) == large);
    CHECK(gzip(large) == gzip(large));
  }

  TEST_CASE("exact images keep every bit, whatever their bytes are like") {
    const Grid grid{16, 4};
    for (const int kind : {0, 1, 2}) {
      std::vector<float> values;
      std::mt19937 bits(7);
      for (int i = 0; i < 64; ++i) {
        values.push_back(kind == 0 ? 0.0F : kind == 1 ? static_cast<float>(bits()) * 0x1p-32F : static_cast<float>(i));
      }
      const EncodedPixels image = encode_floats(grid, values);
      CHECK(image.grid == grid);
      const std::vector<double> back = decoded(image);
      REQUIRE(back.size() == values.size());
      for (std::size_t i = 0; i < values.size(); ++i) CHECK(back[i] == static_cast<double>(values[i]));
    }
  }

  TEST_CASE("errors of any size keep eleven bits down to a 2^-28th of the largest") {
    for (const int exponent : {-140, -126, -60, -20, -1, 0, 10, 100, 127}) {
      std::vector<float> values;
      for (int i = 0; i < 60; ++i) {
        // From the largest down by powers of two, with all bits in use and both signs.
        values.push_back(std::ldexp(i % 2 == 0 ? 1.2345678F : -1.9999999F, exponent - (i + 1) / 2));
      }
      const EncodedPixels image = encode_halves({60, 1}, values);
      int power = 0;
      CHECK(std::frexp(image.scale, &power) == 0.5);
      const std::vector<double> back = decoded(image);
      const double largest = std::fabs(static_cast<double>(values[1]));
      for (std::size_t i = 0; i < values.size(); ++i) {
        const double value = static_cast<double>(values[i]), error = std::fabs(back[i] - value);
        // Half a unit in the last of 11 bits; below, half of the smallest half, 2^-25, where the largest is above 2^14.
        CHECK(error <=
              std::max(std::fabs(value) * 0x1p-11, std::fabs(value) < largest * 0x1p-28 ? largest * 0x1p-39 : 0));
      }
    }
  }

  TEST_CASE("a mean square of encoded errors is right to a hundred-thousandth") {
    // Each of 65536 errors is off by up to 2^-12 of itself, at random: the mean by some 2 x 2^-12 / sqrt(3 x 65536).
    std::mt19937 bits(3);
    std::normal_distribution<float> normal(0, 1e-5F);
    std::vector<float> values(65536);
    for (float& v : values) v = normal(bits);
    double exact = 0, got = 0;
    for (const float v : values) exact += static_cast<double>(v) * static_cast<double>(v);
    for (const double v : decoded(encode_halves({256, 256}, values))) got += v * v;
    CHECK(std::fabs(got / exact - 1) < 1e-5);
  }

  TEST_CASE("images of zeros and of what is no number are stored as they are") {
    const std::vector<float> values = {0.0F, -0.0F, HUGE_VALF, -HUGE_VALF, std::nanf(""), 0.5F};
    const std::vector<double> back = decoded(encode_halves({6, 1}, values));
    CHECK(back[0] == 0);
    CHECK(back[2] == HUGE_VAL);
    CHECK(back[3] == -HUGE_VAL);
    CHECK(std::isnan(back[4]));
    CHECK(back[5] == 0.5);
    CHECK(encode_halves({2, 1}, std::vector<float>{0.0F, 0.0F}).scale == 1);
  }
}

}  // namespace
}  // namespace moire
