// Noise of a constant scene, by rendering one.
#include "study/flat_field.h"

#include <cmath>
#include <string>

#include "core/sum.h"
#include "engine/active_rows.h"
#include "engine/render.h"
#include "study/scene_file.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

// A half-plane whose edge is a million pixels to the left: 1 wherever samples fall.
TestImage constant_scene() {
  return parse_scene("kind = \"edge\"\nthrough = [-1e6, 0.0]\nnormal = 0.0\nwidth = " +
                         std::to_string(kFlatField.width) + "\nheight = " + std::to_string(kFlatField.height),
                     "flat field", "flat")
      .image;
}

}  // namespace

double flat_field_rms(Samples samples, const Filter& filter) {
  const TestImage scene = constant_scene();
  const ActiveRows rows = enumerate(scene, filter.radius());
  const Rendered got = render(scene, samples, filter, Estimator::unnormalised, rows);
  Sum squares;
  for (const double value : got.value) squares.add((value - 1) * (value - 1));
  return std::sqrt(squares.value() / static_cast<double>(got.value.size()));
}

}  // namespace moire
