// What a study may ask to be measured, by name. What is not named is not computed.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace moire {

enum class Measure : std::uint8_t {
  error,       // got - exact: the sampling error
  coverage,    // got - coverage and exact - coverage: what the filter itself changes
  flat_field,  // noise of a constant scene under the unnormalised estimator
  ringing,     // how far images leave [0, 1]
  edge_ratio,  // squared error over squared edge discrepancy of the samples
  spectrum,    // power of the errors by frequency: structure and noise
  kernel,      // the filters' own metrics beside the results
  count_       // how many there are
};

struct MeasureInfo {
  Measure value;
  std::string_view name, title, cite;
};

// Every measure, in the order of Measure.
std::span<const MeasureInfo> measures();

// Throws Error naming the nearest measures.
Measure find_measure(std::string_view name, std::string_view place);

class MeasureSet {
 public:
  void add(Measure m) { bits_.set(static_cast<std::size_t>(m)); }
  bool has(Measure m) const { return bits_.test(static_cast<std::size_t>(m)); }

 private:
  std::bitset<static_cast<std::size_t>(Measure::count_)> bits_;
};

}  // namespace moire
