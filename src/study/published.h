// What D. P. Mitchell, "Ray tracing and irregularities of distribution", 1992, prints in its four tables, and what the
// theorems about the patterns say, to stand beside what is measured.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "patterns/pattern.h"
#include "study/discrepancy_measure.h"

namespace moire {

// One cell of a table.
struct PublishedValue {
  int table;  // 1 to 4
  double value;
  double last_digit;       // what one unit of its last printed digit is worth
  int trials;              // that it is a mean of; 0: not an experiment
  bool is_rms;             // the root of a mean square by formula; otherwise a mean of T
  std::string_view doubt;  // why it may differ though both are right; "": no doubt
};

// The cell of a pattern with n points; none where the paper has none. The paper knows patterns and disks without
// parameters: others than the defaults have no cell, but for how hard dart-throwing and scanning try.
std::optional<PublishedValue> published(const PatternChoice& pattern, std::int64_t n, int dims,
                                        const DiscrepancyChoice& measure);

// The exponent e of T ~ n^e as n grows, where it is known, for the same patterns.
struct KnownExponent {
  double exponent;
  bool at_best;  // a bound that holds for all points, whether or not these attain it
  std::string_view why;
};
std::optional<KnownExponent> known_exponent(const PatternChoice& pattern, int dims, const DiscrepancyChoice& measure);

}  // namespace moire
