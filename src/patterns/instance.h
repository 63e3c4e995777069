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
#include "patterns/cells.h"
#include "patterns/pattern.h"
#include "patterns/placed_grid.h"
#include "patterns/point_grid.h"
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
  static constexpr int kLeastForCells = kLeastPlacedCells;
  // Whether cells() is to have an answer: that needs 20 bytes a point more.
  static constexpr bool kWithCells = true;

  Instances(const Args& args, Draw draw, PlainSet set, bool with_cells = false)
      : set_(std::move(set)), draw_(draw_hash(draw.seed, draw.trial)) {
    const std::string_view name = args.text("instance");
    mode_ = name == "shift" ? Mode::shift : name == "scramble" ? Mode::scramble : Mode::fixed;
    if (mode_ == Mode::scramble) {
      // Scrambling sees 52 digits; the rest are cut off here, so that 1 + x below is exact.
      for (auto* coordinates : {&set_.x, &set_.y})
        for (double& v : *coordinates) v = std::floor(v * 0x1p52) * 0x1p-52;
    }
    if (with_cells && set_.x.size() >= std::size_t{kLeastForCells}) grid_ = PointGrid(set_.x, set_.y);
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

  // See HasCells (pattern.h).
  CellGrid cells(Pixel pixel) const noexcept {
    if (grid_.empty()) return {};
    if (mode_ == Mode::shift) return shifted(pixel).cells();
    return {grid_.side(), grid_.side(), 0, 0};
  }
  CellPoints take_cells(Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept {
    if (mode_ == Mode::shift) return shifted(pixel).take(counted, filled, out);
    if (mode_ == Mode::fixed) return take_cells_of(grid_, counted, filled, out);
    const Words w = hash(pixel_key(draw_, pixel), 0, Axis::scramble);
    return ScrambledGrid(grid_, digits52(w.a, w.b), digits52(w.c, w.d)).take(counted, filled, out);
  }

 private:
  enum class Mode : std::uint8_t { fixed, shift, scramble };

  ShiftedGrid shifted(Pixel pixel) const noexcept {
    const Words w = hash(pixel_key(draw_, pixel), 0, Axis::shift);
    return {grid_, unit(w.a, w.b), unit(w.c, w.d)};
  }

  static void scramble(const std::vector<double>& from, std::uint64_t digits, double* __restrict to) noexcept {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = scrambled(from[i], digits);
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
  PointGrid grid_;
  std::uint64_t draw_;
  Mode mode_;
};

}  // namespace moire
