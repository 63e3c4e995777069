// The catalogue of measures.
#include "study/measures.h"

#include <string>
#include <vector>

#include "core/error.h"
#include "core/names.h"

namespace moire {
namespace {

constexpr MeasureInfo kMeasures[] = {
    {Measure::error, "error", "Error of an image against the exact image of its filter", ""},
    {Measure::coverage, "coverage",
     "Error of an image, and of its filter's exact image, against box coverage: what the filter itself changes", ""},
    {Measure::flat_field, "flat-field",
     "Noise of a constant scene: RMS of a pixel's weight sum around 1, before the ratio divides it out",
     "Mitchell and Netravali, \"Reconstruction filters in computer graphics\", 1988 (sample-frequency ripple)"},
    {Measure::ringing, "ringing", "How far an image and its filter's exact image leave [0, 1]",
     "Marschner and Lobb, \"An evaluation of reconstruction filters for volume rendering\", 1994 (overshoot)"},
    {Measure::edge_ratio, "edge-ratio",
     "Squared box error of the pixels that an edge hits over the squared edge-l2 of their samples: 1 for isotropic "
     "lines",
     "Mitchell, \"Ray tracing and irregularities of distribution\", 1992, section 5"},
    {Measure::spectrum, "spectrum",
     "What the errors look like: their power by frequency, split into structure (Moire) and noise (grain)",
     "Ulichney, \"Dithering with blue noise\", 1988; Mannos and Sakrison, \"The effects of a visual fidelity criterion "
     "on "
     "the encoding of images\", 1974"},
    {Measure::kernel, "kernel", "The metrics of the study's filters, as `moire filters` prints them", ""},
};
static_assert(std::size(kMeasures) == static_cast<std::size_t>(Measure::count_));

}  // namespace

std::span<const MeasureInfo> measures() { return kMeasures; }

Measure find_measure(std::string_view name, std::string_view place) {
  std::vector<std::string_view> known;
  for (const MeasureInfo& m : kMeasures) {
    if (m.name == name) return m.value;
    known.push_back(m.name);
  }
  throw Error(std::string(place), unknown_name("measure", name, known));
}

}  // namespace moire
