// The paper's tables.
#include "study/published.h"

#include <algorithm>
#include <iterator>

namespace moire {
namespace {

constexpr std::int64_t kSizes[] = {16, 256, 1600};

struct PaperRow {
  int table;
  std::string_view pattern;
  double value[3];  // by kSizes
  double last_digit[3];
};

constexpr PaperRow kRows[] = {
    {1, "zaremba", {.0358, .00255, .000438}, {1e-4, 1e-5, 1e-6}},
    {1, "jittered", {.0489, .00633, .00160}, {1e-4, 1e-5, 1e-5}},
    {1, "dart-throwing", {.0490, .00799, .00254}, {1e-4, 1e-5, 1e-5}},
    {1, "n-rooks", {.0461, .0101, .00391}, {1e-4, 1e-4, 1e-5}},
    {1, "random", {.0932, .0233, .00932}, {1e-4, 1e-4, 1e-5}},
    {2, "zaremba", {.0393, .00376, .000761}, {1e-4, 1e-5, 1e-6}},
    {2, "scan-time", {.0473, .00721, .00235}, {1e-4, 1e-5, 1e-5}},
    {2, "jittered-random-time", {.0580, .0126, .00512}, {1e-4, 1e-4, 1e-5}},
    {2, "random", {.0741, .0185, .00741}, {1e-4, 1e-4, 1e-5}},
    {3, "dart-throwing", {.0840, .0120, .00368}, {1e-4, 1e-4, 1e-5}},
    {3, "jittered", {.0994, .0165, .00394}, {1e-4, 1e-4, 1e-5}},
    {3, "zaremba", {.0855, .0160, .00511}, {1e-4, 1e-4, 1e-5}},
    {3, "random", {.104, .0239, .00993}, {1e-3, 1e-4, 1e-5}},
    {3, "n-rooks", {.0908, .0224, .0104}, {1e-4, 1e-4, 1e-4}},
    {4, "zaremba", {.0504, .00478, .00111}, {1e-4, 1e-5, 1e-5}},
    {4, "jittered", {.0538, .00595, .00146}, {1e-4, 1e-5, 1e-5}},
    {4, "dart-throwing", {.0613, .00767, .00241}, {1e-4, 1e-5, 1e-5}},
    {4, "n-rooks", {.0637, .0123, .00488}, {1e-4, 1e-4, 1e-5}},
    {4, "random", {.0924, .0224, .00866}, {1e-4, 1e-4, 1e-5}},
};

// Which table holds the measure; 0: none.
int table_of(std::string_view measure, int dims) {
  if (measure == "star-l2") return dims == 3 ? 2 : 1;
  if (dims != 2) return 0;
  if (measure == "disk-l2") return 3;
  return measure == "edge-l2-printed" || measure == "edge-l2" ? 4 : 0;
}

std::string_view doubt_of(int table, std::string_view pattern, std::string_view measure, bool without_first) {
  if (table <= 2 && pattern == "random") return "the formula sqrt((2^-k - 3^-k) / N), not an experiment: an RMS";
  if (table == 2 && pattern == "scan-time") return "its algorithm is derived here from an abstract";
  if (table == 3)
    return "the paper does not say how its disks are drawn, and no law of one disk a trial gives its rows";
  if (table == 4 && measure == "edge-l2") return "isotropic lines; the generator that the paper prints is not";
  if (table == 4 && !without_first) return "the paper seems to leave out one point of each set";
  if (pattern == "dart-throwing") return "the paper does not say how its radius is found";
  return "";
}

// Whether the parameters are the defaults, but for those that the paper leaves open.
bool is_plain(const PatternChoice& pattern) {
  constexpr std::string_view kOpen[] = {"k", "bank", "cells"};
  for (const Param& p : pattern.info().params) {
    if (std::find(std::begin(kOpen), std::end(kOpen), p.name) != std::end(kOpen)) continue;
    const bool same = p.kind == Param::Kind::choice ? pattern.args().text(p.name) == p.text
                                                    : pattern.args().number(p.name) == p.fallback;
    if (!same) return false;
  }
  return true;
}

}  // namespace

std::optional<PublishedValue> published(const PatternChoice& pattern, std::int64_t n, int dims,
                                        const DiscrepancyChoice& measure) {
  if (!is_plain(pattern) || !measure.is_plain()) return std::nullopt;
  const std::string_view name = pattern.info().name, of = measure.info().name;
  const int table = table_of(of, dims);
  if (measure.is_without_first() && table != 4) return std::nullopt;
  for (const PaperRow& row : kRows) {
    if (row.table != table || row.pattern != name) continue;
    for (std::size_t i = 0; i < std::size(kSizes); ++i) {
      if (kSizes[i] != n) continue;
      const bool formula = table <= 2 && name == "random";
      return PublishedValue{table,
                            row.value[i],
                            row.last_digit[i],
                            formula || name == "zaremba" ? 0 : 100,
                            formula,
                            doubt_of(table, name, of, measure.is_without_first())};
    }
  }
  return std::nullopt;
}

std::optional<KnownExponent> known_exponent(const PatternChoice& pattern, int dims, const DiscrepancyChoice& measure) {
  if (!is_plain(pattern) || measure.is_without_first()) return std::nullopt;
  const std::string_view name = pattern.info().name, of = measure.info().name;
  const bool star = of == "star-l2", shape = of == "edge-l2" || of == "edge-l2-printed" || of == "disk-l2";
  if (!star && !shape) return std::nullopt;
  if (name == "random") return KnownExponent{-0.5, false, "independent points"};
  if (name == "n-rooks") return KnownExponent{-0.5, false, "even along the axes, random across them"};
  if (name == "dart-throwing" && dims == 2) {
    return KnownExponent{-0.5, false, "a packing that is not hyperuniform: random points times a constant"};
  }
  if (name == "jittered" && dims == 2) return KnownExponent{-0.75, false, "one random point in each cell"};
  if (name == "jittered-random-time") {
    return dims == 3 ? KnownExponent{-0.5, false, "the times are independent"}
                     : KnownExponent{-0.75, false, "one random point in each cell"};
  }
  if (name == "zaremba" || name == "hammersley") {
    if (star) return KnownExponent{-1, false, "times a power of log n (Roth 1954; Warnock 1972)"};
    return KnownExponent{-0.75, true, "no points do better (Beck and Chen 1987)"};
  }
  return std::nullopt;
}

}  // namespace moire
