// Square roots by Newton's iteration against the machine's, on the numbers that are hardest to round.
#include "measure/discrepancy/wide_roots.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/hash.h"

#if MOIRE_HAS_AVX

using namespace moire;

namespace {

[[MOIRE_AVX512]] void two_registers(const double* numbers, double* roots) {
  const __m512d a[2] = {_mm512_loadu_pd(numbers), _mm512_loadu_pd(numbers + 8)};
  __m512d root[2];
  square_roots(a, root);
  _mm512_storeu_pd(roots, root[0]);
  _mm512_storeu_pd(roots + 8, root[1]);
}

// Roots of all, sixteen at a time. `other` stands in the registers beside each one and where the last ones end.
std::vector<double> roots_of(std::vector<double> numbers, double other) {
  const std::size_t count = numbers.size();
  numbers.resize((count + 15) / 16 * 16, other);
  std::vector<double> roots(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); i += 16) two_registers(&numbers[i], &roots[i]);
  roots.resize(count);
  return roots;
}

void check(const std::vector<double>& numbers) {
  const std::vector<double> roots = roots_of(numbers, 0.5);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(roots[i]) == std::bit_cast<std::uint64_t>(std::sqrt(numbers[i]))) continue;
    CAPTURE(numbers[i]);
    CHECK(roots[i] == std::sqrt(numbers[i]));
    ++wrong;
  }
  CHECK(wrong == 0);
}

bool is_usable() { return usable_sets() == 3; }

__extension__ typedef unsigned __int128 Wide;

// Numbers a whose root is nearly in the middle between two neighbours m and m + 1 of 53 bits, in units of the last
// place: D = m^2 + m + k, where the middle's square is m^2 + m + 1/4. D must have 53 bits and zeros behind: 2^shift
// divides it, for roots below sqrt 2 with shift = 52 and above with 53. For even k each bit of m follows from the ones
// below it (Hensel), from either value of the first.
std::vector<double> nearly_between() {
  std::vector<double> found;
  for (const int shift : {52, 53}) {
    for (std::int64_t k = -200; k <= 200; k += 2) {
      for (const std::uint64_t first : {0u, 1u}) {
        std::uint64_t m = first;
        for (int bit = 1; bit < shift; ++bit) {
          const std::uint64_t sum = m * m + m + static_cast<std::uint64_t>(k);
          if ((sum >> bit & 1) != 0) m |= std::uint64_t{1} << bit;
        }
        m |= std::uint64_t{1} << 52;  // of 53 bits
        const Wide square = Wide{m} * m + m + static_cast<Wide>(k);
        const Wide bits = square >> shift;
        if (bits << shift != square || bits >> 53 != 0 || bits >> 52 == 0) continue;
        const double a = static_cast<double>(static_cast<std::uint64_t>(bits));
        for (const int exponent : {0, -100, -900, 100}) found.push_back(std::ldexp(a, shift + exponent));
      }
    }
  }
  return found;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("wide square roots are the machine's for random numbers of all sizes") {
    if (!is_usable()) return;
    const Key key = pixel_key(draw_hash(5, 0), {});
    std::vector<double> numbers;
    for (std::uint32_t i = 0; i < 400000; ++i) {
      const Words w = hash(key, i, Axis::xy, 0);
      const double u = unit(w.a, w.b);
      numbers.push_back(i % 2 == 0 ? u : std::ldexp(1 + u, -static_cast<int>(w.c % 1000)));
    }
    check(numbers);
  }

  TEST_CASE("wide square roots are the machine's where a root is nearly halfway between two numbers") {
    if (!is_usable()) return;
    const std::vector<double> numbers = nearly_between();
    // Of each shift and k two, less those out of range: about half.
    REQUIRE(numbers.size() > 500);
    std::size_t near = 0;
    for (const double a : numbers) {
      // In units of the last place of the root: the residual of a middle is m to 2^-53 of it.
      const double root = std::sqrt(a), off = std::fma(-root, root, a);
      const double place = std::nextafter(root, std::numeric_limits<double>::infinity()) - root;
      if (std::fabs(std::fabs(off) / (root * place) - 1) < 0x1p-40) ++near;
    }
    CHECK(near == numbers.size());
    check(numbers);
  }

  TEST_CASE("wide square roots are the machine's at squares, beside them, and at the ends of the range") {
    if (!is_usable()) return;
    std::vector<double> numbers = {0.0, 1.0, 2.0, 0x1p-1022, 0x1p-1074, 0x1.8p-1060, 0x1p-900, 0x1.8p-901, 0x1p-960};
    for (int i = 1; i < 2000; ++i) {
      const double square = static_cast<double>(i) * i * 0x1p-22;
      for (const double a : {square, std::nextafter(square, 0.0), std::nextafter(square, 3.0)}) numbers.push_back(a);
    }
    for (int e = -1022; e < 1; ++e)
      for (const double a : {std::ldexp(1.0, e), std::nextafter(std::ldexp(1.0, e), 0.0)}) numbers.push_back(a);
    check(numbers);
  }
}

#endif
