// Filters side by side.
#include "reports/filter_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/markdown_table.h"
#include "study/cases.h"
#include "study/columns.h"

namespace moire {
namespace {

using Line = std::vector<std::string>;

std::string number_text(const Row* row, const char* name, const char* format) {
  const double value = row == nullptr ? std::nan("") : row->number(name);
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

// An error with the end of its interval that is further away in the ratio, as a factor.
std::string error_text(const Row* row, const std::string& name) {
  std::string text = number_text(row, name.c_str(), "{:.2e}");
  if (row == nullptr) return text;
  const double factor = row->number(name + "_hi") / row->number(name);
  if (std::isfinite(factor)) text += fmt::format(" x/ {:.2f}", factor);
  return text;
}

std::string label_of(const Row& row) {
  return markdown_code(Reconstruction{std::string(row.text("filter")), std::string(row.text("estimator"))}.label());
}

std::vector<const Row*> ranked(const Summary& summary, const std::string& pattern, std::int64_t spp, const char* rank) {
  std::vector<const Row*> order;
  for (const Row& row : summary.filters) {
    if (sampler_of(row) == pattern && row.number("spp") == static_cast<double>(spp)) order.push_back(&row);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](const Row* a, const Row* b) { return a->number(rank) < b->number(rank); });
  return order;
}

// The interval of the ratio to the first holds 1.
bool ties_with_first(const Row& row, const std::string& value) {
  return row.number(value + "_lo") <= 1 && row.number(value + "_hi") >= 1;
}

std::string ranking(const Summary& summary, const Cases& cases, std::int64_t spp) {
  struct Column {
    std::vector<const Row*> order;
    const char* value;
  };
  Line head{"rank"};
  std::vector<Column> columns;
  std::size_t length = 0;
  for (const std::string& pattern : cases.patterns()) {
    for (const auto& [what, rank, value] : {std::tuple("total", "rank_total", "relative_total"),
                                            std::tuple("sampling", "rank_sampling", "relative_sampling")}) {
      columns.push_back({ranked(summary, pattern, spp, rank), value});
      head.push_back(fmt::format("{}, {}", what, markdown_code(pattern)));
      length = std::max(length, columns.back().order.size());
    }
  }
  std::vector<Line> lines{head};
  for (std::size_t i = 0; i < length; ++i) {
    Line line{std::to_string(i + 1)};
    for (const Column& c : columns) {
      line.push_back(i < c.order.size() ? label_of(*c.order[i]) + number_text(c.order[i], c.value, " {:.2f}") +
                                              (i > 0 && ties_with_first(*c.order[i], c.value) ? " =" : "")
                                        : "-");
    }
    lines.push_back(std::move(line));
  }
  return markdown_table(lines);
}

// Every filter on one scene, the smallest total error with the first pattern first.
std::string scene_table(const Cases& cases, const std::string& scene, std::int64_t spp) {
  const auto row_of = [&](const std::string& pattern, const Reconstruction& kernel) {
    return cases.first(scene, pattern, kernel, spp);
  };
  std::vector<Reconstruction> kernels = cases.kernels();
  const auto total_of = [&](const Reconstruction& kernel) {
    const Row* row = row_of(cases.patterns().front(), kernel);
    const double total = row == nullptr ? std::nan("") : row->number("rmse_coverage_all");
    return std::isfinite(total) ? total : HUGE_VAL;
  };
  std::stable_sort(kernels.begin(), kernels.end(),
                   [&](const Reconstruction& a, const Reconstruction& b) { return total_of(a) < total_of(b); });

  // Columns of the flat field and of ringing are there if the study measured them.
  const Row* any = row_of(cases.patterns().front(), kernels.front());
  const bool flat = any != nullptr && any->find("flat_field_rms") != nullptr;
  const bool ringing = any != nullptr && any->find("overshoot_exact") != nullptr;
  Line head{"filter", "filter's own"};
  if (ringing) head.insert(head.end(), {"overshoot", "ringing RMS"});
  for (const std::string& pattern : cases.patterns()) {
    for (const char* what : {"sampling", "total"}) head.push_back(fmt::format("{}, {}", what, markdown_code(pattern)));
    if (flat) head.push_back("flat field, " + markdown_code(pattern));
    if (ringing) head.push_back("overshoot, " + markdown_code(pattern));
  }
  std::vector<Line> lines{head};
  for (const Reconstruction& kernel : kernels) {
    Line line;
    for (const std::string& pattern : cases.patterns()) {
      const Row* row = row_of(pattern, kernel);
      if (line.empty()) {
        line = {markdown_code(kernel.label()), number_text(row, "rmse_filter_all", "{:.2e}")};
        if (ringing) line.push_back(number_text(row, "overshoot_exact", "{:.4f}"));
        if (ringing) line.push_back(number_text(row, "ringing_rms_exact", "{:.2e}"));
      }
      line.push_back(error_text(row, "rmse_all"));
      line.push_back(error_text(row, "rmse_coverage_all"));
      if (flat) line.push_back(number_text(row, "flat_field_rms", "{:.2e}"));
      if (ringing) line.push_back(number_text(row, "overshoot_got", "{:.4f}"));
    }
    lines.push_back(std::move(line));
  }
  return markdown_table(lines);
}

}  // namespace

std::string filter_comparison(const Summary& summary) {
  const Cases cases(summary.rows);
  if (summary.filters.empty() || cases.kernels().size() < 2) return {};
  const std::int64_t spp = cases.spp().back();
  std::string out = fmt::format("## Filters compared, at {} samples per pixel\n\n", spp);
  out +=
      "Three errors, all RMSE over all pixels of the image (a wide filter has more active pixels, and flatter ones, so "
      "that a mean over active pixels would flatter it):\n\n"
      "- *sampling*: image - the filter's own exact image, what the samples miss. The more a filter blurs, the more "
      "samples share in each pixel, and the smaller it is;\n"
      "- *filter's own*: the exact image - box coverage, what the filter changes without any sampling;\n"
      "- *total*: image - box coverage. The yardstick is the box filter itself, whose own change is nothing by "
      "definition: with many samples this is the distance to the box. It judges neither sharpness nor aliasing, for "
      "which the metrics of the filters are below.\n\n"
      "### Ranking over the scenes\n\n"
      "The error over that of the first, geometric mean over scenes and trials; `=` where the 95% interval of the "
      "ratio "
      "(over trials, paired) holds 1.\n\n";
  out += ranking(summary, cases, spp);
  for (const std::string& scene : cases.scenes()) {
    out += "### Filters on " + markdown_code(scene) + "\n\n" + scene_table(cases, scene, spp);
  }
  out +=
      "`x/`: the upper end of the 95% interval over trials, as a factor. Overshoot: the largest value above 1, of the "
      "exact image and of the images of each pattern (largest over trials). Ringing RMS: what of the exact image lies "
      "outside [0, 1]. Flat field: RMS of a pixel's weight sum around 1 on a constant scene, which the ratio estimator "
      "divides out and the unnormalised one shows.\n\n";
  return out;
}

}  // namespace moire
