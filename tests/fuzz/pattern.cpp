// Pattern strings: made with a small number of points, as one set and over a run of pixels.
#include <vector>

#include "core/args.h"
#include "fuzz.h"
#include "patterns/pattern.h"

using namespace moire;

namespace {

void require_inside(const std::vector<double>& coordinates) {
  for (const double c : coordinates) fuzz::require(c >= 0 && c < 1, "points are in [0, 1)");
}

}  // namespace

// The first byte is the number of points, less one; the rest is the string.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > 1024) return 0;
  return fuzz::run_target([&] {
    const PatternChoice choice(parse_spec(fuzz::text_of(data + 1, size - 1), "PATTERN"));
    const int n = data[0] + 1;
    // A bank makes its sets at once: as many as are asked for, and so much work.
    if (choice.args().find("bank") != nullptr && choice.args().integer("bank") > 64) return;
    if (choice.args().find("k") != nullptr && choice.args().number("k") > 1e4) return;
    choice.require_count(n);
    const Pattern pattern(choice, n, Draw{1, 2});
    const Pixel run[] = {{0, 0}, {-1, 7}, {std::int64_t{1} << 40, -(std::int64_t{1} << 50)}};
    for (const std::size_t pixels : {std::size_t{0}, std::size(run)}) {
      const std::size_t points = static_cast<std::size_t>(n) * (pixels == 0 ? 1 : pixels);
      std::vector<double> x(points), y(points), t(choice.has_time() ? points : 0);
      if (pixels == 0) {
        pattern.fill_set({x, y, t});
      } else {
        pattern.fill(run, {x, y, t});
      }
      require_inside(x);
      require_inside(y);
      require_inside(t);
    }
  });
}
