// What the errors look like.
#include "reports/noise_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/markdown_table.h"
#include "reports/text_table.h"
#include "study/cases.h"
#include "study/columns.h"

namespace moire {
namespace {

using Line = std::vector<std::string>;

std::string number_text(const Row& row, std::string_view name, const char* format) {
  const double value = row.number(name);
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

// "value [lo, hi] (rank)", the interval where there is one and it is wanted; "-" without a value.
std::string ranked_text(const Row& row, const std::string& value, std::string_view rank, const char* format,
                        bool interval) {
  std::string text = number_text(row, value, format);
  if (text == "-") return text;
  if (interval && std::isfinite(row.number(value + "_lo"))) {
    text += fmt::format(" [{}, {}]", number_text(row, value + "_lo", format), number_text(row, value + "_hi", format));
  }
  return text + fmt::format(" ({:.0f})", row.number(rank));
}

std::string kernel_of(const Row& row) {
  return Reconstruction{std::string(row.text("filter")), std::string(row.text("estimator"))}.label();
}

// Rows of one filter, estimator and count, which stand together.
std::vector<std::vector<const Row*>> fields_of(const Table& ranking) {
  std::vector<std::vector<const Row*>> fields;
  for (const Row& row : ranking) {
    const bool same = !fields.empty() && kernel_of(*fields.back().front()) == kernel_of(row) &&
                      fields.back().front()->number("spp") == row.number("spp");
    if (!same) fields.emplace_back();
    fields.back().push_back(&row);
  }
  return fields;
}

Line ranking_line(const Row& row, bool intervals) {
  const double peaks = row.number("peaks");
  return {ranked_text(row, "relative_rmse", "rank_rmse", "{:.2f}", intervals),
          ranked_text(row, "relative_csf", "rank_csf", "{:.2f}", intervals),
          ranked_text(row, "relative_low_frequency", "rank_low_frequency", "{:.2f}", intervals),
          ranked_text(row, "low_frequency_ratio", "rank_colour", "{:.2f}", intervals),
          ranked_text(row, "structured_fraction", "rank_structured", "{:.3f}", intervals),
          fmt::format("{:.0f} of {:.0f}", peaks, row.number("n_scenes")) +
              (peaks > 0 ? number_text(row, "highest_peak_db", ", {:.0f} dB") : "")};
}

constexpr const char* kHeads[] = {"RMSE", "seen", "low-frequency", "colour", "structured", "peaks"};

// "value [lo, hi]" or "-".
std::string interval_text(const Row& row, const std::string& name, const char* format) {
  std::string text = number_text(row, name, format);
  if (std::isfinite(row.number(name + "_lo"))) {
    text += fmt::format(" [{}, {}]", number_text(row, name + "_lo", format), number_text(row, name + "_hi", format));
  }
  return text;
}

std::string peak_text(const Row& row) {
  const Cell* known = row.find("peak_significant");
  if (known == nullptr || !std::holds_alternative<bool>(*known)) return "-";
  if (!std::get<bool>(*known)) return "none";
  return number_text(row, "peak_height_db", "{:.0f} dB at ") + number_text(row, "peak_frequency", "{:.3f}") +
         number_text(row, "peak_direction", ", {:.0f} deg");
}

std::string scene_table(const Cases& cases, const std::string& scene, const Reconstruction& kernel, std::int64_t spp) {
  std::vector<const Row*> rows;
  bool expected = false;
  for (const std::string& pattern : cases.patterns()) {
    const Row* row = cases.first(scene, pattern, kernel, spp);
    if (row == nullptr || !std::isfinite(row->number("csf_rms"))) continue;
    rows.push_back(row);
    expected |= std::isfinite(row->number("expected_noise_power"));
  }
  if (rows.empty()) return "";
  std::vector<Line> lines{{"pattern", "RMSE", "CSF-weighted", "noise power"}};
  if (expected) lines[0].push_back("expected");
  for (const char* head : {"low-frequency ratio", "structured", "strongest peak"}) lines[0].push_back(head);
  for (const Row* row : rows) {
    lines.push_back({markdown_code(sampler_of(*row)), number_text(*row, "rmse_all", "{:.2e}"),
                     number_text(*row, "csf_rms", "{:.2e}"), interval_text(*row, "noise_power", "{:.3e}")});
    if (expected) lines.back().push_back(number_text(*row, "expected_noise_power", "{:.3e}"));
    lines.back().push_back(interval_text(*row, "low_frequency_ratio", "{:.2f}"));
    lines.back().push_back(number_text(*row, "structured_fraction", "{:.3f}") +
                           number_text(*row, "structured_fraction_error", " +- {:.3f}"));
    lines.back().push_back(peak_text(*row));
  }
  return markdown_table(lines);
}

}  // namespace

std::string noise_report(const Summary& summary) {
  if (summary.noise.empty()) return {};
  const Cases cases(summary.rows);
  std::string out =
      "## The answer: what the errors look like\n\n"
      "Numbers, 95% intervals in square brackets (as wide as if the scenes of a trial erred together) and ranks in "
      "round ones, over the scenes:\n\n"
      "- *RMSE* over all pixels, and *seen*, the same weighted with the eye's contrast sensitivity (Mannos and "
      "Sakrison "
      "1974): geometric means over the scenes of the value over that of the scene's best;\n"
      "- *low-frequency*: the amplitude of noise below 1/8 cycle per pixel, without that of the mean error, likewise: "
      "grain;\n"
      "- *colour*: noise power below 1/8 cycle per pixel over what white noise of the same energy has there; 1 is "
      "white, "
      "less is blue;\n"
      "- *structured*: the part of the error's power that is the same in every realisation: aliasing and Moire; 0 is "
      "all "
      "noise (negative by chance), 1 a pattern without random numbers, which has no noise to be ranked;\n"
      "- *peaks*: scenes with a significant structured peak (1% false alarms over the image's frequencies), and the "
      "highest over the power around it. A pattern without random numbers is judged by what stands out of its own "
      "spectrum: the highest bin of a single realisation of noise is 10 dB or so above the median around it.\n\n"
      "Where no sample is near, which is common at one sample per pixel, the ratio estimator looks at the pixel's "
      "centre "
      "(`fallbacks` in the rows): a regular grid, whose structure then shows even for random points.\n\n"
      "With the box filter and one pattern per pixel every pixel has samples of its own, so that the noise of any "
      "randomised pattern is white, whatever the pattern's own spectrum: grain is a matter of wide filters, and of "
      "patterns that cross pixels (`layout=image`).\n\n";
  if (std::any_of(summary.rows.begin(), summary.rows.end(),
                  [](const Row& row) { return std::isfinite(row.number("expected_noise_power")); })) {
    out +=
        "*Expected* is the noise power by theory (Bartlett 1964), where it is known: `random` and `jittered` in one "
        "set "
        "over the image, un-normalised. Intervals of noise power take its pixels for independent.\n\n";
  }
  for (const auto& field : fields_of(summary.noise)) {
    out += fmt::format("### {}, {:.0f} samples per pixel\n\n", markdown_code(kernel_of(*field.front())),
                       field.front()->number("spp"));
    std::vector<Line> lines{{"pattern"}};
    lines[0].insert(lines[0].end(), std::begin(kHeads), std::end(kHeads));
    for (const Row* row : field) {
      lines.push_back({markdown_code(sampler_of(*row))});
      const Line cells = ranking_line(*row, true);
      lines.back().insert(lines.back().end(), cells.begin(), cells.end());
    }
    out += markdown_table(lines);
  }
  const std::int64_t spp = cases.spp().back();
  for (const std::string& scene : cases.scenes()) {
    for (const Reconstruction& kernel : cases.kernels()) {
      const std::string table = scene_table(cases, scene, kernel, spp);
      if (table.empty()) continue;
      out += fmt::format("### Noise on {}, {}, {} samples per pixel\n\n", markdown_code(scene),
                         markdown_code(kernel.label()), spp) +
             table;
    }
  }
  return out;
}

std::string noise_text(const Summary& summary, bool bold) {
  if (summary.noise.empty()) return {};
  const double none = std::nan("");
  std::string text;
  for (const auto& field : fields_of(summary.noise)) {
    TextLines lines(1);
    lines[0].push_back({"pattern", none});
    for (const char* head : kHeads) lines[0].push_back({head, none});
    for (const Row* row : field) {
      lines.push_back({{sampler_of(*row), none}});
      for (const std::string& cell : ranking_line(*row, false)) lines.back().push_back({cell, none});
    }
    text += fmt::format("noise over all scenes, {}, {:.0f} samples per pixel\n", kernel_of(*field.front()),
                        field.front()->number("spp")) +
            text_table(lines, bold) + "\n";
  }
  return text +
         "value (rank); RMSE, seen by the eye, low-frequency noise: over that of the scene's best, geometric mean over "
         "scenes;\ncolour: 1 white, less blue; structured: part of the power that no trial changes; peaks: scenes with "
         "significant Moire;\nwith a box and a pattern in each pixel the noise of any pattern is white\n\n";
}

}  // namespace moire
