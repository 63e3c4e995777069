// The parameter `instance` of deterministic patterns: how their one set of points appears in each pixel.
// fixed: as it is, everywhere. shift: moved on the unit torus (R. Cranley and T. N. L. Patterson, "Randomization of
// number theoretic methods for multiple integration", SIAM J. Numer. Anal. 13, 1976). scramble: the binary digits of
// each coordinate exclusive-or'ed with random ones, which keeps elementary intervals (T. Kollig and A. Keller,
// "Efficient multidimensional sampling", Eurographics 2002).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/args.h"
#include "core/hash.h"
#include "patterns/pattern.h"
#include "patterns/torus.h"

namespace moire {

inline constexpr Param kInstanceParams[] = {
    choice("instance", "fixed", "fixed|shift|scramble",
           "in every pixel the same points, a random toroidal shift of them, or a random scramble of their digits")};

inline Varies instance_varies(const Args& args) {
  return args.text("instance") == "fixed" ? Varies::never : Varies::by_trial;
}

// The set in its first form, x and y in [0, 1), one entry per point.
struct PlainSet {
  std::vector<double> x, y;
};

class Instances {
 public:
  Instances(const Args& args, Draw draw, PlainSet set) : set_(std::move(set)), draw_(draw_hash(draw.seed, draw.trial)) {
    const std::string_view name = args.text("instance");
    mode_ = name == "shift" ? Mode::shift : name == "scramble" ? Mode::scramble : Mode::fixed;
    if (mode_ == Mode::scramble) {
      // Scrambling sees 52 digits; the rest are cut off here, so that 1 + x below is exact.
      for (auto* coordinates : {&set_.x, &set_.y})
        for (double& v : *coordinates) v = std::floor(v * 0x1p52) * 0x1p-52;
    }
  }

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    double *x = out.x.data(), *y = out.y.data();
    for (const Pixel& pixel : run) {
      if (mode_ == Mode::fixed) {
        std::copy(set_.x.begin(), set_.x.end(), x);
        std::copy(set_.y.begin(), set_.y.end(), y);
      } else if (mode_ == Mode::shift) {
        const Words w = hash(pixel_key(draw_, pixel), 0, Axis::shift);
        shift_into(set_.x, unit(w.a, w.b), x);
        shift_into(set_.y, unit(w.c, w.d), y);
      } else {
        const Words w = hash(pixel_key(draw_, pixel), 0, Axis::scramble);
        scramble(set_.x, digits52(w.a, w.b), x);
        scramble(set_.y, digits52(w.c, w.d), y);
      }
      x += set_.x.size();
      y += set_.y.size();
    }
  }

 private:
  enum class Mode : std::uint8_t { fixed, shift, scramble };

  static void scramble(const std::vector<double>& from, std::uint64_t digits, double* __restrict to) noexcept {
    for (std::size_t i = 0; i < from.size(); ++i)
      to[i] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0 + from[i]) ^ digits) - 1.0;
  }

  PlainSet set_;
  std::uint64_t draw_;
  Mode mode_;
};

}  // namespace moire
