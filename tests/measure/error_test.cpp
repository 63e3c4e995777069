// Errors of images in numbers, against brute force.
#include "measure/error.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace moire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct PixelPair {
  std::int64_t x, y;
  double got, want;
};

// An image of which a share of the pixels is wrong, errors spread over many orders of magnitude.
std::vector<PixelPair> image(int width, int height, double share_wrong, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<PixelPair> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double want = unit(random);
      const double error = (unit(random) - 0.5) * std::pow(10.0, -12 * unit(random));
      pixels.push_back({x, y, unit(random) < share_wrong ? want + error : want, want});
    }
  }
  return pixels;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

void check_same_bits(const Errors& a, const Errors& b) {
  CHECK(a.n_pixels == b.n_pixels);
  CHECK(a.nan_count == b.nan_count);
  CHECK(a.outside_tolerance == b.outside_tolerance);
  CHECK(a.max_x == b.max_x);
  CHECK(a.max_y == b.max_y);
  for (const auto field : {&Errors::bias, &Errors::mae, &Errors::mse, &Errors::rmse, &Errors::max_abs, &Errors::max_got,
                           &Errors::max_want, &Errors::p50, &Errors::p90, &Errors::p95, &Errors::p99, &Errors::p995}) {
    CHECK(same_bits(a.*field, b.*field));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("pixels known to be exact may be counted instead of added, bit for bit in every field") {
    for (const double share : {0.0, 0.003, 0.1, 0.6, 1.0}) {
      CAPTURE(share);
      const auto pixels = image(37, 29, share, 1);
      ErrorTally every, wrong_only;
      std::int64_t exact = 0;
      for (const auto& p : pixels) {
        every.add(p.x, p.y, p.got, p.want);
        if (p.got == p.want) {
          ++exact;
        } else {
          wrong_only.add(p.x, p.y, p.got, p.want);
        }
      }
      wrong_only.add_exact(exact);
      check_same_bits(every.finish(), wrong_only.finish());
    }
  }

  TEST_CASE("means agree with sums in long double") {
    const auto pixels = image(61, 40, 0.3, 2);
    ErrorTally tally;
    long double sum = 0, abs = 0, squared = 0;
    std::int64_t outside = 0;
    for (const auto& p : pixels) {
      tally.add(p.x, p.y, p.got, p.want);
      const double e = p.got - p.want;
      sum += static_cast<long double>(e);
      abs += std::fabs(static_cast<long double>(e));
      squared += static_cast<long double>(e) * static_cast<long double>(e);
      outside += std::fabs(e) > 0.5 / 255;
    }
    const Errors e = tally.finish();
    const auto n = static_cast<long double>(pixels.size());
    // Each sum is compensated, row by row and over rows: a few ulp of the mean |error|, the bias of cancelling terms
    // too.
    const double tolerance = 4 * std::numeric_limits<double>::epsilon();
    CHECK(std::fabs(e.bias - static_cast<double>(sum / n)) <= tolerance * e.mae);
    CHECK(std::fabs(e.mae - static_cast<double>(abs / n)) <= tolerance * e.mae);
    CHECK(std::fabs(e.mse - static_cast<double>(squared / n)) <= tolerance * e.mse);
    CHECK(e.rmse == std::sqrt(e.mse));
    CHECK(e.outside_tolerance == outside);
    CHECK(e.n_pixels == 61 * 40);
  }

  TEST_CASE("percentiles are those of a full sort, by nearest rank over all pixels") {
    for (int n = 1; n <= 250; ++n) {
      for (const double share : {0.0, 0.3, 1.0}) {
        CAPTURE(n);
        CAPTURE(share);
        const auto pixels = image(n, 1, share, static_cast<unsigned>(n));
        ErrorTally tally;
        std::vector<double> sizes;
        for (const auto& p : pixels) {
          tally.add(p.x, p.y, p.got, p.want);
          sizes.push_back(std::fabs(p.got - p.want));
        }
        std::sort(sizes.begin(), sizes.end());
        // The definition: the smallest value that at least per_mille / 1000 of all values do not exceed.
        const auto definition = [&](int per_mille) {
          for (std::size_t i = 0; i < sizes.size(); ++i) {
            if (static_cast<int>(i + 1) * 1000 >= per_mille * n) return sizes[i];
          }
          return sizes.back();
        };
        const Errors e = tally.finish();
        CHECK(e.p50 == definition(500));
        CHECK(e.p90 == definition(900));
        CHECK(e.p95 == definition(950));
        CHECK(e.p99 == definition(990));
        CHECK(e.p995 == definition(995));
        CHECK(e.max_abs == sizes.back());
      }
    }
  }

  TEST_CASE("of several worst pixels the first in row-major order is named, with both its values") {
    ErrorTally tally;
    tally.add(5, 0, 0.5, 0.25);
    tally.add(3, 1, 0.0, 0.5);
    tally.add(7, 1, 1.0, 0.5);
    tally.add(0, 2, 0.5, 1.0);
    const Errors e = tally.finish();
    CHECK(e.max_abs == 0.5);
    CHECK(e.max_x == 3);
    CHECK(e.max_y == 1);
    CHECK(e.max_got == 0.0);
    CHECK(e.max_want == 0.5);
  }

  TEST_CASE("errors that are no finite number are counted and left out of everything else") {
    ErrorTally with, without;
    for (const auto& p : image(20, 5, 0.5, 3)) {
      with.add(p.x, p.y, p.got, p.want);
      without.add(p.x, p.y, p.got, p.want);
      if (p.x == 7) with.add(p.x, p.y, kNan, p.want);
      if (p.x == 8) with.add(p.x, p.y, std::numeric_limits<double>::infinity(), p.want);
    }
    Errors a = with.finish();
    CHECK(a.nan_count == 10);
    CHECK(a.n_pixels == 110);
    a.nan_count = 0;
    a.n_pixels = 100;
    check_same_bits(a, without.finish());
  }

  TEST_CASE("a region without pixels has no errors, and one without wrong pixels no worst one") {
    const Errors nothing = ErrorTally().finish();
    CHECK(nothing.n_pixels == 0);
    CHECK(std::isnan(nothing.rmse));
    CHECK(std::isnan(nothing.max_abs));
    CHECK(std::isnan(nothing.p50));
    CHECK(nothing.max_x == -1);

    ErrorTally exact;
    exact.add_exact(1000);
    const Errors none = exact.finish();
    CHECK(none.n_pixels == 1000);
    CHECK(none.rmse == 0);
    CHECK(none.max_abs == 0);
    CHECK(none.p995 == 0);
    CHECK(none.max_x == -1);
    CHECK(std::isnan(none.max_got));
  }

  TEST_CASE("an error of half an 8-bit step is still inside the tolerance, the next double is not") {
    ErrorTally tally;
    tally.add(0, 0, kTolerance, 0);
    tally.add(1, 0, -kTolerance, 0);
    CHECK(tally.finish().outside_tolerance == 0);
    tally.add(2, 0, std::nextafter(kTolerance, 1), 0);
    CHECK(tally.finish().outside_tolerance == 1);
  }
}

}  // namespace
}  // namespace moire
