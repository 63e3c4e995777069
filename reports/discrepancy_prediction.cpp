// What a study of images says of discrepancies.
#include "reports/discrepancy_prediction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "reports/markdown_table.h"
#include "study/columns.h"
#include "study/discrepancy_measure.h"

namespace moire {
namespace {

using Lines = std::vector<std::vector<std::string>>;

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

// Rows that have the cell, by scene, filter and estimator.
std::map<std::string, std::vector<const Row*>> by_scene(const Table& rows, const std::string& cell) {
  std::map<std::string, std::vector<const Row*>> groups;
  for (const Row& row : rows) {
    if (std::isfinite(row.number(cell))) {
      groups[markdown_code(row.text("scene")) + ", " + kernel_of(row)].push_back(&row);
    }
  }
  return groups;
}

// A line per pattern (and layout), a column per count; `cell` is one row's text.
template <class F>
Lines by_count(const std::vector<const Row*>& rows, F&& cell) {
  std::set<double> counts;
  std::vector<std::string> samplers;
  std::map<std::pair<std::string, double>, const Row*> at;
  for (const Row* row : rows) {
    const std::string sampler = sampler_of(*row);
    counts.insert(row->number("spp"));
    if (std::find(samplers.begin(), samplers.end(), sampler) == samplers.end()) samplers.push_back(sampler);
    at[{sampler, row->number("spp")}] = row;
  }
  Lines lines{{"samples per pixel"}};
  for (const double n : counts) lines[0].push_back(fmt::format("{:.0f}", n));
  for (const std::string& sampler : samplers) {
    lines.push_back({markdown_code(sampler)});
    for (const double n : counts) {
      const auto found = at.find({sampler, n});
      lines.back().push_back(found == at.end() ? "-" : cell(*found->second));
    }
  }
  return lines;
}

std::string edge_ratios(const Table& rows) {
  const auto groups = by_scene(rows, "edge_ratio");
  if (groups.empty()) return "";
  std::string out =
      "## Edges: squared error over squared edge discrepancy\n\n"
      "Of the pixels that the edge hits: the mean of the squared error over the mean of edge-l2^2 of the same pixels' "
      "own samples, with its 95% interval over lines (over trials where there is one line). For lines that are drawn "
      "by the invariant measure it is 1, whatever the pattern; other lines, such as axis-aligned ones, see other "
      "discrepancies. The patterns share the lines, so that their ratios are not independent.\n\n";
  for (const auto& [name, members] : groups) {
    std::int64_t with = 0, held = 0;
    for (const Row* row : members) {
      const double lo = row->number("edge_ratio_lo"), hi = row->number("edge_ratio_hi");
      with += std::isfinite(lo);
      held += lo <= 1 && 1 <= hi;
    }
    out += "### " + name + "\n\n" +
           (with > 0 ? fmt::format("{} of {} intervals hold 1.\n\n", held, with) : std::string()) +
           markdown_table(by_count(members, [](const Row& row) { return number(row, "edge_ratio", "{:.3f}"); }));
  }
  return out;
}

// Images of both layouts side by side.
std::string layouts(const Table& rows) {
  std::vector<const Row*> pixel, image;
  for (const Row& row : rows) {
    if (std::isfinite(row.number("edge_ratio"))) (row.text("layout") == "image" ? image : pixel).push_back(&row);
  }
  Lines lines{{"scene", "filter", "pattern", "samples per pixel", "in each pixel", "over the image", "quotient"}};
  for (const Row* i : image) {
    for (const Row* p : pixel) {
      const auto same = [&](const char* name) { return i->text(name) == p->text(name); };
      if (!same("scene") || !same("filter") || !same("estimator") || !same("pattern") ||
          i->number("spp") != p->number("spp")) {
        continue;
      }
      lines.push_back({markdown_code(i->text("scene")), kernel_of(*i), markdown_code(i->text("pattern")),
                       number(*i, "spp", "{:.0f}"), number(*p, "rmse_active", "{:.3f}"),
                       number(*i, "rmse_active", "{:.3f}"),
                       fmt::format("{:.2f}", i->number("rmse_active") / p->number("rmse_active"))});
    }
  }
  if (lines.size() == 1) return "";
  return "## What stratification into pixels does\n\nRMSE with the pattern in each pixel, with one set over the whole "
         "image, and the second over the first. Over the image, a pixel may get no sample at all, or several.\n\n" +
         markdown_table(lines);
}

std::string errors_beside(const Table& rows) {
  std::string out;
  for (const DiscrepancyInfo& info : discrepancies()) {
    for (const bool with_time : {false, true}) {
      const std::string column = discrepancy_column(info, with_time);
      for (const auto& [name, members] : by_scene(rows, column)) {
        out += "### " + markdown_code(column) + ": " + name + "\n\n" +
               markdown_table(by_count(members, [&](const Row& row) {
                 const double error = row.number("rmse_active"), discrepancy = row.number(column);
                 return fmt::format("{:.3g} / {:.3g} = {:.2f}", error, discrepancy, error / discrepancy);
               }));
      }
    }
  }
  return out;
}

std::string correlations(const Summary& summary) {
  if (summary.correlations.empty()) return "";
  Lines lines{{"scene", "filter", "discrepancy", "points", "correlation", "at equal samples", "slope"}};
  for (const Row& row : summary.correlations) {
    lines.push_back({markdown_code(row.text("scene")), kernel_of(row), markdown_code(row.text("discrepancy")),
                     number(row, "points", "{:.0f}"), number(row, "correlation", "{:.3f}"),
                     number(row, "same_n_correlation", "{:.3f}"), number(row, "slope", "{:.2f}")});
  }
  return "## Does discrepancy predict error?\n\n"
         "Correlation of log RMSE (active pixels) with log T of the pattern, over its patterns and sample counts; "
         "`_3d`: points in x, y and t. T is known by theory or the root mean square over 100 sets. At equal samples: "
         "with the means at each count taken off, which leaves the order of the patterns. Slope: of log RMSE against "
         "log T. With isotropic edges and a box filter, edge_l2 must predict all there is; the others say how far it "
         "carries.\n\n" +
         markdown_table(lines) + "RMSE over T:\n\n" + errors_beside(summary.rows);
}

}  // namespace

std::string discrepancy_prediction(const Summary& summary) {
  return edge_ratios(summary.rows) + layouts(summary.rows) + correlations(summary);
}

}  // namespace moire
