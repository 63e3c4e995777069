// Skipping changes no bit: the default path against the exhaustive one.
#pragma once

#include <doctest/doctest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "engine/render.h"

namespace moire::test {

inline bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// Pixels of the exhaustive image that differ from the default path: those with a value of their own there from it, the
// others from exactly +0.0 or 1.
inline int differences(const Rendered& some, const Rendered& all, const ActiveRows& rows) {
  int count = 0;
  std::size_t index = 0;
  for_each_rendered(rows, all, [&](int, int, Cover cover, double value) {
    const double flat = cover == Cover::all ? 1.0 : 0.0;
    count += !same_bits(value, is_rendered(some.pixels, cover) ? some.value[index++] : flat);
  });
  return count;
}

inline void check_skipping(const TestImage& scene, Samples samples, const Filter& filter,
                           std::span<const Estimator> estimators) {
  CAPTURE(filter.text());
  CAPTURE(samples.density());
  const ActiveRows rows = enumerate(scene, filter.radius());
  for (const Estimator estimator : estimators) {
    CAPTURE(std::string(name_of(estimator)));
    const Rendered some = render(scene, samples, filter, estimator, rows);
    const Rendered all = render(scene, samples, filter, estimator, rows, true);
    CHECK(differences(some, all, rows) == 0);
    CHECK(some.fallbacks == all.fallbacks);
    CHECK(some.samples_total == all.samples_total);
    CHECK(all.samples_evaluated == all.samples_total);
    CHECK(some.samples_evaluated <= some.samples_total);
  }
}

}  // namespace moire::test
