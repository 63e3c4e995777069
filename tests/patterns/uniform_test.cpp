// Uniform numbers: with every instruction set those that hash() gives one at a time.
#include "patterns/uniform.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace moire;

TEST_SUITE("unit") {
  TEST_CASE("uniform numbers are the same bits with every instruction set, for any count, and those of hash()") {
    const Key key = pixel_key(draw_hash(3, 1), {5, -2});
    constexpr std::uint32_t kPart = 9, kLow = 0xFFFF'0000u;
    // Below, at and above the widths of registers, 4, 8 and 16 words.
    for (const std::size_t n : {0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 15u, 16u, 17u, 20u, 31u, 33u, 64u, 299u}) {
      CAPTURE(n);
      std::vector<double> x(n), y(n), t(n);
      std::vector<std::uint64_t> bits(n);
      for (std::uint32_t i = 0; i < n; ++i) {
        const Words xy = hash(key, kLow + i, Axis::area, kPart), once = hash(key, i, Axis::time),
                    order = hash(key, kLow + i, Axis::order);
        x[i] = unit(xy.a, xy.b);
        y[i] = unit(xy.c, xy.d);
        t[i] = unit(once.a, once.b);
        bits[i] = std::uint64_t{order.a} << 32 | order.b;
      }
      // One number more, which must stay.
      const auto same = [n](const auto& got, const auto& expected) {
        return got.back() == 7 && std::equal(expected.begin(), expected.end(), got.begin()) && got.size() == n + 1;
      };
      for (const UniformKernel& kernel : uniform_kernels()) {
        std::vector<double> u(n + 1, 7), v(n + 1, 7), w(n + 1, 7);
        std::vector<std::uint64_t> b(n + 1, 7);
        kernel.points(key, Axis::area, kPart, kLow, n, u.data(), v.data());
        kernel.times(key, Axis::time, {w.data(), n});
        kernel.bits(key, Axis::order, kLow, {b.data(), n});
        CHECK(same(u, x));
        CHECK(same(v, y));
        CHECK(same(w, t));
        CHECK(same(b, bits));
      }
      std::vector<double> u(n + 1, 7), v(n + 1, 7);
      uniform_points(key, Axis::area, std::uint64_t{kPart} << 32 | kLow, static_cast<int>(n), u.data(), v.data());
      CHECK(same(u, x));
      CHECK(same(v, y));
    }
  }

  TEST_CASE("an integer from 64 bits is the product's leading part") {
    for (const std::uint64_t bits :
         {std::uint64_t{0}, std::uint64_t{1} << 63, ~std::uint64_t{0}, 0x0123456789ABCDEFu}) {
      for (const std::uint32_t bound : {1u, 2u, 3u, 1000u, 1u << 29}) {
        const auto high = static_cast<std::uint32_t>(bits >> 32), low = static_cast<std::uint32_t>(bits);
        __extension__ using Wide = unsigned __int128;
        CHECK(uniform_below(bits, bound) == static_cast<std::int32_t>((Wide{bits} * bound) >> 64));
        CHECK(uniform_below(high, low, bound) == uniform_below(bits, bound));
      }
    }
  }
}
