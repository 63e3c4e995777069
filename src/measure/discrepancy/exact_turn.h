// Which way three points turn, exactly, for the doubles as they are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "measure/discrepancy/point_view.h"

namespace moire {

// Exact for coordinates that are multiples of 2^-1037, which only numbers below 2^-984 are not.
class ExactTurn {
 public:
  // Keeps the view: its points must outlive this.
  explicit ExactTurn(const PointView& points);

  // The sign of (p_j - p_i) x (p_k - p_i): 1 when k lies to the left of the line from i to j, x to the right and y up;
  // 0 on the line, also where i = j.
  int operator()(std::size_t i, std::size_t j, std::size_t k) const;

 private:
  // Coordinates as multiples of 2^-63, so that the difference of two products of differences fits into 128 bits. Every
  // double from 2^-11 to 1 is such a multiple, smaller ones may not be.
  struct Fixed {
    std::int64_t x, y;
    bool exact;
  };

  PointView points_;
  std::vector<Fixed> fixed_;
};

}  // namespace moire
