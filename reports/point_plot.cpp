// Dots and lines, drawn by how much of a pixel they cover, to within a twentieth of it.
#include "reports/point_plot.h"

#include <algorithm>
#include <cmath>

#include "reports/preview.h"

namespace moire {
namespace {

constexpr int kSide = 512, kMargin = 16;
constexpr Rgb kInk{32, 32, 32}, kFrame{150, 150, 150};

// A square part of the picture, `size` pixels wide from (left, top), that shows a square of the plane.
struct Frame {
  int left, top, size;
};

class Drawing {
 public:
  Drawing(int width, int height) {
    raster_.grid = {width, height};
    raster_.channels = 3;
    raster_.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, 255);
  }

  // A disk; pixel (i, j) covers [i, i + 1) x [j, j + 1).
  void dot(double x, double y, double radius, const Rgb& colour, const Frame& clip) {
    each(clip, x - radius - 1, y - radius - 1, x + radius + 1, y + radius + 1, [&](double px, double py) {
      return std::pair(std::clamp(radius + 0.5 - std::hypot(px - x, py - y), 0.0, 1.0), colour);
    });
  }
  // The line n.p = c of picture coordinates, n of length 1, one pixel wide.
  void line(double nx, double ny, double c, const Rgb& colour, const Frame& clip) {
    each(clip, 0, 0, raster_.grid.width, raster_.grid.height, [&](double px, double py) {
      return std::pair(std::clamp(1.0 - std::fabs(nx * px + ny * py - c), 0.0, 1.0), colour);
    });
  }
  void frame(const Frame& f) {
    for (int i = -1; i <= f.size; ++i) {
      for (const auto& [x, y] : {std::pair(i, -1), std::pair(i, f.size), std::pair(-1, i), std::pair(f.size, i)}) {
        blend(f.left + x, f.top + y, 1, kFrame);
      }
    }
  }
  Raster finish() && { return std::move(raster_); }

 private:
  template <class F>
  void each(const Frame& clip, double x0, double y0, double x1, double y1, F&& f) {
    const auto from = [](double a, int least) { return std::max(least, static_cast<int>(std::floor(a))); };
    const auto to = [](double b, int most) { return std::min(most, static_cast<int>(std::ceil(b))); };
    for (int j = from(y0, clip.top); j < to(y1, clip.top + clip.size); ++j) {
      for (int i = from(x0, clip.left); i < to(x1, clip.left + clip.size); ++i) {
        const auto [share, colour] = f(i + 0.5, j + 0.5);
        if (share > 0) blend(i, j, share, colour);
      }
    }
  }
  void blend(int x, int y, double share, const Rgb& colour) {
    std::uint8_t* const pixel =
        &raster_.pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(raster_.grid.width) +
                             static_cast<std::size_t>(x))];
    for (std::size_t k = 0; k < 3; ++k) {
      pixel[k] = srgb8((1 - share) * linear_of_srgb8(pixel[k]) + share * linear_of_srgb8(colour[k]));
    }
  }

  Raster raster_;
};

}  // namespace

Raster point_plot(std::span<const double> x, std::span<const double> y, std::span<const double> t) {
  const Frame square{kMargin, kMargin, kSide};
  Drawing drawing(kSide + 2 * kMargin, kSide + 2 * kMargin);
  drawing.frame(square);
  // A tenth of the points' mean distance, but to be seen.
  const double radius = std::clamp(0.1 * kSide / std::sqrt(static_cast<double>(x.size())), 1.2, 6.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    drawing.dot(square.left + kSide * x[i], square.top + kSide * y[i], radius,
                t.empty() ? kInk : diverging_colour(2 * t[i] - 1), square);
  }
  return std::move(drawing).finish();
}

Raster line_plot(std::span<const PlotLine> lines) {
  constexpr double kLow = -4, kLeft = -4, kSpan = 9;  // of the dual plane: m from -4 to 5, b from -4 to 5
  const Frame primal{kMargin, kMargin, kSide}, dual{2 * kMargin + kSide, kMargin, kSide};
  Drawing drawing(3 * kMargin + 2 * kSide, kSide + 2 * kMargin);
  drawing.frame(primal);
  drawing.frame(dual);
  const double unit = kSide / kSpan;
  const auto right = [&](double m) { return dual.left + (m - kLeft) * unit; };
  const auto down = [&](double b) { return dual.top + kSide - (b - kLow) * unit; };
  drawing.line(1, 0, right(0), kFrame, dual);
  drawing.line(0, 1, down(0), kFrame, dual);
  std::int64_t beyond = 0;
  for (const PlotLine& l : lines) {
    // y up: p = ((px - left) / side, (top + side - py) / side).
    const double length = std::hypot(l.nx, l.ny), nx = l.nx / length, ny = l.ny / length, c = l.c / length;
    drawing.line(nx, -ny, kSide * c + nx * primal.left - ny * (primal.top + kSide), kInk, primal);
    const double m = -nx / ny, b = c / ny;
    const bool inside =
        std::fabs(m - (kLeft + kSpan / 2)) <= kSpan / 2 && std::fabs(b - (kLow + kSpan / 2)) <= kSpan / 2;
    if (inside) {
      drawing.dot(right(m), down(b), 2.5, kInk, dual);
    } else {
      ++beyond;
    }
  }
  Raster raster = std::move(drawing).finish();
  raster.text = {{"moire:beyond", std::to_string(beyond)}};
  return raster;
}

}  // namespace moire
