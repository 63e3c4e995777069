// The inverse distribution of |k| against brute force: signs by a dense scan, masses from the kernel's own K.
#include "engine/inverse_distribution.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "chi_square.h"
#include "core/hash.h"
#include "core/rounding.h"
#include "filter_list.h"

using namespace moire;
using namespace moire::test;

namespace {

constexpr double kLast = 1 - 0x1p-53;

std::vector<Filter> separable_filters() {
  std::vector<Filter> filters;
  for (const std::string& text : separable_texts()) filters.emplace_back(parse_spec(text, "test"));
  return filters;
}

// The integral of |k| up to x, its zeros found by looking at many points of each piece.
class Brute {
 public:
  explicit Brute(const Kernel& kernel) : kernel_(kernel) {
    constexpr int kPoints = 1000;
    for (int piece = 0; piece < kernel.pieces(); ++piece) {
      const double begin = kernel.knots()[static_cast<std::size_t>(piece)];
      const double end = kernel.knots()[static_cast<std::size_t>(piece) + 1];
      add(piece, begin);
      for (int i = 0; i < kPoints; ++i) {
        const auto at = [&](int j) { return begin + (end - begin) * (j + 0.5) / kPoints; };
        double a = at(i), b = i + 1 < kPoints ? at(i + 1) : end;
        if (kernel.k_piece(piece, a) * kernel.k_piece(piece, b) >= 0) continue;
        for (int step = 0; step < 60; ++step) {
          const double middle = 0.5 * (a + b);
          (kernel.k_piece(piece, a) * kernel.k_piece(piece, middle) > 0 ? a : b) = middle;
        }
        add(piece, b);
      }
    }
    mass_.push_back(0);
    for (std::size_t i = 0; i < parts_.size(); ++i) mass_.push_back(mass_.back() + std::fabs(difference(i, end_of(i))));
  }

  double at(double x) const {
    const auto next =
        std::upper_bound(parts_.begin(), parts_.end(), x, [](double v, const Part& p) { return v < p.begin; });
    if (next == parts_.begin()) return 0;
    const auto i = static_cast<std::size_t>(next - parts_.begin()) - 1;
    return mass_[i] + std::fabs(difference(i, std::min(x, end_of(i))));
  }
  double total() const { return mass_.back(); }
  // Masses of the parts before each of them.
  const std::vector<double>& masses() const { return mass_; }

 private:
  struct Part {
    int piece;
    double begin;
  };
  void add(int piece, double begin) { parts_.push_back({piece, begin}); }
  double end_of(std::size_t i) const { return i + 1 < parts_.size() ? parts_[i + 1].begin : kernel_.radius(); }
  double difference(std::size_t i, double x) const {
    return kernel_.K_piece(parts_[i].piece, x) - kernel_.K_piece(parts_[i].piece, parts_[i].begin);
  }
  const Kernel& kernel_;
  std::vector<Part> parts_;
  std::vector<double> mass_;
};

// Ends, neighbours of where the sign or the piece changes, tails and numbers from everywhere, in ascending order.
std::vector<double> numbers(const Brute& brute, int count) {
  std::vector<double> u{0, 0x1p-1074, 0x1p-60, 0x1p-53, 1e-12, 0.5 - 0x1p-54, 0.5, 0.5 + 0x1p-53, 1 - 1e-12, kLast};
  for (const double mass : brute.masses()) {
    double v = mass / brute.total();
    for (int i = 0; i < 4; ++i) v = std::nextafter(v, 0);
    for (int i = 0; i < 9; ++i, v = std::nextafter(v, 2)) u.push_back(std::clamp(v, 0.0, kLast));
  }
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    u.push_back((n + 0.5) / count);
    u.push_back(std::exp2(-n * 60 / count));            // towards 0
    u.push_back(1 - std::exp2(-1 - n * 52 / count));    // towards 1
    u.push_back(std::nextafter((n + 0.5) / count, 1));  // a neighbour
  }
  for (double& v : u) v = std::min(v, kLast);
  std::sort(u.begin(), u.end());
  return u;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the distribution at the inverse is what was asked for, within the bound, for every filter") {
    for (const Filter& filter : separable_filters()) {
      CAPTURE(filter.text());
      const Kernel& kernel = filter.kernel();
      const InverseDistribution inverse(filter);
      const Brute brute(kernel);
      // Both are sums over the parts; those of the test err by as much as the library's may.
      CHECK(std::fabs(inverse.absolute_integral() - brute.total()) <= 2 * inverse.error());
      // A few ulp of each piece's K: no kernel has more than 24 parts, and K_error holds some 8 roundings.
      CHECK(inverse.error() <= 24 * 8 * (kernel.K_error() + 4 * kUnit * kernel.K_max()));
      double worst = 0;
      for (const double u : numbers(brute, 100)) {
        worst = std::max(worst, std::fabs(brute.at(inverse.at(u).x) - u * inverse.absolute_integral()));
      }
      CHECK(worst <= 2 * inverse.error());
    }
  }

  TEST_CASE("the inverse never falls, stays inside the support and has the sign of the kernel") {
    for (const Filter& filter : separable_filters()) {
      CAPTURE(filter.text());
      const Kernel& kernel = filter.kernel();
      const InverseDistribution inverse(filter);
      const Brute brute(kernel);
      double previous = -kernel.radius();
      int falls = 0, outside = 0, other_sign = 0, wrong_sign = 0;
      for (const double u : numbers(brute, 100)) {
        const auto [x, sign] = inverse.at(u);
        falls += x < previous;
        previous = x;
        outside += !(x >= -kernel.radius() && x < kernel.radius());
        other_sign += sign != inverse.sign(u);
        // Beside a zero the kernel is below what a step of the bisection changes and its own rounding.
        const double doubt = 16 * kernel.k_error() + 0x1p-50 * kernel.radius() * kernel.slope_max();
        wrong_sign += kernel.k(x) * sign < -doubt;
      }
      CHECK(falls == 0);
      CHECK(outside == 0);
      CHECK(other_sign == 0);
      CHECK(wrong_sign == 0);
    }
  }

  TEST_CASE("neighbouring numbers never change places, though K is flat in the tails") {
    for (const char* text : {"bspline:order=5", "gaussian", "lanczos", "windowed-sinc:window=hann", "mitchell"}) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const InverseDistribution inverse(filter);
      int falls = 0;
      for (const double from : {0x1p-40, 1e-6, 0.01, 0.3, 0.4999, 0.97, 1 - 1e-9}) {
        double u = from, previous = -HUGE_VAL;
        for (int i = 0; i < 400; ++i, u = std::nextafter(u, 1)) {
          const double x = inverse.at(u).x;
          falls += x < previous;
          previous = x;
        }
      }
      CHECK(falls == 0);
    }
  }

  TEST_CASE("the integral of |k| is 1 without negative lobes and known for some that have them") {
    for (const char* text : {"box", "box:width=1.7", "tent", "bspline", "bspline:order=5", "gaussian",
                             "gaussian:cut=cut", "blackman-harris", "hermite"}) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const InverseDistribution inverse(filter);
      CHECK_FALSE(inverse.has_negative_lobes());
      CHECK(inverse.absolute_integral() == 1.0);
    }
    // Catmull-Rom's lobe on [1, 2] is -(x - 1) (x - 2)^2 / 2, whose integral is -1/24: A = 1 + 4/24, to the bound.
    const Filter catmull_rom(parse_spec("catmull-rom", "test"));
    const InverseDistribution inverse(catmull_rom);
    CHECK(inverse.has_negative_lobes());
    CHECK(std::fabs(inverse.absolute_integral() - 7.0 / 6) <= inverse.error());
    // Squares as published digits have them, half a unit of the last one.
    for (const auto& [text, square] : {std::pair("mitchell", 1.145), std::pair("lanczos", 1.845)}) {
      const Filter filter(parse_spec(text, "test"));
      const InverseDistribution lobes(filter);
      CHECK(lobes.has_negative_lobes());
      CHECK(std::fabs(lobes.absolute_integral() * lobes.absolute_integral() - square) <= 5e-4);
    }
  }

  TEST_CASE("random numbers become points with the density |k|") {
    constexpr int kCells = 60, kNumbers = 20'000;
    for (const Filter& filter : separable_filters()) {
      CAPTURE(filter.text());
      const InverseDistribution inverse(filter);
      const Brute brute(filter.kernel());
      const double radius = filter.radius();
      std::vector<double> counts(kCells), edges;
      for (int i = 0; i <= kCells; ++i) edges.push_back(-radius + 2 * radius * i / kCells);
      for (int i = 0; i < kNumbers; ++i) {
        const double u = unit_from_digits(mix64(static_cast<std::uint64_t>(i)) >> 12);
        const auto cell = std::upper_bound(edges.begin(), edges.end(), inverse.at(u).x) - edges.begin() - 1;
        counts[static_cast<std::size_t>(std::min<std::ptrdiff_t>(cell, kCells - 1))] += 1;
      }
      // Cells of little mass go with the next ones, so that all expect 20 points or more.
      double value = 0, count = 0, expected = 0;
      int groups = 0;
      for (std::size_t i = 0; i < kCells; ++i) {
        count += counts[i];
        expected += (brute.at(edges[i + 1]) - brute.at(edges[i])) / brute.total() * kNumbers;
        if (expected < 20 && i + 1 < kCells) continue;
        value += (count - expected) * (count - expected) / std::max(expected, 1.0);
        ++groups;
        count = expected = 0;
      }
      CHECK(std::fabs(z_of_chi_square(value, groups - 1)) < 5);
    }
  }

  TEST_CASE("radial filters: the integral over a disk at the inverse is what was asked for, and it never falls") {
    // Midpoints of 2 pi r |k(r)| over 20000 intervals: the error is below slope^2 / 24 of an interval's length for each
    // zero of k and its curvature elsewhere, some 1e-6 for the kernels here; a wrong sign or factor would be 1e-2.
    constexpr int kSteps = 20'000;
    for (const std::string& text : radial_texts()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const InverseDistribution inverse(filter);
      const RadialKernel& kernel = filter.radial_kernel();
      std::vector<double> disk{0};
      const double step = filter.radius() / kSteps;
      for (int i = 0; i < kSteps; ++i) {
        const double r = (i + 0.5) * step;
        disk.push_back(disk.back() + 2 * std::numbers::pi * r * std::fabs(kernel.k(r)) * step);
      }
      CHECK(std::fabs(inverse.absolute_integral() - disk.back()) < 1e-5);
      CHECK(inverse.has_negative_lobes() == (disk.back() > 1 + 1e-5));
      double previous = 0, worst = 0;
      int falls = 0, outside = 0, wrong_sign = 0;
      for (int i = 0; i <= 3000; ++i) {
        const double u = std::min(i / 3000.0, kLast);
        const auto [r, sign] = inverse.at(u);
        falls += r < previous;
        previous = r;
        outside += !(r >= 0 && r < filter.radius());
        wrong_sign += sign != inverse.sign(u) || kernel.k(r) * sign < -1e-9;
        const auto cell = std::min(static_cast<std::size_t>(r / step), disk.size() - 2);
        const double part = r / step - static_cast<double>(cell), got = disk[cell] * (1 - part) + disk[cell + 1] * part;
        worst = std::max(worst, std::fabs(got - u * inverse.absolute_integral()));
      }
      CHECK(falls == 0);
      CHECK(outside == 0);
      CHECK(wrong_sign == 0);
      CHECK(worst < 1e-5);
    }
  }
}
