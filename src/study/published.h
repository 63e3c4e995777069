// What D. P. Mitchell, "Ray tracing and irregularities of distribution", 1992, prints in its four tables, and what the
// theorems about the patterns say, to stand beside what is measured.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

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

// The cell of a pattern's name, number of points and dimensions; `without_first` are measures that leave out the set's
// first point. None where the paper has none.
std::optional<PublishedValue> published(std::string_view pattern, std::int64_t n, int dims, std::string_view measure,
                                        bool without_first);

// The exponent e of T ~ n^e as n grows, where it is known.
struct KnownExponent {
  double exponent;
  std::string_view why;
};
std::optional<KnownExponent> known_exponent(std::string_view pattern, int dims, std::string_view measure);

}  // namespace moire
