// The discrepancies as plug-ins: what a person may name, with which parameters, and how one is computed of a set.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/args.h"
#include "core/hash.h"
#include "measure/discrepancy/point_view.h"
#include "measure/discrepancy/test_lines.h"
#include "patterns/pattern.h"

namespace moire {

// One constant record per discrepancy.
struct DiscrepancyInfo {
  std::string_view name, title, cite;
  std::string_view column;  // its name in a table of images: star_l2
  bool is_square;           // a root mean square over tests, T_N; else the largest of all tests, D_N
  bool has_3d;              // takes points with a time
  // That a set may have in 2 dimensions and in 3: some ten minutes of one core.
  std::int64_t most_points, most_points_3d;
  std::span<const Param> params;
};

// Every discrepancy: star-l2 star-linf edge-l2 edge-l2-printed edge-linf disk-l2.
std::span<const DiscrepancyInfo> discrepancies();
bool is_discrepancy(std::string_view name);
// Its column in a table of images: star_l2, or star_l2_3d with a time.
std::string discrepancy_column(const DiscrepancyInfo& info, bool with_time);

// T_N or D_N of a set of points, and the standard error that random tests leave; 0 without them.
struct Discrepancy {
  double value = 0, error = 0;
};

// A discrepancy with checked parameters.
class DiscrepancyChoice {
 public:
  // `defaults` fill in parameters that the spec does not give and that the discrepancy has. Throws Error.
  explicit DiscrepancyChoice(const Spec& spec, const Given& defaults = {});

  const std::string& text() const { return text_; }  // as written
  const DiscrepancyInfo& info() const { return *info_; }
  bool is_monte_carlo() const;
  // Whether the set's first point is left out though N still divides.
  bool is_without_first() const;
  // Whether its tests are those of the name alone, however they are summed: no radius of one's own.
  bool is_plain() const;
  // Random tests per set of Monte Carlo.
  std::int64_t tests() const;
  // "closed-form" and "monte-carlo" for T_N, "exact" for D_N.
  std::string_view method() const;
  // Throws Error where sets of so many points, or of these dimensions, are not possible.
  void require(std::int64_t n, int dims) const;

  // The law of its random tests, where these are lines.
  std::optional<LineLaw> test_lines() const;

  // Of the set. `key` is for the random tests of Monte Carlo. Precondition: require(). A time that the discrepancy does
  // not know is not looked at. `lines` may hold the tests() lines of test_lines() and the key, which are then not drawn
  // again; it is not looked at where the tests are others.
  Discrepancy operator()(PointView points, const Key& key, std::span<const MeasuredLine> lines = {}) const;

  // The mean of T_N^2 over the sets of a pattern, where a closed form of it is known: random, jittered and n-rooks.
  std::optional<double> expected_square(const PatternChoice& pattern, std::int64_t n, int dims) const;

 private:
  std::optional<double> radius() const;

  const DiscrepancyInfo* info_;
  Args args_;
  std::string text_;
};

// The root mean square of T (or D) over sets of a pattern with n points, and its standard error.
struct SetsDiscrepancy {
  double rms = 0, error = 0;
};
// One per choice: by theory where it is known, else over 100 sets (one, without an error, of a pattern that does not
// vary). In parallel; the same for any number of threads.
std::vector<SetsDiscrepancy> discrepancies_of(const PatternChoice& pattern, int n, bool with_time, std::uint64_t seed,
                                              std::span<const DiscrepancyChoice> choices);

}  // namespace moire
