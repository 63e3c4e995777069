// The compensated sum over more terms than would fit into memory.
#include "stress/long_sum.h"

#include <cmath>

#include "core/hash.h"
#include "core/rounding.h"
#include "core/sum.h"

namespace moire::stress {

Outcome long_sum(std::uint64_t terms, CaseKey key) {
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 20;
  __extension__ using Wide = __int128;
  Wide exact = 0, absolute = 0;
  Sum sum;
  double naive = 0;
  const std::uint64_t salt = mix64(key.seed) + key.index;
  for (std::uint64_t i = 0; i < terms; ++i) {
    const std::uint64_t block = i / kBlock, place = i % kBlock;
    // The first half of a block, and backwards with the opposite sign; both have 41 digits and the same 12 zeros.
    const std::uint64_t mirrored = place < kBlock / 2 ? place : kBlock - 1 - place;
    const std::uint64_t random = mix64(salt + block * kBlock + mirrored);
    const auto large = static_cast<std::int64_t>((random >> 23) << 12);
    const std::int64_t term = place < kBlock / 2 ? large : static_cast<std::int64_t>(random & 1023) - large;
    exact += term;
    absolute += term < 0 ? -term : term;
    sum.add(static_cast<double>(term));
    naive += static_cast<double>(term);
  }
  const auto error_of = [&](double value) {
    // All partial sums are whole and below 2^100.
    const Wide whole = static_cast<Wide>(value), difference = whole - exact;
    const double fraction = value - static_cast<double>(whole);
    return std::fabs(static_cast<double>(difference) + fraction);
  };
  Outcome o;
  o.severity = exact == 0 ? 1 : static_cast<double>(absolute) / std::fabs(static_cast<double>(exact));
  o.computed = sum.value();
  o.wanted = static_cast<double>(exact);
  o.error = error_of(sum.value());
  o.naive_error = error_of(naive);
  // What sum.h says of any terms is n^2 2^-106 of their sizes, which is no news of 10^7 that cancel. Of these the
  // errors of additions are whole numbers, below 2^20 as partial sums stay below 2^73, and their own sum is below 2^53:
  // only the last addition rounds.
  o.bound = kUnit * std::fabs(o.computed);
  // In units of the terms' sum, as a power of two.
  int exponent = 0;
  std::frexp(static_cast<double>(absolute), &exponent);
  for (double* v : {&o.computed, &o.wanted, &o.error, &o.bound, &o.naive_error}) *v = std::ldexp(*v, -exponent);
  return o;
}

}  // namespace moire::stress
