// Plots with two logarithmic axes as SVG 1.1 (W3C), for reports: panels in a grid, series told apart by colour and
// marker. Colours: M. Okabe, K. Ito, "Color universal design", 2008, which colour-blind readers can tell apart.
#pragma once

#include <string>
#include <vector>

namespace moire {

// One measurement; both coordinates must be > 0 and finite, others are not drawn.
struct PlotPoint {
  double x = 1, y = 1;
  double y_lo = 0, y_hi = 0;  // a bar through the point; none unless 0 < y_lo <= y_hi
  bool on_front = false;      // drawn filled; the others hollow
};

// Points that belong together; drawn with a thin line from each to the next.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
};

// One pair of axes. The points on the front, of all series, are joined by a staircase: below and left of it is nothing.
struct PlotPanel {
  std::string title;
  std::vector<PlotSeries> series;
};

struct LogPlot {
  std::string title, x_label, y_label;
  std::size_t columns = 1;  // of panels
  std::vector<PlotPanel> panels;
};

// A whole SVG file. Series of one name have the same colour and marker in all panels; a legend names them. All panels
// have the same range of y, and those of one column the same range of x. Each point that is drawn is one element with
// class="point", each one of the legend has class="key".
std::string log_plot_svg(const LogPlot& plot);

// Where an axis from lo to hi (0 < lo <= hi) is marked: the powers of ten, and 2 and 5 times those where there would be
// fewer than three.
std::vector<double> log_ticks(double lo, double hi);

}  // namespace moire
