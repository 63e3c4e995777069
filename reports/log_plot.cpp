// Plots with two logarithmic axes as SVG.
#include "reports/log_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace moire {
namespace {

// Sizes in SVG's pixels.
constexpr double kPanelWidth = 420, kPanelHeight = 300;
constexpr double kLeft = 62, kRight = 14, kTop = 30, kBottom = 46;  // around a panel's axes
constexpr double kTitle = 34, kLegendLine = 20, kLegendColumn = 190;
constexpr double kMarker = 4;  // radius

// Without the yellow, which is hard to see on white.
constexpr auto kColours =
    std::to_array<const char*>({"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"});

// Outlines within the circle of radius 1, closed; the first marker is that circle.
constexpr auto kMarkers = std::to_array<const char*>({
    "",
    "-0.85,-0.85 0.85,-0.85 0.85,0.85 -0.85,0.85",
    "0,-1.1 1,0.75 -1,0.75",
    "0,-1.2 1.2,0 0,1.2 -1.2,0",
    "0,1.1 1,-0.75 -1,-0.75",
    "-0.35,-1.1 0.35,-1.1 0.35,-0.35 1.1,-0.35 1.1,0.35 0.35,0.35 0.35,1.1 -0.35,1.1 -0.35,0.35 -1.1,0.35 -1.1,-0.35 "
    "-0.35,-0.35",
    "0,-1.15 1.09,-0.35 0.68,0.93 -0.68,0.93 -1.09,-0.35",
});

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

bool is_drawn(const PlotPoint& p) { return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y); }

bool has_bar(const PlotPoint& p) { return p.y_lo > 0 && p.y_lo <= p.y_hi && std::isfinite(p.y_hi); }

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more, escaped(text));
}

std::string line(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x0, y0, x1, y1,
                     kind);
}

// How the series of one name looks in all panels.
struct Style {
  std::string name;
  const char *colour, *outline;
};

std::vector<Style> styles_of(const LogPlot& plot) {
  std::vector<Style> styles;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotSeries& s : panel.series) {
      if (std::any_of(styles.begin(), styles.end(), [&](const Style& known) { return known.name == s.name; })) continue;
      // The second time round the same colour gets another marker.
      const std::size_t i = styles.size();
      styles.push_back({s.name, kColours[i % kColours.size()], kMarkers[(i + i / kColours.size()) % kMarkers.size()]});
    }
  }
  return styles;
}

std::string marker(double x, double y, const Style& style, bool filled, const char* kind) {
  const std::string look =
      fmt::format("class=\"{}\" stroke=\"{}\" fill=\"{}\"", kind, style.colour, filled ? style.colour : "#ffffff");
  if (*style.outline == '\0') {
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" {}/>\n", x, y, kMarker, look);
  }
  return fmt::format(
      "<polygon points=\"{}\" transform=\"translate({:.1f} {:.1f}) scale({})\" stroke-width=\"{}\" {}/>\n",
      style.outline, x, y, kMarker, 1.3 / kMarker, look);
}

// From the logarithm of a number to pixels.
struct Axis {
  double lo = 1, hi = 10;   // numbers at the ends
  double from = 0, to = 1;  // pixels
  double operator()(double v) const { return from + (to - from) * std::log(v / lo) / std::log(hi / lo); }
};

// The least and the largest of some numbers, from nothing on.
struct Range {
  double lo = HUGE_VAL, hi = 0;
  void add(double v) {
    lo = std::fmin(lo, v);
    hi = std::fmax(hi, v);
  }
};

// Room for all values, and a little more on each side.
Axis axis_of(const Range& range) {
  if (!(range.lo <= range.hi)) return {1, 10, 0, 1};
  const double margin = std::pow(range.hi / range.lo, 0.04) * 1.1;
  return {range.lo / margin, range.hi * margin, 0, 1};
}

std::string tick_text(double value) {
  return value >= 1e-3 && value < 1e5 ? fmt::format("{:g}", value) : fmt::format("{:.0e}", value);
}

std::string axes(const Axis& x, const Axis& y, const LogPlot& plot) {
  std::string out =
      fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"frame\"/>\n", x.from,
                  y.to, x.to - x.from, y.from - y.to);
  for (const double v : log_ticks(x.lo, x.hi)) {
    out += line(x(v), y.from, x(v), y.to, "grid");
    out += text_at(x(v), y.from + 15, tick_text(v), " text-anchor=\"middle\"");
  }
  for (const double v : log_ticks(y.lo, y.hi)) {
    out += line(x.from, y(v), x.to, y(v), "grid");
    out += text_at(x.from - 6, y(v) + 4, tick_text(v), " text-anchor=\"end\"");
  }
  out += text_at((x.from + x.to) / 2, y.from + 34, plot.x_label, " text-anchor=\"middle\"");
  const double across = x.from - 46, middle = (y.from + y.to) / 2;
  return out + text_at(across, middle, plot.y_label,
                       fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"", across, middle));
}

// From each point of the front along to the next one, then down.
std::string front(const PlotPanel& panel, const Axis& x, const Axis& y) {
  std::vector<PlotPoint> points;
  for (const PlotSeries& s : panel.series) {
    std::copy_if(s.points.begin(), s.points.end(), std::back_inserter(points),
                 [](const PlotPoint& p) { return p.on_front && is_drawn(p); });
  }
  if (points.size() < 2) return {};
  std::sort(points.begin(), points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  std::string path = fmt::format("M{:.1f} {:.1f}", x(points[0].x), y(points[0].y));
  for (std::size_t i = 1; i < points.size(); ++i) path += fmt::format("H{:.1f}V{:.1f}", x(points[i].x), y(points[i].y));
  return "<path class=\"front\" d=\"" + path + "\"/>\n";
}

std::string curve(const PlotSeries& series, const Style& style, const Axis& x, const Axis& y) {
  std::string through, bars, markers;
  for (const PlotPoint& p : series.points) {
    if (!is_drawn(p)) continue;
    through += fmt::format("{}{:.1f},{:.1f}", through.empty() ? "" : " ", x(p.x), y(p.y));
    if (has_bar(p)) bars += line(x(p.x), y(p.y_lo), x(p.x), y(p.y_hi), "bar");
    markers += marker(x(p.x), y(p.y), style, p.on_front, "point");
  }
  if (through.empty()) return {};
  return fmt::format("<g stroke=\"{}\">\n<polyline class=\"curve\" points=\"{}\"/>\n{}{}</g>\n", style.colour, through,
                     bars, markers);
}

}  // namespace

std::vector<double> log_ticks(double lo, double hi) {
  const int first = static_cast<int>(std::floor(std::log10(lo))), last = static_cast<int>(std::ceil(std::log10(hi)));
  std::vector<double> ticks;
  for (const bool fine : {false, true}) {
    ticks.clear();
    for (int decade = first; decade <= last; ++decade) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double tick = digit * std::pow(10.0, decade);
        if ((digit == 1 || fine) && tick >= lo && tick <= hi) ticks.push_back(tick);
      }
    }
    if (ticks.size() >= 3) break;
  }
  return ticks;
}

std::string log_plot_svg(const LogPlot& plot) {
  const std::size_t columns = std::max<std::size_t>(1, std::min(plot.columns, plot.panels.size()));
  const std::size_t lines = (plot.panels.size() + columns - 1) / columns;
  const std::vector<Style> styles = styles_of(plot);
  const double width = static_cast<double>(columns) * kPanelWidth;
  const auto keys_in_line = static_cast<std::size_t>(std::max(1.0, std::floor(width / kLegendColumn)));
  const double legend = kLegendLine * static_cast<double>((styles.size() + keys_in_line - 1) / keys_in_line);
  const double height = kTitle + static_cast<double>(lines) * kPanelHeight + legend + 10;

  std::vector<Range> x_ranges(columns);
  Range y_range;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    for (const PlotSeries& s : plot.panels[i].series) {
      for (const PlotPoint& p : s.points) {
        if (!is_drawn(p)) continue;
        x_ranges[i % columns].add(p.x);
        y_range.add(p.y);
        if (!has_bar(p)) continue;
        y_range.add(p.y_lo);
        y_range.add(p.y_hi);
      }
    }
  }
  Axis y = axis_of(y_range);

  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<style>.frame{{fill:none;stroke:#444}}.grid{{stroke:#ddd}}.curve{{fill:none;stroke-width:0.7}}"
      ".bar{{stroke-width:1}}.front{{fill:none;stroke:#888;stroke-width:3;stroke-opacity:0.5}}</style>\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
      width, height);
  out += text_at(width / 2, 22, plot.title, " text-anchor=\"middle\" font-size=\"15\"");
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const double left = static_cast<double>(i % columns) * kPanelWidth;
    const double top = kTitle + static_cast<double>(i / columns) * kPanelHeight;
    Axis x = axis_of(x_ranges[i % columns]);
    x.from = left + kLeft;
    x.to = left + kPanelWidth - kRight;
    y.from = top + kPanelHeight - kBottom;
    y.to = top + kTop;
    out += "<g>\n" + text_at((x.from + x.to) / 2, top + 20, plot.panels[i].title, " text-anchor=\"middle\"");
    out += axes(x, y, plot) + front(plot.panels[i], x, y);
    for (const PlotSeries& s : plot.panels[i].series) {
      const auto style = std::find_if(styles.begin(), styles.end(), [&](const Style& k) { return k.name == s.name; });
      out += curve(s, *style, x, y);
    }
    out += "</g>\n";
  }
  for (std::size_t i = 0; i < styles.size(); ++i) {
    const double left = kLeft + static_cast<double>(i % keys_in_line) * kLegendColumn;
    const double down = height - legend + static_cast<double>(i / keys_in_line) * kLegendLine;
    out += marker(left, down, styles[i], true, "key") + text_at(left + 12, down + 4, styles[i].name);
  }
  return out + "</svg>\n";
}

}  // namespace moire
