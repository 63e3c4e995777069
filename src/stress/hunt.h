// The hunt for the worst error of each family: runs cases, keeps the worst, and how errors grow with severity.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "stress/family.h"

namespace moire::stress {

// A case and what it gave.
struct Found {
  std::uint64_t index = 0;
  Outcome outcome;
};

// The largest errors among cases of like severity.
struct GrowthBin {
  double severity_lo = 0, severity_hi = 0;  // half a decade
  std::uint64_t cases = 0;
  double error = 0, bound = 0;
  double naive_error = 0;  // NaN: no case has one
};

struct Findings {
  const Family* family = nullptr;
  std::uint64_t cases = 0, failures = 0;
  Found largest;                  // by error
  Found relative;                 // by relative_error()
  Found closest;                  // by part_of_bound(): a failure, if there is one
  double naive_error = 0;         // the largest; NaN: no case has one
  std::vector<Found> failed;      // the first few, by index
  std::vector<GrowthBin> growth;  // by severity, bins with cases only
};

struct HuntSettings {
  std::uint64_t cases = 0;  // per family, before Family::share
  std::uint64_t seed = 1;
  // Called from time to time by the calling thread and others, one at a time, with the cases done and due in all.
  std::function<void(std::uint64_t done, std::uint64_t due)> progress;
  std::function<bool()> stop;  // true: no further cases; the findings are of those that ran
};

// Cases of that family: at least 1.
std::uint64_t cases_of(const Family& family, std::uint64_t cases);

// One case; an exception becomes a fault.
Outcome run_case(const Family& family, CaseKey key);

// One entry per family, in their order; the same for any number of threads. Stopped early, it holds whole families
// and the last one with fewer cases than due.
std::vector<Findings> hunt(std::span<const Family> families, const HuntSettings& settings);

}  // namespace moire::stress
