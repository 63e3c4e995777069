// Random straight edges across an image. Sources beside the declarations.
#include "study/random_lines.h"

#include <cmath>

#include "core/hash.h"

namespace moire {

RandomLine random_line(EdgeLaw law, std::uint64_t seed, std::uint32_t index, Grid grid) {
  const Key key = pixel_key(draw_hash(seed, 0), {});
  const Words direction = hash(key, index, Axis::line, 0), offset = hash(key, index, Axis::line, 1);
  const double width = grid.width, height = grid.height;

  // With the normal n the image is w = width |nx| + height |ny| wide, and a density proportional to w is a mixture: of
  // |nx| with weight `width` and of |ny| with weight `height`. Where the angle's density is |cos|, the sine is uniform.
  const bool by_width = unit(direction.a, direction.b) * (width + height) < width;
  const double sine = law == EdgeLaw::isotropic ? 2 * unit(direction.c, direction.d) - 1 : 0;
  const double cosine = std::copysign(std::sqrt((1 - sine) * (1 + sine)), (offset.c & 1) == 0 ? 1.0 : -1.0);
  const Vec2 n = by_width ? Vec2{cosine, sine} : Vec2{sine, cosine};

  const double w = width * std::fabs(n.x) + height * std::fabs(n.y);
  const double p = (unit(offset.a, offset.b) - 0.5) * w;
  return {{0.5 * width + p * n.x, 0.5 * height + p * n.y}, n};
}

}  // namespace moire
