// Random straight edges across an image, by measures of lines that know no place: each pixel that is hit sees lines of
// the same law as every other one, so that one line is as many experiments as it hits pixels.
// D. P. Mitchell, "Ray tracing and irregularities of distribution", 1992, section 5, draws lines across one pixel for
// its table 4; L. A. Santalo, "Integral geometry and geometric probability", 1976, part I, has the measure.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/geometry.h"

namespace moire {

// isotropic: the measure of lines that no motion of the plane changes. The normal's direction has a density
// proportional to the width of the image seen along the line, |cos| + |sin| for a square; the offset is uniform over
// that width. (The generator that section 5 of the paper prints is not isotropic.)
// axis-aligned: the same with the normals (1, 0), (-1, 0), (0, 1) and (0, -1) alone.
enum class EdgeLaw : std::uint8_t { isotropic, axis_aligned };

inline constexpr std::string_view kEdgeLaws[] = {"isotropic", "axis-aligned"};  // by EdgeLaw

struct RandomLine {
  Vec2 through;  // pixels, a point of the line within the image's circumscribed circle
  Vec2 normal;   // of length 1, to rounding; towards the inside
};

// Line `index` of the sequence that (law, seed) names; it hits the image. A hash: line 7 is the same however many are
// drawn. No number is shared with any sampling pattern.
RandomLine random_line(EdgeLaw law, std::uint64_t seed, std::uint32_t index, Grid grid);

}  // namespace moire
