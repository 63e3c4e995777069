// Estimators side by side.
#include "reports/estimator_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/markdown_table.h"
#include "study/cases.h"

namespace moire {
namespace {

void add_new(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

// The error, and over that of the first estimator; "-" where there is none.
std::string cell(const Row* row, const Row* first) {
  const double error = row == nullptr ? std::nan("") : row->number("rmse_active");
  if (!std::isfinite(error)) return "-";
  std::string text = fmt::format("{:.2e}", error);
  if (row == first || first == nullptr || !(first->number("rmse_active") > 0)) return text;
  return text + fmt::format(" (x {:.2f})", error / first->number("rmse_active"));
}

std::string table(const Cases& cases, const std::string& scene, const std::string& pattern,
                  const std::vector<std::string>& filters, const std::vector<std::string>& estimators) {
  std::vector<std::vector<std::string>> lines{{"filter", "samples per pixel"}};
  for (const std::string& estimator : estimators) lines[0].push_back(markdown_code(estimator));
  for (const std::string& filter : filters) {
    for (const std::int64_t spp : cases.spp()) {
      const Row* first = cases.first(scene, pattern, {filter, estimators.front()}, spp);
      std::vector<std::string> line{markdown_code(filter), std::to_string(spp)};
      bool any = false;
      for (const std::string& estimator : estimators) {
        const Row* row = cases.first(scene, pattern, {filter, estimator}, spp);
        any = any || row != nullptr;
        line.push_back(cell(row, first));
      }
      if (any) lines.push_back(std::move(line));
    }
  }
  return lines.size() > 1 ? markdown_table(lines) : std::string();
}

}  // namespace

std::string estimator_comparison(const Summary& summary) {
  const Cases cases(summary.rows);
  std::vector<std::string> filters, estimators;
  for (const Reconstruction& kernel : cases.kernels()) {
    add_new(filters, kernel.filter);
    add_new(estimators, kernel.estimator);
  }
  if (estimators.size() < 2) return {};
  std::string out = fmt::format(
      "## Estimators compared\n\n"
      "RMSE over active pixels, and in brackets over that of {}. At equal samples per pixel; `importance` draws them "
      "for each pixel alone, the others share each among all pixels whose windows hold it. Intervals are in the tables "
      "of the patterns below.\n\n",
      markdown_code(estimators.front()));
  const bool any_importance = std::any_of(estimators.begin(), estimators.end(),
                                          [](const std::string& name) { return name.starts_with("importance"); });
  if (any_importance) {
    out +=
        "`importance` draws a pixel's samples as dense as |k| is large, k the filter, and takes the integral of |k| "
        "times the mean of their values, each with the sign of k there: unbiased. `importance:form=ratio` divides the "
        "signed sum by the sum of the signs instead, which is exact where the scene is flat. Under filters without "
        "negative values the two are the same.\n\n";
  }
  for (const std::string& scene : cases.scenes()) {
    for (const std::string& pattern : cases.patterns()) {
      const std::string lines = table(cases, scene, pattern, filters, estimators);
      if (lines.empty()) continue;
      out += "### Estimators on " + markdown_code(scene) + ", " + markdown_code(pattern) + "\n\n" + lines;
    }
  }
  return out;
}

}  // namespace moire
