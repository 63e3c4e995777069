// What nothing else beats in both cost and error: V. Pareto, "Manuale di economia politica", 1906; found by sorting
// (H. T. Kung, F. Luccio, F. P. Preparata, "On finding the maxima of a set of vectors", Journal of the ACM 22(4),
// 1975).
#pragma once

#include <span>
#include <vector>

namespace moire {

// Less is better in both.
struct CostError {
  double cost = 0, error = 0;
};

// By point: whether no other point is at most as large in both and smaller in one. Equal points are in or out together.
// A point with a number that is not finite is out, and beats nobody. O(n log n).
std::vector<bool> pareto_front(std::span<const CostError> points);

}  // namespace moire
