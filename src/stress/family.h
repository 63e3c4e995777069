// A family of hard cases: one quantity that the program computes, cases made to hurt it, and the truth of each from
// higher precision. src/stress/hunt.h runs them, `moire stress` prints what they found.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace moire::stress {

// A case is a function of its key alone, so that any one can be run again by itself.
struct CaseKey {
  std::uint64_t seed = 1, index = 0;
};

// What one case gave. A case may look at many values; it tells of the one whose error is the largest part of its bound.
struct Outcome {
  double severity = 1;      // how adverse, > 0, in the measure that Family::severity names
  double computed = 0;      // the program's value
  double wanted = 0;        // the oracle's, rounded
  double error = 0;         // |computed - oracle's value|, taken before that is rounded
  double bound = 0;         // what the program claims of this error, or the family's limit where it claims nothing
  double oracle_error = 0;  // bound on the oracle's own error
  // What the textbook formula in plain double arithmetic errs by; NaN: there is none to compare.
  double naive_error = std::numeric_limits<double>::quiet_NaN();
  bool relative = false;  // the claim is relative to the value, however small that is
  std::string fault;      // what is wrong in another way: a coordinate of 1.0, an exception; "" : nothing
};

// Values as small as this, and smaller, have no relative error to speak of unless a family says so: claims are
// absolute.
inline constexpr double kSmall = 1e-3;

// Error over the value's size; NaN where that says nothing.
inline double relative_error(const Outcome& outcome) {
  const double size = outcome.wanted < 0 ? -outcome.wanted : outcome.wanted;
  return size > kSmall || (outcome.relative && size > 0) ? outcome.error / size
                                                         : std::numeric_limits<double>::quiet_NaN();
}

// The part of its bound that the error is known to take: what the oracle may err by is taken off. A fault, or an error
// where none may be, is infinite.
inline double part_of_bound(const Outcome& outcome) {
  if (!outcome.fault.empty() || outcome.bound != outcome.bound) return std::numeric_limits<double>::infinity();
  if (outcome.error <= outcome.oracle_error) return 0;
  return (outcome.error - outcome.oracle_error) / outcome.bound;
}

// No fault, and the error within the bound, or beyond it by no more than the oracle may err. NaN is not.
inline bool passes(const Outcome& outcome) {
  return outcome.fault.empty() && outcome.error <= outcome.bound + outcome.oracle_error;
}

struct Family {
  std::string_view name;      // "edges": what --family takes
  std::string_view title;     // what the cases are, for the table
  std::string_view quantity;  // what is computed, and its unit
  std::string_view severity;  // what severity measures, and its unit: short, it stands below an axis
  std::string_view claim;     // where the bound comes from
  double share = 1;           // cases run per case asked for, in (0, 1]: those that cost much run less often
  Outcome (*run)(CaseKey key) = nullptr;
  // The case in the program's own words (scene, pixel, filter, ...; one line), every double with 17 digits.
  std::string (*describe)(CaseKey key) = nullptr;
};

// All families in the order of the table.
std::span<const Family> families();

}  // namespace moire::stress
