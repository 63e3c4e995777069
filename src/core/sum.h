// Compensated sums. Adding +0.0, or leaving it out, changes no bit of the result.
#pragma once

#include "core/double_double.h"

namespace moire {

// Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen", ZAMM 54, 1974: error of the
// result below half an ulp plus n^2 2^-106 times the sum of the absolute terms.
class Sum {
 public:
  void add(double x) {
    const Dd s = two_sum(sum_, x);
    sum_ = s.hi;
    rest_ += s.lo;
  }
  double value() const { return sum_ + rest_; }

 private:
  double sum_ = 0, rest_ = 0;
};

}  // namespace moire
