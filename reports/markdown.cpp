// The report as Markdown.
#include "reports/markdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "reports/contrast.h"
#include "reports/discrepancy_prediction.h"
#include "reports/estimator_comparison.h"
#include "reports/filter_comparison.h"
#include "reports/filter_table.h"
#include "reports/markdown_table.h"
#include "reports/noise_report.h"
#include "study/cases.h"
#include "study/columns.h"
#include "study/scene_file.h"

namespace moire {
namespace {

constexpr const char kNone[] = "-";

std::string bracketed(const Row& row, const std::string& name, const char* format) {
  const double lo = row.number(name + "_lo"), hi = row.number(name + "_hi");
  if (!std::isfinite(lo) || !std::isfinite(hi)) return {};
  return fmt::format(" [{}, {}]", fmt::format(fmt::runtime(format), lo), fmt::format(fmt::runtime(format), hi));
}

std::string error_text(const Row* row) {
  if (row == nullptr || !std::isfinite(row->number("rmse_active"))) return kNone;
  return fmt::format("{:.2e}", row->number("rmse_active")) + bracketed(*row, "rmse_active", "{:.2e}") +
         (row->flag("reference_limited") ? " ~" : "");
}

std::string slope_text(const Row* row) {
  if (row == nullptr || !std::isfinite(row->number("slope"))) return kNone;
  return fmt::format("{:.3f}", row->number("slope")) + bracketed(*row, "slope", "{:.3f}");
}

// A table with one column per kernel; of many kernels, with one line for each.
void add_table(std::string& out, const std::string& corner, const std::vector<Reconstruction>& kernels,
               const std::vector<std::pair<std::string, std::function<std::string(const Reconstruction&)>>>& lines) {
  constexpr std::size_t kMostColumns = 6;
  std::vector<std::vector<std::string>> table;
  if (kernels.size() <= kMostColumns) {
    table.push_back({corner});
    for (const Reconstruction& k : kernels) table[0].push_back(markdown_code(k.label()));
    for (const auto& [head, cell] : lines) {
      table.push_back({head});
      for (const Reconstruction& k : kernels) table.back().push_back(cell(k));
    }
  } else {
    table.push_back({"filter \\ " + corner});
    for (const auto& [head, cell] : lines) table[0].push_back(head);
    for (const Reconstruction& k : kernels) {
      table.push_back({markdown_code(k.label())});
      for (const auto& [head, cell] : lines) table.back().push_back(cell(k));
    }
  }
  out += markdown_table(table);
}

std::string list(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + markdown_code(name);
  return out;
}

struct Report {
  const Cases& raw;
  const Cases& cases;
  const Cases& slopes;
  // The largest sample count of each scene.
  std::map<std::string, std::int64_t> largest_spp;
};

std::map<std::string, std::int64_t> largest_counts(const Table& summary) {
  std::map<std::string, std::int64_t> largest;
  for (const Row& row : summary) {
    std::int64_t& n = largest[std::string(row.text("scene"))];
    n = std::max(n, static_cast<std::int64_t>(row.number("spp")));
  }
  return largest;
}

std::int64_t largest_count(const Report& r, const std::string& scene) {
  const auto at = r.largest_spp.find(scene);
  return at == r.largest_spp.end() ? 0 : at->second;
}

void add_what_was_run(std::string& out, const Table& rows, const Report& r) {
  std::vector<std::string> filters, estimators, spp;
  for (const Reconstruction& k : r.raw.kernels()) {
    if (std::find(filters.begin(), filters.end(), k.filter) == filters.end()) filters.push_back(k.filter);
    if (std::find(estimators.begin(), estimators.end(), k.estimator) == estimators.end()) {
      estimators.push_back(k.estimator);
    }
  }
  for (const std::int64_t n : r.raw.spp()) spp.push_back(std::to_string(n));
  double trials = 0;
  for (const Row& row : rows) trials = std::fmax(trials, row.number("trial") + 1);

  out += "## What was run\n\n";
  for (const std::string& scene : r.raw.scenes()) {
    out += "- scene " + markdown_code(scene);
    std::set<std::string_view> lines;
    const Row* row = nullptr;
    for (const Row& x : rows) {
      if (scene_family(x.text("scene")) != scene) continue;
      if (row == nullptr) row = &x;
      if (x.text("scene") != scene) lines.insert(x.text("scene"));
    }
    if (std::isfinite(row->number("width"))) {
      out += fmt::format(": {:.0f} x {:.0f} pixels", row->number("width"), row->number("height"));
    }
    if (!lines.empty()) out += fmt::format(", {} random edges", lines.size());
    out += "\n";
  }
  out += "- patterns: " + list(r.raw.patterns()) + "\n";
  out += "- samples per pixel: " + fmt::format("{}", fmt::join(spp, ", ")) + "\n";
  out += "- filters: " + list(filters) + "\n";
  out += "- estimators: " + list(estimators) + "\n";
  out += fmt::format("- trials: {:.0f} of patterns that vary, 1 of others", trials);
  if (!rows.empty() && rows.front().find("seed") != nullptr) {
    const Cell& seed = *rows.front().find("seed");
    if (const auto* number = std::get_if<std::int64_t>(&seed)) out += fmt::format("; seed {}", *number);
    if (const auto* text = std::get_if<std::string>(&seed)) out += "; seed " + *text;
  }
  out += fmt::format("\n- rows: {}", rows.size());
  const auto bad = std::count_if(rows.begin(), rows.end(), [](const Row& row) {
    return !row.text("status").empty() && row.text("status") != "ok";
  });
  if (bad > 0) out += fmt::format(", of which {} are not ok (see `status` in results.csv)", bad);
  out += "\n\n";
}

// What a study of random edges is for: their rates side by side.
void add_contrast(std::string& out, const Summary& summary, const Report& r) {
  const std::string text = slope_contrast(summary, "`");
  if (text.empty()) return;
  out += text;
  const std::vector<std::string> families = line_families(summary);
  for (const Reconstruction& kernel : r.slopes.kernels()) {
    out += "| slope, " + markdown_code(kernel.label()) + " |";
    for (const std::string& family : families) out += " " + markdown_code(family) + " |";
    out += "\n|:--|";
    for (std::size_t i = 0; i < families.size(); ++i) out += ":--|";
    out += "\n";
    for (const std::string& pattern : r.slopes.patterns()) {
      out += "| " + markdown_code(pattern) + " |";
      for (const std::string& family : families) {
        out += " " + slope_text(r.slopes.first(family, pattern, kernel)) + " |";
      }
      out += "\n";
    }
    out += "\n";
  }
}

// Patterns by their error at the largest sample count, best first; those without a value are not ranked.
std::vector<const Row*> ranked(const Report& r, const std::string& scene, const Reconstruction& kernel) {
  std::vector<const Row*> order;
  for (const std::string& pattern : r.cases.patterns()) {
    const Row* row = r.cases.first(scene, pattern, kernel, largest_count(r, scene));
    if (row != nullptr && std::isfinite(row->number("rmse_active"))) order.push_back(row);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Row* a, const Row* b) { return a->number("rmse_active") < b->number("rmse_active"); });
  return order;
}

// Where an interval is missing, the value itself stands for it.
double end_or_value(const Row& row, const char* name) {
  return std::isfinite(row.number(name)) ? row.number(name) : row.number("rmse_active");
}

void add_ranking(std::string& out, const Report& r) {
  std::set<std::int64_t> counts;
  for (const auto& [scene, n] : r.largest_spp) counts.insert(n);
  out += fmt::format("## The answer: patterns by error at {} samples per pixel\n\n", fmt::join(counts, " or "));
  out +=
      "RMSE over active pixels (those that the scene's boundary may touch), full coverage = 1; `=` where the 95% "
      "interval meets that of the best.\n\n";
  for (const std::string& scene : r.cases.scenes()) {
    out += "### " + markdown_code(scene) +
           (counts.size() > 1 ? fmt::format(", {} samples per pixel", largest_count(r, scene)) : std::string()) +
           "\n\n";
    std::vector<std::pair<std::string, std::function<std::string(const Reconstruction&)>>> lines;
    std::size_t ranks = 0;
    for (const Reconstruction& kernel : r.cases.kernels()) ranks = std::max(ranks, ranked(r, scene, kernel).size());
    for (std::size_t rank = 0; rank < ranks; ++rank) {
      lines.emplace_back(std::to_string(rank + 1), [&r, &scene, rank](const Reconstruction& kernel) -> std::string {
        const auto order = ranked(r, scene, kernel);
        if (rank >= order.size()) return kNone;
        const Row &row = *order[rank], &best = *order[0];
        const bool close = rank > 0 && end_or_value(row, "rmse_active_lo") <= end_or_value(best, "rmse_active_hi");
        return markdown_code(sampler_of(row)) + fmt::format(" {:.2e}", row.number("rmse_active")) + (close ? " =" : "");
      });
    }
    add_table(out, "rank", r.cases.kernels(), lines);
  }
}

// The worst pixel of all trials at the largest sample count.
std::string worst_text(const Report& r, const std::string& scene, const std::string& pattern,
                       const Reconstruction& kernel) {
  const Row* worst = nullptr;
  for (const Row* row : r.raw.at(scene, pattern, kernel, largest_count(r, scene))) {
    const double size = row->number("max_abs_active");
    if (std::isfinite(size) && (worst == nullptr || size > worst->number("max_abs_active"))) worst = row;
  }
  if (worst == nullptr || !std::isfinite(worst->number("max_x_active"))) return kNone;
  const std::string line = worst->text("scene") == scene ? "" : " of " + markdown_code(worst->text("scene"));
  return fmt::format("({:.0f}, {:.0f}){}: got {:.6f}, exact {:.6f}", worst->number("max_x_active"),
                     worst->number("max_y_active"), line, worst->number("max_got_active"),
                     worst->number("max_want_active"));
}

// The image of the first trial that has one, at the largest sample count.
std::string image_text(const Report& r, const std::string& scene, const std::string& pattern,
                       const Reconstruction& kernel, const char* column, const char* what) {
  for (const Row* row : r.raw.at(scene, pattern, kernel, largest_count(r, scene))) {
    if (!row->text(column).empty()) return fmt::format("![{}]({})", what, row->text(column));
  }
  return kNone;
}

void add_pattern(std::string& out, const Report& r, const std::string& pattern) {
  out += "## " + markdown_code(pattern) + "\n\n";
  for (const std::string& scene : r.cases.scenes()) {
    const auto& kernels = r.cases.kernels();
    const bool any = std::any_of(kernels.begin(), kernels.end(), [&](const Reconstruction& k) {
      return std::any_of(r.cases.spp().begin(), r.cases.spp().end(),
                         [&](std::int64_t spp) { return r.cases.first(scene, pattern, k, spp) != nullptr; });
    });
    if (!any) continue;
    out += "### " + markdown_code(pattern) + " on " + markdown_code(scene) + "\n\n";
    std::vector<std::pair<std::string, std::function<std::string(const Reconstruction&)>>> lines;
    for (const std::int64_t spp : r.cases.spp()) {
      if (std::none_of(kernels.begin(), kernels.end(),
                       [&](const Reconstruction& k) { return r.cases.first(scene, pattern, k, spp) != nullptr; })) {
        continue;
      }
      lines.emplace_back(std::to_string(spp), [&, spp](const Reconstruction& k) {
        return error_text(r.cases.first(scene, pattern, k, spp));
      });
    }
    lines.emplace_back("slope", [&](const Reconstruction& k) { return slope_text(r.slopes.first(scene, pattern, k)); });
    lines.emplace_back("worst pixel", [&](const Reconstruction& k) { return worst_text(r, scene, pattern, k); });
    for (const auto& [column, what] : {std::pair("image_got_png", "image"), std::pair("image_error_png", "error")}) {
      const auto image = [&r, &scene, &pattern, column = column, what = what](const Reconstruction& k) {
        return image_text(r, scene, pattern, k, column, what);
      };
      if (std::any_of(kernels.begin(), kernels.end(), [&](const Reconstruction& k) { return image(k) != kNone; })) {
        lines.emplace_back(what, image);
      }
    }
    add_table(out, "samples per pixel", kernels, lines);
  }
}

// The kernels themselves.
void add_filters(std::string& out, const Table& filters) {
  if (filters.empty()) return;
  auto lines = filter_cells(filters);
  for (std::size_t i = 1; i < lines.size(); ++i) lines[i][0] = markdown_code(lines[i][0]);
  out += "### The filters themselves\n\n" + markdown_table(lines);
  for (const ColumnMeaning& column : filter_columns()) out += "- " + column.head + ": " + column.meaning + "\n";
  out += "\n";
}

void add_notes(std::string& out, const Summary& summary) {
  out += "## How to read this\n\n";
  out +=
      "- Errors are got - exact; RMSE is the root of the mean squared error over active pixels and trials. Brackets "
      "hold 95% intervals over trials; the method is in `ci_method` of summary.csv. One trial has no interval.\n";
  out +=
      "- The slope is that of log RMSE against log samples per pixel (-0.5: Monte Carlo), by least squares; its "
      "interval comes from resampling whole trials.\n";
  out +=
      "- Worst pixel (x, y) and images: at the scene's largest sample count. Error images: blue is too little, light "
      "grey is exact, red is too much; the range (99.5% of |error| over active pixels, either side) is "
      "in the file's text chunk `moire:range`.\n";
  if (!line_families(summary).empty()) {
    out +=
        "- Random edges that one table of the study draws count as one scene. Their errors are pooled over all pixels "
        "that the edges hit; their intervals are over edges, all pixels and trials of an edge taken together.\n";
  }
  out += "- `~`: below 10 times the exact values' own error bound; such errors are no points of a slope.\n";
  bool first = true;
  for (const Row& row : summary.slopes) {
    if (row.text("left_out").empty()) continue;
    if (first) out += "- Sample counts left out of slopes:\n";
    first = false;
    out += "  - " + markdown_code(sampler_of(row)) + " on " + markdown_code(row.text("scene")) + ", " +
           markdown_code(row.text("filter")) + ": " + std::string(row.text("left_out")) + "\n";
  }
}

}  // namespace

std::string markdown_report(std::string_view study_name, const Table& rows, const Summary& summary,
                            const Table& filters) {
  const Cases raw(rows), cases(summary.rows), slopes(summary.slopes);
  const Report report{raw, cases, slopes, largest_counts(summary.rows)};
  std::string out = "# " + std::string(study_name) + "\n\n";
  if (rows.empty()) return out + "No rows.\n";
  add_contrast(out, summary, report);
  out += filter_comparison(summary);
  out += estimator_comparison(summary);
  add_filters(out, filters);
  out += noise_report(summary);
  if (!summary.rows.empty()) add_ranking(out, report);
  out += discrepancy_prediction(summary);
  add_what_was_run(out, rows, report);
  for (const std::string& pattern : cases.patterns()) add_pattern(out, report, pattern);
  add_notes(out, summary);
  return out;
}

}  // namespace moire
