// What a study of images says of discrepancies.
#include "reports/discrepancy_prediction.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "reports/markdown_table.h"
#include "study/columns.h"

namespace moire {
namespace {

std::string number(const Row& row, const std::string& name, const char* format) {
  const double value = row.number(name), lo = row.number(name + "_lo"), hi = row.number(name + "_hi");
  if (!std::isfinite(value)) return "-";
  const auto text = [&](double v) { return fmt::format(fmt::runtime(format), v); };
  return text(value) + (std::isfinite(lo) ? " [" + text(lo) + ", " + text(hi) + "]" : "");
}

// The name, with the estimator where it is not the usual one.
std::string kernel_of(const Row& row) {
  const std::string_view estimator = row.text("estimator");
  return markdown_code(row.text("filter")) + (estimator == "ratio" ? "" : ", " + std::string(estimator));
}

std::string edge_ratios(const Table& rows) {
  std::vector<std::vector<std::string>> lines{
      {"scene", "samples", "filter", "samples per pixel", "RMSE, hit and other active pixels", "ratio"}};
  for (const Row& row : rows) {
    if (!std::isfinite(row.number("edge_ratio"))) continue;
    lines.push_back({markdown_code(row.text("scene")), markdown_code(sampler_of(row)), kernel_of(row),
                     number(row, "spp", "{:.0f}"), number(row, "rmse_active", "{:.3g}"),
                     number(row, "edge_ratio", "{:.3f}")});
  }
  if (lines.size() == 1) return "";
  return "## Edges: squared error over squared edge discrepancy\n\n"
         "Of the pixels that the edge hits: the mean of the squared error over the mean of edge-l2^2 of the same "
         "pixels' own samples, with its 95% interval over lines (over trials where there is one line). For lines that "
         "are drawn by the invariant measure it is 1, whatever the pattern; other lines, such as axis-aligned ones, "
         "see other discrepancies.\n\n" +
         markdown_table(lines);
}

std::string correlations(const Table& rows) {
  if (rows.empty()) return "";
  std::vector<std::vector<std::string>> lines{
      {"scene", "filter", "layout", "discrepancy", "points", "correlation", "at equal samples", "slope"}};
  for (const Row& row : rows) {
    lines.push_back({markdown_code(row.text("scene")), kernel_of(row), std::string(row.text("layout")),
                     markdown_code(row.text("discrepancy")), number(row, "points", "{:.0f}"),
                     number(row, "correlation", "{:.3f}"), number(row, "same_n_correlation", "{:.3f}"),
                     number(row, "slope", "{:.2f}")});
  }
  return "## Does discrepancy predict error?\n\n"
         "Correlation of log RMSE (active pixels) with log T of the pattern's set, over all patterns and sample counts "
         "of the scene (95% interval); `_3d`: points in x, y and t. At equal samples: with the means at each sample "
         "count taken off, which leaves the order of the patterns. Slope: of log RMSE against log T.\n\n" +
         markdown_table(lines);
}

}  // namespace

std::string discrepancy_prediction(const Summary& summary) {
  return edge_ratios(summary.rows) + correlations(summary.correlations);
}

}  // namespace moire
