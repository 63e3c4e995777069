// The size that an image file promises, before memory is taken for it; part of the module moire_io.
#pragma once

#include <string>

#include "reports/image_io.h"

namespace moire {

// What is wrong with the sides of an image, "" when they can be read. `Spec` is OpenImageIO's ImageSpec, which headers
// do not know.
template <class Spec>
std::string refuse_size(const Spec& spec) {
  const std::int64_t width = spec.width, height = spec.height;
  if (width >= 1 && height >= 1 && spec.depth <= 1 && width <= kMaxReadPixels / height) return {};
  return "has " + std::to_string(width) + " x " + std::to_string(height) + " pixels; at most " +
         std::to_string(kMaxReadPixels) + " can be read, in one plane";
}

}  // namespace moire
