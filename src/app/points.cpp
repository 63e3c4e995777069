// moire points: a pattern's points in one pixel, with their times where these are asked for.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "app/commands.h"
#include "app/output.h"
#include "patterns/pattern.h"

namespace moire {

Exit execute(const PointsOptions& options) {
  const PatternChoice choice(parse_spec(options.pattern, "PATTERN"));
  const bool with_time = options.dims == 3;
  if (with_time) choice.require_time();
  choice.require_count(options.n);
  const Pattern pattern(choice, static_cast<int>(options.n), Draw{options.seed, options.trial});
  const auto n = static_cast<std::size_t>(options.n);
  std::vector<double> x(n), y(n), t(with_time ? n : 0);
  pattern.fill_set({x, y, t});

  print(with_time ? "x,y,t\n" : "x,y\n");
  constexpr std::size_t kBlock = 4096;  // lines printed at a time
  for (std::size_t begin = 0; begin < n; begin += kBlock) {
    std::string lines;
    for (std::size_t i = begin; i < std::min(n, begin + kBlock); ++i) {
      fmt::format_to(std::back_inserter(lines), "{:.17g},{:.17g}", x[i], y[i]);
      if (with_time) fmt::format_to(std::back_inserter(lines), ",{:.17g}", t[i]);
      lines += '\n';
    }
    print(lines);
  }
  return Exit::ok;
}

}  // namespace moire
