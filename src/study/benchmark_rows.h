// From timings to the tables of a benchmark (benchmark.h): medians and scatter, efficiencies, Pareto fronts and cost
// exponents.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/results.h"

namespace moire {

// One case, by round; nanoseconds of a whole image. Empty: not measured.
struct CaseTimings {
  std::vector<double> setup, first_use, reference, generation, evaluation, reconstruction, render, exhaustive;
};

// Sets NAME, and with the suffixes deviation, least and most (before "_ns" where the name ends so) what
// timing_spread() says of the timings, each divided by `per`; empty cells for no timings or no `per`.
void set_timings(Row& row, const std::string& name, std::span<const double> timings, double per = 1);

// The medians and extremes of a / b, round by round: drift of the machine cancels. Either may be empty.
void set_ratio(Row& row, const std::string& name, std::span<const double> a, std::span<const double> b);

// The time_* columns of a row but for those of other rows; pixels_active, samples_total and rmse_active must be set.
void set_case_times(Row& row, const CaseTimings& timings);

// Sets time_front of all rows.
void mark_fronts(Table& rows);

// The exponents of all series of rows; sets them in the rows, too.
inline constexpr std::size_t kExponentCounts = 4;  // the largest, where fixed costs weigh least
Table fit_exponents(Table& rows);

}  // namespace moire
