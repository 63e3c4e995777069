// Scenes as files describe them: the keys of one scene, with ranges, to test images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "study/document.h"
#include "testimages/testimage.h"

namespace moire {

struct NamedScene {
  std::string name;
  TestImage image;
};

// A numeric key may be a range { from, to, step }: one scene per value, named NAME:key=value. The values are
// from + k step for k = 0, 1, ... up to `to`, which is one of them when it is hit within the rounding of the three
// numbers; a short decimal within that rounding is taken for the sum (0 + 3 * 0.1 is 0.3). Throws Error at `range` for
// more than `limit` values or a step that leads away.
std::vector<double> range_values(const Node& range, std::size_t limit);

// In a scene of kind "edge", in place of through and normal,
//   lines = { law = "isotropic" | "axis-aligned", count = 256, seed = 1 }
// draws `count` random edges across the image (random_lines.h), named NAME:line=0, NAME:line=1, ...; `seed` may be left
// out. They are one family: its name here, and the whole name for any other scene, stands for it in summaries.
std::string_view scene_family(std::string_view scene_name);

// The number of a scene within its family; 0 for a scene that is no random line.
std::int64_t line_number(std::string_view scene_name);

// The scenes of one table of scene keys (kind, width, height and the kind's own; `name` is optional and must agree
// with no other: the caller checks). More than `limit` scenes are refused, and ranges beside long lists that come to
// more than 2^23 numbers in all scenes together. Throws Error with file:line:column.
std::vector<NamedScene> scenes_of(const Node& table, const std::string& name, std::size_t limit);

// A scene file, which describes one scene. `name` is used when the file gives none. Throws Error.
NamedScene parse_scene(std::string_view text, const std::string& file, const std::string& name);

}  // namespace moire
