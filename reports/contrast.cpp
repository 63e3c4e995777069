// Families of random edges side by side.
#include "reports/contrast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/cases.h"

namespace moire {
namespace {

std::string join(const std::vector<std::string>& parts, const char* separator) {
  return fmt::format("{}", fmt::join(parts, separator));
}

// A pattern's slopes, one per family.
struct Slopes {
  std::string text;    // "-0.50 / -1.00 for n-rooks"
  bool apart = false;  // some two intervals do not meet; a missing one meets all
};

}  // namespace

std::vector<std::string> line_families(const Summary& summary) {
  std::vector<std::string> families;
  for (const Row& row : summary.slopes) {
    const std::string scene(row.text("scene"));
    const bool known = std::find(families.begin(), families.end(), scene) != families.end();
    if (row.number("n_scenes") > 1 && !known) families.push_back(scene);
  }
  return families;
}

std::string slope_contrast(const Summary& summary, std::string_view mark) {
  const std::vector<std::string> families = line_families(summary);
  if (families.size() < 2) return {};
  const auto name = [&](const std::string& text) { return fmt::format("{}{}{}", mark, text, mark); };
  std::vector<std::string> names;
  for (const std::string& family : families) names.push_back(name(family));

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Cases cases(summary.slopes);
  std::string out;
  for (const Reconstruction& kernel : cases.kernels()) {
    std::vector<Slopes> patterns;
    for (const std::string& pattern : cases.patterns()) {
      std::vector<std::string> values;
      double largest_lo = -kInfinity, smallest_hi = kInfinity;
      for (const std::string& family : families) {
        const Row* row = cases.first(family, pattern, kernel);
        if (row == nullptr) continue;
        values.push_back(fmt::format("{:.2f}", row->number("slope")));
        largest_lo = std::fmax(largest_lo, row->number("slope_lo"));
        smallest_hi = std::fmin(smallest_hi, row->number("slope_hi"));
      }
      if (values.size() < families.size()) continue;
      patterns.push_back({join(values, " / ") + " for " + name(pattern), largest_lo > smallest_hi});
    }
    std::vector<std::string> parts;
    for (const bool apart : {true, false}) {
      std::vector<std::string> texts;
      for (const Slopes& p : patterns) {
        if (p.apart == apart) texts.push_back(p.text);
      }
      if (texts.empty()) continue;
      parts.push_back(join(texts, ", ") + (apart ? " (95% intervals apart)" : " (95% intervals meet)"));
    }
    if (parts.empty()) continue;
    out += fmt::format("Random edges, {}: with N samples per pixel the error falls as N^s. On {} s is {}.\n\n",
                       name(kernel.label()), join(names, " / "), join(parts, "; and "));
  }
  return out;
}

}  // namespace moire
