// The hunt for the worst errors.
#include "stress/hunt.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <utility>

#include "core/parallel.h"

namespace moire::stress {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kChunk = 64;         // cases that go together
constexpr std::uint64_t kBatch = 64 * 1024;  // cases whose outcomes are held at once
constexpr std::size_t kFailuresKept = 10;

// NaN counts as the worst there is.
double rank(double error) { return std::isnan(error) ? kInfinite : error; }

// NaN is none.
double known(double measure) { return std::isnan(measure) ? 0 : measure; }

// The larger; NaN is none.
double larger(double a, double b) { return std::isnan(a) || b > a ? b : a; }

// Ties go to the case found first, so that the order of threads cannot matter.
void keep_worst(Found& worst, const Found& found, double (*measure)(const Outcome&)) {
  if (rank(measure(found.outcome)) > rank(measure(worst.outcome))) worst = found;
}

// Half decades of severity; those of zero, infinity and NaN stand at the ends.
int bin_of(double severity) {
  if (!(severity > 0)) return std::numeric_limits<int>::min();
  if (std::isinf(severity)) return std::numeric_limits<int>::max();
  return static_cast<int>(std::floor(2 * std::log10(severity)));
}

class Tally {
 public:
  explicit Tally(const Family& family) {
    findings_.family = &family;
    findings_.naive_error = kNone;
  }

  void add(const Found& found) {
    const Outcome& outcome = found.outcome;
    if (findings_.cases++ == 0) {
      findings_.largest = findings_.relative = findings_.closest = found;
    } else {
      keep_worst(findings_.largest, found, [](const Outcome& o) { return o.error; });
      keep_worst(findings_.relative, found, [](const Outcome& o) { return known(relative_error(o)); });
      keep_worst(findings_.closest, found, part_of_bound);
    }
    findings_.naive_error = larger(findings_.naive_error, outcome.naive_error);
    if (!passes(outcome)) {
      ++findings_.failures;
      if (findings_.failed.size() < kFailuresKept) findings_.failed.push_back(found);
    }
    const int number = bin_of(outcome.severity);
    const auto [at, added] = bins_.try_emplace(number);
    GrowthBin& bin = at->second;
    if (added) {
      bin.severity_lo = std::pow(10, number / 2.0);
      bin.severity_hi = std::pow(10, (number + 1.0) / 2);
      bin.naive_error = kNone;
    }
    ++bin.cases;
    bin.error = std::max(bin.error, rank(outcome.error));
    bin.bound = std::max(bin.bound, outcome.bound);
    bin.naive_error = larger(bin.naive_error, outcome.naive_error);
  }

  Findings findings() && {
    for (const auto& [number, bin] : bins_) findings_.growth.push_back(bin);
    return std::move(findings_);
  }

 private:
  Findings findings_;
  std::map<int, GrowthBin> bins_;
};

// Counts cases for the caller's progress; threads take turns.
class Counter {
 public:
  Counter(const HuntSettings& settings, std::uint64_t due) : settings_(settings), due_(due) {}
  void add(std::uint64_t cases) {
    if (!settings_.progress) return;
    const std::lock_guard lock(mutex_);
    settings_.progress(done_ += cases, due_);
  }

 private:
  const HuntSettings& settings_;
  std::uint64_t due_, done_ = 0;
  std::mutex mutex_;
};

}  // namespace

std::uint64_t cases_of(const Family& family, std::uint64_t cases) {
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(static_cast<double>(cases) * family.share)));
}

Outcome run_case(const Family& family, CaseKey key) {
  try {
    return family.run(key);
  } catch (const std::exception& error) {
    Outcome outcome;
    outcome.fault = error.what();
    return outcome;
  }
}

std::vector<Findings> hunt(std::span<const Family> families, const HuntSettings& settings) {
  std::uint64_t due = 0;
  for (const Family& family : families) due += cases_of(family, settings.cases);
  Counter counter(settings, due);
  std::atomic<bool> stopped = false;
  std::vector<Findings> all;
  for (const Family& family : families) {
    Tally tally(family);
    const std::uint64_t count = cases_of(family, settings.cases);
    for (std::uint64_t first = 0; first < count && !stopped; first += kBatch) {
      const std::uint64_t batch = std::min(kBatch, count - first);
      std::vector<Outcome> outcomes(batch);
      std::vector<char> ran(batch);
      parallel_for((batch + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        if (stopped || (settings.stop && settings.stop())) {
          stopped = true;
          return;
        }
        const std::uint64_t begin = chunk * kChunk, end = std::min(batch, begin + kChunk);
        for (std::uint64_t i = begin; i < end; ++i) {
          outcomes[i] = run_case(family, {settings.seed, first + i});
          ran[i] = 1;
        }
        counter.add(end - begin);
      });
      for (std::uint64_t i = 0; i < batch; ++i) {
        if (ran[i]) tally.add({first + i, std::move(outcomes[i])});
      }
    }
    all.push_back(std::move(tally).findings());
    if (stopped) break;
  }
  return all;
}

}  // namespace moire::stress
