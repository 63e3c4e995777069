// Of the many values that one case may look at, the one that comes closest to its bound.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "stress/family.h"

namespace moire::stress {

// One value: fields as in Outcome, and what it is, for Family::describe.
struct Measured {
  std::string_view quantity;  // "k", "mean": outlives the case
  double at = 0;              // its argument or number
  double computed = 0, wanted = 0, error = 0, bound = 0, oracle_error = 0;
  double naive_error = std::numeric_limits<double>::quiet_NaN();
};

class Worst {
 public:
  // The naive error of a case is the largest of its values'. NaN, be it the value, its error or a bound, is the worst
  // there is: without an error, too.
  void see(const Measured& m) {
    const double allowed = m.bound + m.oracle_error;
    double close = m.error == 0 ? 0 : m.error / allowed;
    if (std::isnan(close) || std::isnan(m.computed) || std::isnan(allowed)) {
      close = std::numeric_limits<double>::infinity();
    }
    if (seen_++ == 0 || close > close_) {
      close_ = close;
      worst_ = m;
    }
    if (std::isnan(naive_) || m.naive_error > naive_) naive_ = m.naive_error;
  }
  // The first fault is kept.
  void fault(std::string what) {
    if (fault_.empty()) fault_ = std::move(what);
  }

  const Measured& worst() const { return worst_; }
  Outcome outcome(double severity) const {
    Outcome o;
    o.severity = severity;
    o.computed = worst_.computed;
    o.wanted = worst_.wanted;
    o.error = std::isnan(worst_.computed) ? std::numeric_limits<double>::quiet_NaN() : worst_.error;
    o.bound = worst_.bound;
    o.oracle_error = worst_.oracle_error;
    o.naive_error = naive_;
    o.fault = fault_;
    return o;
  }

 private:
  int seen_ = 0;
  double close_ = -1, naive_ = std::numeric_limits<double>::quiet_NaN();
  Measured worst_;
  std::string fault_;
};

// A case that looks at many values: what it is, for Family::describe, and the worst of them.
struct ManyValues {
  std::string text;
  Worst worst;
  double severity = 1;
  Outcome outcome() const { return worst.outcome(severity); }
};

}  // namespace moire::stress
