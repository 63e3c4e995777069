// The answer on a terminal.
#include "reports/terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "reports/contrast.h"
#include "reports/noise_report.h"
#include "reports/text_table.h"
#include "study/cases.h"
#include "study/columns.h"

namespace moire {
namespace {

constexpr std::size_t kWidth = 110;  // of running text, in characters

TextEntry error_entry(const Row* row) {
  const double rmse = row == nullptr ? std::nan("") : row->number("rmse_active");
  if (!std::isfinite(rmse)) return {"-", std::nan("")};
  return {fmt::format("{:.2e}{}", rmse, row->flag("reference_limited") ? "~" : ""), rmse};
}

TextEntry slope_entry(const Row* row) {
  const double slope = row == nullptr ? std::nan("") : row->number("slope");
  if (!std::isfinite(slope)) return {"-", std::nan("")};
  const double half = (row->number("slope_hi") - row->number("slope_lo")) / 2;
  // Without an interval: as wide as with one, so that the slopes line up.
  return {fmt::format("{:.2f}", slope) + (std::isfinite(half) ? fmt::format(" +-{:.2f}", half) : std::string(7, ' ')),
          slope};
}

// How the tables of a study are laid out: the patterns of each scene and filter under each other; with many filters,
// the filters of each scene and pattern.
struct Lines {
  std::string title, corner;
  std::vector<std::tuple<std::string, std::string, Reconstruction>> keys;  // head of the line, pattern, kernel
};

std::vector<Lines> lines_of(const Cases& cases) {
  constexpr std::size_t kManyFilters = 6;
  std::vector<Lines> all;
  if (cases.kernels().size() <= std::max(kManyFilters, cases.patterns().size())) {
    for (const Reconstruction& kernel : cases.kernels()) {
      all.push_back({kernel.label(), "pattern", {}});
      for (const std::string& pattern : cases.patterns()) all.back().keys.emplace_back(pattern, pattern, kernel);
    }
  } else {
    for (const std::string& pattern : cases.patterns()) {
      all.push_back({pattern, "filter", {}});
      for (const Reconstruction& kernel : cases.kernels())
        all.back().keys.emplace_back(kernel.label(), pattern, kernel);
    }
  }
  return all;
}

// The ranking of filters at the largest sample count: for each pattern, filters by total error.
std::string ranking(const Summary& summary, const Cases& cases, bool bold) {
  if (summary.filters.empty()) return {};
  const double none = std::nan("");
  const auto largest = static_cast<double>(cases.spp().back());
  std::string text;
  for (const std::string& pattern : cases.patterns()) {
    TextLines lines{{{"filter", none}, {"total", none}, {"rank", none}, {"sampling", none}, {"rank", none}}};
    for (const Row& row : summary.filters) {
      if (sampler_of(row) != pattern || row.number("spp") != largest) continue;
      const Reconstruction kernel{std::string(row.text("filter")), std::string(row.text("estimator"))};
      const auto entry = [&](const char* name) {
        return TextEntry{fmt::format("{:.2f}", row.number(name)), row.number(name)};
      };
      const auto rank = [&](const char* name) { return TextEntry{fmt::format("{:.0f}", row.number(name)), none}; };
      lines.push_back({{kernel.label(), none},
                       entry("relative_total"),
                       rank("rank_total"),
                       entry("relative_sampling"),
                       rank("rank_sampling")});
    }
    if (lines.size() < 3) continue;
    text += fmt::format("filters over all scenes, {}, {} samples per pixel\n", pattern, cases.spp().back()) +
            text_table(lines, bold) + "\n";
  }
  if (text.empty()) return text;
  return text +
         "total: image - box coverage; sampling: image - the filter's exact image; RMSE over all pixels, over that of "
         "the\nfirst, geometric mean over scenes and trials\n\n";
}

}  // namespace

std::string terminal_tables(const Summary& summary, bool bold) {
  const Cases cases(summary.rows), slopes(summary.slopes);
  const double none = std::nan("");
  std::string text =
      wrapped(slope_contrast(summary, ""), kWidth) + ranking(summary, cases, bold) + noise_text(summary, bold);
  for (const std::string& scene : cases.scenes()) {
    for (const Lines& table : lines_of(cases)) {
      TextLines lines;
      lines.push_back({{table.corner, none}});
      for (const std::int64_t spp : cases.spp()) lines[0].push_back({std::to_string(spp), none});
      lines[0].push_back({"slope", none});
      for (const auto& [head, pattern, kernel] : table.keys) {
        std::vector<TextEntry> line{{head, none}};
        bool any = false;
        for (const std::int64_t spp : cases.spp()) {
          const Row* row = cases.first(scene, pattern, kernel, spp);
          any |= row != nullptr;
          line.push_back(error_entry(row));
        }
        line.push_back(slope_entry(slopes.first(scene, pattern, kernel)));
        if (any) lines.push_back(std::move(line));
      }
      if (lines.size() > 1) text += scene + ", " + table.title + "\n" + text_table(lines, bold) + "\n";
    }
  }
  if (!text.empty())
    text += "RMSE over active pixels by samples per pixel; * best; ~ within 10 times the reference's bound\n";
  return text;
}

}  // namespace moire
