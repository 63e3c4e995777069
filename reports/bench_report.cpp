// What a benchmark says.
#include "reports/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "reports/markdown_table.h"
#include "reports/text_table.h"
#include "study/cases.h"
#include "study/columns.h"

namespace moire {
namespace {

using Line = std::vector<std::string>;

// The rows that compete with each other: those of one scene, filter and estimator.
struct Contest {
  std::string scene, kernel;
  std::vector<const Row*> rows;

  // Both by first appearance, counts rising.
  std::vector<std::string> patterns() const {
    std::vector<std::string> names;
    for (const Row* row : rows) {
      const std::string name = sampler_of(*row);
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
  }
  std::vector<double> counts() const {
    std::vector<double> counts;
    for (const Row* row : rows) counts.push_back(row->number("spp"));
    std::sort(counts.begin(), counts.end());
    counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
    return counts;
  }
  // Null where there is none.
  const Row* find(const std::string& pattern, double spp) const {
    for (const Row* row : rows) {
      if (row->number("spp") == spp && sampler_of(*row) == pattern) return row;
    }
    return nullptr;
  }
};

std::string kernel_of(const Row& row) {
  return Reconstruction{std::string(row.text("filter")), std::string(row.text("estimator"))}.label();
}

std::vector<Contest> contests(const Table& rows) {
  std::vector<Contest> all;
  for (const Row& row : rows) {
    const std::string scene(row.text("scene"));
    const std::string kernel = kernel_of(row);
    auto at =
        std::find_if(all.begin(), all.end(), [&](const Contest& c) { return c.scene == scene && c.kernel == kernel; });
    if (at == all.end()) at = all.insert(at, Contest{scene, kernel, {}});
    at->rows.push_back(&row);
  }
  return all;
}

std::string number_text(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string number_text(const Row& row, const char* name, const char* format) {
  return number_text(row.number(name), format);
}

// Nanoseconds in three digits.
std::string time_text(double ns) {
  if (!std::isfinite(ns)) return "-";
  constexpr const char* kUnits[] = {"ns", "us", "ms", "s"};
  std::size_t unit = 0;
  while (unit + 1 < std::size(kUnits) && ns >= 999.5) {
    ns /= 1000;
    ++unit;
  }
  return fmt::format("{:.3g} {}", ns, kUnits[unit]);
}

// "median +- deviation", in the median's unit.
std::string spread_text(const Row& row, const std::string& stem) {
  const double median = row.number(stem + "_ns"), deviation = row.number(stem + "_deviation_ns");
  if (!std::isfinite(median)) return "-";
  if (median == 0) return "0";
  return time_text(median) + fmt::format(" +-{:.0f}%", 100 * deviation / median);
}

std::string exponent_text(const Row& row) {
  std::string text = number_text(row, "time_exponent", "{:.2f}");
  const double lo = row.number("time_exponent_lo"), hi = row.number("time_exponent_hi");
  return std::isfinite(lo) ? text + fmt::format(" +-{:.2f}", (hi - lo) / 2) : text;
}

std::string ratio_text(const Row& row, const std::string& name, const char* format) {
  std::string text = number_text(row.number(name), format);
  if (text == "-") return text;
  return text + " [" + number_text(row.number(name + "_least"), format) + ", " +
         number_text(row.number(name + "_most"), format) + "]";
}

std::string machine_text(const Host& host) { return fmt::format("{}, {} cores", host.cpu, host.cores); }

// Patterns that were rendered exhaustively, at the largest count where any was.
std::vector<const Row*> largest_exhaustive(const Contest& contest) {
  std::vector<const Row*> rows;
  for (const double spp : contest.counts()) {
    std::vector<const Row*> here;
    for (const Row* row : contest.rows) {
      if (row->number("spp") == spp && std::isfinite(row->number("time_exhaustive_ratio"))) here.push_back(row);
    }
    if (!here.empty()) rows = std::move(here);
  }
  return rows;
}

std::string efficiency_table(const Contest& contest) {
  std::vector<Line> lines{{"pattern"}};
  for (const double spp : contest.counts()) lines[0].push_back(fmt::format("{:.0f}", spp));
  for (const std::string& pattern : contest.patterns()) {
    lines.push_back({markdown_code(pattern)});
    for (const double spp : contest.counts()) {
      double best = 0;
      for (const Row* row : contest.rows) {
        if (row->number("spp") == spp) best = std::fmax(best, row->number("time_efficiency"));
      }
      const Row* row = contest.find(pattern, spp);
      if (row == nullptr) {
        lines.back().push_back("-");
        continue;
      }
      std::string cell = number_text(row->number("time_efficiency") / best, "{:.3f}");
      if (row->number("time_efficiency") == best) cell = "**1**";
      lines.back().push_back(cell + (row->flag("time_front") ? " F" : ""));
    }
  }
  return markdown_table(lines);
}

std::string stage_table(const Contest& contest) {
  std::vector<Line> lines{{"pattern", "spp", "set-up", "first use", "generation", "evaluation", "reconstruction",
                           "render", "samples evaluated", "RMSE", "efficiency 1/s", "front"}};
  for (const Row* row : contest.rows) {
    std::string rmse = number_text(*row, "rmse_active", "{:.2e}");
    if (std::isfinite(row->number("rmse_active_lo"))) {
      rmse += " [" + number_text(*row, "rmse_active_lo", "{:.2e}") + ", " +
              number_text(*row, "rmse_active_hi", "{:.2e}") + "]";
    }
    lines.push_back({markdown_code(sampler_of(*row)), number_text(*row, "spp", "{:.0f}"),
                     spread_text(*row, "time_setup"), spread_text(*row, "time_first_use"),
                     spread_text(*row, "time_generation_pixel"), spread_text(*row, "time_evaluation_pixel"),
                     spread_text(*row, "time_reconstruction_pixel"), spread_text(*row, "time_render_pixel"),
                     number_text(row->number("samples_evaluated") / row->number("pixels_active"), "{:.1f}"), rmse,
                     number_text(*row, "time_efficiency", "{:.2e}"), row->flag("time_front") ? "F" : ""});
  }
  return markdown_table(lines);
}

std::string exponent_table(const Table& exponents) {
  std::vector<Line> lines{{"scene", "filter", "pattern", "exponent", "over"}};
  for (const Row& row : exponents) {
    lines.push_back({markdown_code(row.text("scene")), markdown_code(kernel_of(row)), markdown_code(sampler_of(row)),
                     exponent_text(row),
                     fmt::format("{:.0f} to {:.0f}", row.number("spp_min"), row.number("spp_max"))});
  }
  return markdown_table(lines);
}

std::string exhaustive_table(const std::vector<Contest>& all) {
  std::vector<Line> lines{{"scene", "filter", "pattern", "spp", "samples in all", "evaluated by skipping", "exhaustive",
                           "per sample", "exhaustive / skipping", "same bits"}};
  for (const Contest& contest : all) {
    for (const Row* row : largest_exhaustive(contest)) {
      lines.push_back({markdown_code(contest.scene), markdown_code(contest.kernel), markdown_code(sampler_of(*row)),
                       number_text(*row, "spp", "{:.0f}"), number_text(*row, "samples_total", "{:.0f}"),
                       number_text(*row, "samples_evaluated", "{:.0f}"), spread_text(*row, "time_exhaustive_pixel"),
                       time_text(row->number("time_exhaustive_sample_ns")),
                       ratio_text(*row, "time_exhaustive_ratio", "{:.3g}"),
                       row->flag("exhaustive_same") ? "yes" : "**no**"});
    }
  }
  return lines.size() > 1 ? markdown_table(lines) : "No image of the study has few enough samples.\n\n";
}

std::string scaling_table(const Table& scaling) {
  std::vector<Line> lines{{"threads", "all cases", "times one thread"}};
  for (const Row& row : scaling) {
    lines.push_back({number_text(row, "time_threads", "{:.0f}"), spread_text(row, "time_render"),
                     ratio_text(row, "time_speedup", "{:.2f}")});
  }
  return markdown_table(lines);
}

}  // namespace

std::string bench_text(const Benchmark& benchmark, const Host& host) {
  const double none = std::nan("");
  std::string text = fmt::format("{}; one thread, {} repeats\n\n", machine_text(host), benchmark.settings.repeats);
  const std::vector<Contest> all = contests(benchmark.rows);
  for (const Contest& contest : all) {
    TextLines lines{{{"pattern", none}}};
    for (const double spp : contest.counts()) lines[0].push_back({fmt::format("{:.0f}", spp), none});
    lines[0].push_back({"exponent", none});
    for (const std::string& pattern : contest.patterns()) {
      lines.push_back({{pattern, none}});
      const Row* any = nullptr;
      for (const double spp : contest.counts()) {
        const Row* row = contest.find(pattern, spp);
        if (row != nullptr) any = row;
        lines.back().push_back({row == nullptr ? "-"
                                               : time_text(row->number("time_render_pixel_ns")) + " " +
                                                     number_text(*row, "rmse_active", "{:.1e}") +
                                                     (row->flag("time_front") ? "*" : " "),
                                none});
      }
      lines.back().push_back({exponent_text(*any), none});
    }
    text += contest.scene + ", " + contest.kernel + "\n" + text_table(lines, false) + "\n";
  }
  text +=
      "render time per active pixel (sampling and reconstruction, median) and RMSE over active pixels, by samples per "
      "pixel;\n* on the Pareto front; exponent: of time in samples per pixel, over the largest counts, 95%\n\n";
  TextLines lines{{{"exhaustive", none}, {"spp", none}, {"per sample", none}, {"times skipping", none}}};
  for (const Contest& contest : all) {
    double least = none, most = none;
    std::vector<double> sample_ns;
    for (const Row* row : largest_exhaustive(contest)) {
      least = std::fmin(least, row->number("time_exhaustive_ratio"));
      most = std::fmax(most, row->number("time_exhaustive_ratio"));
      sample_ns.push_back(row->number("time_exhaustive_sample_ns"));
    }
    if (sample_ns.empty()) continue;
    const auto [low, high] = std::minmax_element(sample_ns.begin(), sample_ns.end());
    lines.push_back({{contest.scene + ", " + contest.kernel, none},
                     {number_text(*largest_exhaustive(contest).front(), "spp", "{:.0f}"), none},
                     {fmt::format("{} - {}", time_text(*low), time_text(*high)), none},
                     {fmt::format("{:.3g} - {:.3g}", least, most), none}});
  }
  if (lines.size() > 1) text += text_table(lines, false) + "\n";
  lines = {{{"threads", none}, {"all cases", none}, {"times one thread", none}}};
  for (const Row& row : benchmark.scaling) {
    lines.push_back({{number_text(row, "time_threads", "{:.0f}"), none},
                     {time_text(row.number("time_render_ns")), none},
                     {ratio_text(row, "time_speedup", "{:.2f}"), none}});
  }
  return text + text_table(lines, false) + "\n";
}

LogPlot bench_plot(std::string_view study_name, const Table& rows) {
  LogPlot plot{std::string(study_name) + ": run time against error",
               "render time per active pixel, ns",
               "RMSE over active pixels",
               1,
               {}};
  std::size_t columns = 0;  // panels of the scene so far
  std::string scene;
  for (const Contest& contest : contests(rows)) {
    columns = contest.scene == scene ? columns + 1 : 1;
    scene = contest.scene;
    plot.columns = std::max(plot.columns, columns);
    PlotPanel panel{contest.scene + ", " + contest.kernel, {}};
    for (const std::string& pattern : contest.patterns()) {
      PlotSeries series{pattern, {}};
      for (const double spp : contest.counts()) {
        const Row* row = contest.find(pattern, spp);
        if (row == nullptr) continue;
        series.points.push_back({row->number("time_render_pixel_ns"), row->number("rmse_active"),
                                 row->number("rmse_active_lo"), row->number("rmse_active_hi"),
                                 row->flag("time_front")});
      }
      panel.series.push_back(std::move(series));
    }
    plot.panels.push_back(std::move(panel));
  }
  return plot;
}

std::string bench_markdown(std::string_view study_name, const Benchmark& benchmark, const Tool& tool, const Host& host,
                           std::string_view plot) {
  const std::vector<Contest> all = contests(benchmark.rows);
  std::string out = fmt::format("# {}: run time against error\n\n", study_name);
  out += fmt::format("{}; {}, {}, {}.\n\n![RMSE against render time]({})\n\n", machine_text(host), tool.compiler,
                     tool.build_type, tool.flags, plot);
  out +=
      "Each point is a pattern at one number of samples per pixel: further left is quicker, further down is better. "
      "Filled points and the grey stairs are the Pareto front: no other point is as quick and as good. Bars are 95% "
      "intervals of the error.\n\n## The answer: who errs least in a given time\n\nEfficiency, 1 / (MSE x time), over "
      "that of the best pattern, by samples per pixel; F: on the Pareto front of all counts.\n\n";
  for (const Contest& contest : all) {
    out += fmt::format("### {}, {}\n\n", markdown_code(contest.scene), markdown_code(contest.kernel)) +
           efficiency_table(contest);
  }
  out +=
      "## How cost grows with the samples\n\nThe power of the samples per pixel with which render time per active "
      "pixel grows: least squares of the logarithms over up to four of the largest counts; 95%, from how far they are "
      "from a straight line. 1: every sample is evaluated; 1/2: only those in cells of the pattern that the boundary "
      "crosses.\n\n" +
      exponent_table(benchmark.exponents);
  out += fmt::format(
      "## What skipping saves\n\nThe same image with every sample of every pixel evaluated (`--exhaustive`), in the "
      "same "
      "rounds on one thread, where it has no more than {} samples; its time is divided by the number of active pixels, "
      "too. In brackets the least and the largest ratio of the rounds.\n\n",
      benchmark.settings.exhaustive_samples);
  out += exhaustive_table(all);
  out +=
      "## What threads bring\n\nAll cases together, short ones as often as it takes one thread to be busy for 2 ms; in "
      "brackets the least and the largest ratio of the rounds.\n\n" +
      scaling_table(benchmark.scaling);
  out += "## Times by stage\n\n";
  for (const Contest& contest : all) {
    out += fmt::format("### Stages of {}, {}\n\n", markdown_code(contest.scene), markdown_code(contest.kernel)) +
           stage_table(contest);
  }
  return out +
         fmt::format(
             "## How it was measured\n\n"
             "Times are wall times, medians of {} repeats, +- the median absolute deviation. One round of all "
             "cases warms up and is not recorded; each repeat is a round of all cases, so that drift of the "
             "machine meets all alike; work of less than 2 ms is repeated within a timing. One thread, but for "
             "the thread scaling; trial 0. Errors are those of all trials and are not timed.\n\n"
             "- *set-up*: making the pattern, or the set over the image; *first use*: what the first pass over an "
             "image's samples takes beyond a second one, since some patterns make sets of points when they are "
             "first asked for. Both are shared by all pixels, and no part of *render*;\n"
             "- *generation*, *evaluation*, *reconstruction*: all samples of the cells that windows of active "
             "pixels touch are made, tested against the scene and weighed, in passes of their own apart from the "
             "renderer, about 1024 samples at a time; the time of looking at the clock is taken off. Per "
             "active pixel; `-` for more than {} samples, and for estimators that render other pixels, too;\n"
             "- *render*: the renderer as it is used, which need not make, test or weigh what it can skip: it may "
             "take less than the three stages together. Per active pixel;\n"
             "- *samples evaluated*: point tests of *render* per active pixel;\n"
             "- *efficiency*: 1 / (MSE over active pixels x seconds of *render* per active pixel).\n",
             benchmark.settings.repeats, benchmark.settings.stage_samples);
}

}  // namespace moire
