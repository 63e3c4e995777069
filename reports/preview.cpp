// Pictures of numbers.
#include "reports/preview.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/args.h"

namespace moire {
namespace {

using Colour = std::array<double, 3>;

// Moreland 2009, section 5: end colours of about equal lightness, and the neutral one between.
constexpr Rgb kNegative{59, 76, 192}, kNeutral{221, 221, 221}, kPositive{180, 4, 38};

// CIE 1976 L*a*b* relative to the white of sRGB, D65; the matrix is that of IEC 61966-2-1.
constexpr double kToXyz[3][3] = {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
constexpr double kFromXyz[3][3] = {{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
constexpr Colour kWhite{0.9505, 1.0, 1.089};

Colour times(const double (&m)[3][3], const Colour& v) {
  Colour out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

Colour lab(const Rgb& rgb) {
  const Colour xyz = times(kToXyz, {linear_of_srgb8(rgb[0]), linear_of_srgb8(rgb[1]), linear_of_srgb8(rgb[2])});
  Colour f{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = xyz[i] / kWhite[i];
    f[i] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16) / 116;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

Rgb rgb(const Colour& lab) {
  const double fy = (lab[0] + 16) / 116;
  const Colour f{fy + lab[1] / 500, fy, fy - lab[2] / 200};
  Colour xyz{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double cube = f[i] * f[i] * f[i];
    xyz[i] = kWhite[i] * (cube > 216.0 / 24389.0 ? cube : (116 * f[i] - 16) * 27.0 / 24389.0);
  }
  const Colour linear = times(kFromXyz, xyz);
  return {srgb8(linear[0]), srgb8(linear[1]), srgb8(linear[2])};
}

// The map's colours at -kSteps..kSteps, so that a picture does not convert every pixel.
constexpr int kSteps = 255;
using Map = std::array<Rgb, 2 * kSteps + 1>;

Map make_map() {
  Map map{};
  for (int i = -kSteps; i <= kSteps; ++i) {
    map[static_cast<std::size_t>(i + kSteps)] = diverging_colour(static_cast<double>(i) / kSteps);
  }
  return map;
}

void paint(Raster& raster, std::size_t i, const Rgb& colour) { std::copy_n(colour.begin(), 3, &raster.pixels[3 * i]); }

}  // namespace

std::uint8_t srgb8(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  const double coded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::floor(255 * coded + 0.5));
}

double linear_of_srgb8(std::uint8_t code) {
  const double v = code / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

Rgb diverging_colour(double value) {
  const double t = std::min(std::fabs(value), 1.0);
  // The three control colours are exact: rounding in and out of CIELAB may not touch them.
  if (t == 0) return kNeutral;
  const Rgb& end = value < 0 ? kNegative : kPositive;
  if (t == 1) return end;
  const Colour from = lab(kNeutral), to = lab(end);
  return rgb({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]), from[2] + t * (to[2] - from[2])});
}

Raster reconstruction_preview(Grid grid, std::span<const float> coverage) {
  assert(coverage.size() == static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  const auto is_nan = [](float v) { return std::isnan(v); };
  const auto outside = [](float v) { return v < 0.0f || v > 1.0f; };
  const auto nans = std::count_if(coverage.begin(), coverage.end(), is_nan);
  const auto clipped = std::count_if(coverage.begin(), coverage.end(), outside);

  Raster raster{grid, nans > 0 ? 3 : 1, {}, {}};
  raster.pixels.resize(coverage.size() * static_cast<std::size_t>(raster.channels));
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    const bool nan = is_nan(coverage[i]);
    const std::uint8_t grey = nan ? std::uint8_t{0} : srgb8(static_cast<double>(coverage[i]));
    if (raster.channels == 1) {
      raster.pixels[i] = grey;
    } else {
      paint(raster, i, nan ? kNanColour : Rgb{grey, grey, grey});
    }
  }
  raster.text = {{"moire:kind", "reconstruction"},
                 {"moire:transfer", "sRGB"},
                 {"moire:clipped", std::to_string(clipped)},
                 {"moire:nan", std::to_string(nans)}};
  return raster;
}

Raster error_preview(Grid grid, std::span<const float> error, double range) {
  assert(error.size() == static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  double largest = 0;
  for (const float e : error) largest = std::fmax(largest, std::fabs(static_cast<double>(e)));  // skips NaN
  const bool by_percentile = std::isfinite(range) && (range > 0 || largest == 0);
  const double used = by_percentile ? range : largest;

  const Map map = make_map();
  Raster raster{grid, 3, std::vector<std::uint8_t>(3 * error.size()), {}};
  std::int64_t clipped = 0, nans = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double e = static_cast<double>(error[i]);
    if (std::isnan(e)) {
      ++nans;
      paint(raster, i, kNanColour);
      continue;
    }
    if (std::fabs(e) > used) ++clipped;
    const double place = e == 0 ? 0 : std::clamp(e / used, -1.0, 1.0);  // used > 0 where an error is not 0
    paint(raster, i, map[static_cast<std::size_t>(std::lround(place * kSteps) + kSteps)]);
  }
  raster.text = {{"moire:kind", "error"},
                 {"moire:range", shortest(used)},
                 {"moire:range_is", by_percentile ? "p99.5 of |error| over active pixels" : "max |error|"},
                 {"moire:map", "linear; blue negative, light grey zero, red positive (got - exact)"},
                 {"moire:clipped", std::to_string(clipped)},
                 {"moire:nan", std::to_string(nans)}};
  return raster;
}

}  // namespace moire
