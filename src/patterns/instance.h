// The parameter `instance` of deterministic patterns: how their one set of points appears in each pixel.
// fixed: as it is, everywhere. shift: moved on the unit torus (R. Cranley and T. N. L. Patterson, "Randomization of
// number theoretic methods for multiple integration", SIAM J. Numer. Anal. 13, 1976). scramble: the binary digits of
// each coordinate exclusive-or'ed with random ones, which keeps elementary intervals (T. Kollig and A. Keller,
// "Efficient multidimensional sampling", Eurographics 2002); the ternary digits of times shifted by random ones modulo
// 3, the same in base 3 (digital shifts: P. L'Ecuyer and C. Lemieux, "Recent advances in randomized quasi-Monte Carlo
// methods", in Modeling uncertainty, 2002).
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
#include "patterns/radical_inverse3.h"
#include "patterns/strata.h"
#include "patterns/torus.h"
#include "patterns/uniform.h"

namespace moire {

inline constexpr Param kInstanceParams[] = {
    choice("instance", "fixed", "fixed|shift|scramble",
           "in every pixel the same points, a random toroidal shift of them, or a random scramble of their digits")};

inline Varies instance_varies(const Args& args) {
  return args.text("instance") == "fixed" ? Varies::never : Varies::by_trial;
}

// The set in its first form, one entry per point: x and y in [0, 1); t, too, or no times. Point i then has the time
// of index i by ternary_inverses() with `folding`; it is stored, besides, because scrambling starts from the digits.
struct PlainSet {
  std::vector<double> x, y, t = {};
  TernaryDigits folding = {};
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
    const std::size_t n = set_.x.size();
    for (std::size_t p = 0; p < run.size(); ++p) {
      const Points here = out.part(p * n, n);
      const Key key = pixel_key(draw_, run[p]);
      if (mode_ == Mode::fixed) {
        std::copy(set_.x.begin(), set_.x.end(), here.x.begin());
        std::copy(set_.y.begin(), set_.y.end(), here.y.begin());
        if (!here.t.empty()) std::copy(set_.t.begin(), set_.t.end(), here.t.begin());
      } else if (mode_ == Mode::shift) {
        const Words w = hash(key, 0, Axis::shift);
        shift_into(set_.x, unit(w.a, w.b), here.x.data());
        shift_into(set_.y, unit(w.c, w.d), here.y.data());
        if (!here.t.empty()) shift_time(key, here.t.data());
      } else {
        const Words w = hash(key, 0, Axis::scramble);
        scramble(set_.x, digits52(w.a, w.b), here.x.data());
        scramble(set_.y, digits52(w.c, w.d), here.y.data());
        if (!here.t.empty()) scramble_time(key, here.t);
      }
    }
  }

 private:
  enum class Mode : std::uint8_t { fixed, shift, scramble };

  static void scramble(const std::vector<double>& from, std::uint64_t digits, double* __restrict to) noexcept {
    for (std::size_t i = 0; i < from.size(); ++i)
      to[i] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0 + from[i]) ^ digits) - 1.0;
  }

  void shift_time(const Key& key, double* t) const noexcept {
    const Words w = hash(key, 1, Axis::shift);
    shift_into(set_.t, unit(w.a, w.b), t);
  }

  // All points have the same digits behind the 18th, the folding's or zeros; what a shift makes of those is one random
  // offset, here strictly inside the intervals of length 3^-18, so that rounding moves nothing out of its interval.
  void scramble_time(const Key& key, std::span<double> t) const noexcept {
    const Words w = hash(key, 1, Axis::scramble);
    std::int32_t random = uniform_below(w.a, w.b, kTernaryCells);
    TernaryDigits add = set_.folding;
    for (int& digit : add) {
      digit = (digit + random % 3) % 3;
      random /= 3;
    }
    ternary_inverses(add, t);
    const Strata intervals(kTernaryCells);
    const double offset = intervals.offset(unit(w.c, w.d));
    for (double& v : t) v = intervals.place(v, offset);
  }

  PlainSet set_;
  std::uint64_t draw_;
  Mode mode_;
};

}  // namespace moire
