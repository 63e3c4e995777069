// How a radial weight varies along straight lines, ring by ring: what the remainder of its series (radial_series.h)
// depends on.
#pragma once

#include <cstddef>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "curve/boundary.h"
#include "curve/piece_weight.h"
#include "testimages/series_side.h"

namespace moire {

// |p| between low and high, one piece of k there: along[i] bounds the i-th Taylor coefficient of k(|p + s d|) in s, d a
// unit vector.
struct RadialRing {
  std::size_t piece;
  double low, high;
  TermBounds along;
};

// Rings reach from the radius inwards to this share of it or further, in the first piece.
inline constexpr double kInnermost = 1.0 / 64;

// What scenes may know of a radial filter. Pieces in order from r = 0.
class RadialWeight {
 public:
  const std::vector<PieceWeight> pieces;
  const WeightBounds bounds;

  RadialWeight(std::vector<PieceWeight> of_k, const WeightBounds& on_k) : pieces(std::move(of_k)), bounds(on_k) {}
  double radius() const { return pieces.back().high; }
  // From the outside in. Found when first asked for, which takes some milliseconds.
  std::span<const RadialRing> rings() const;

 private:
  mutable std::once_flag once_;
  mutable std::vector<RadialRing> rings_;
};

}  // namespace moire
