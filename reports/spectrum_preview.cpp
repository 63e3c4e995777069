// Pictures of power spectra.
#include "reports/spectrum_preview.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/args.h"
#include "reports/preview.h"

namespace moire {
namespace {

struct Range {
  double black = 0, white = 0;
};

Range range_of(std::span<const float> power, std::size_t dc, PowerScale scale) {
  if (scale == PowerScale::linear) return {0, kPowerClip};
  double largest = 0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (i != dc) largest = std::fmax(largest, static_cast<double>(power[i]));  // skips NaN
  }
  return {largest * std::pow(10.0, -kDecades), largest};
}

std::uint8_t grey(double power, const Range& range, PowerScale scale) {
  if (scale == PowerScale::linear) return srgb8(power / range.white);
  if (!(power > range.black)) return 0;
  const double part = 1 + std::log10(power / range.white) / kDecades;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
}

}  // namespace

Raster spectrum_preview(Grid grid, std::span<const float> power, PowerScale scale) {
  assert(power.size() == static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  const auto dc = static_cast<std::size_t>(std::int64_t{grid.height / 2} * grid.width + grid.width / 2);
  const Range range = range_of(power, dc, scale);
  std::int64_t nans = 0, clipped = 0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (i == dc) continue;
    nans += std::isnan(power[i]) ? 1 : 0;
    clipped += static_cast<double>(power[i]) > range.white ? 1 : 0;
  }
  Raster raster{grid, nans > 0 ? 3 : 1, {}, {}};
  for (std::size_t i = 0; i < power.size(); ++i) {
    const bool nan = i != dc && std::isnan(power[i]);
    const std::uint8_t value = i == dc || nan ? std::uint8_t{0} : grey(static_cast<double>(power[i]), range, scale);
    if (raster.channels == 1) {
      raster.pixels.push_back(value);
    } else {
      const Rgb colour = nan ? kNanColour : Rgb{value, value, value};
      raster.pixels.insert(raster.pixels.end(), colour.begin(), colour.end());
    }
  }
  raster.text = {{"moire:kind", "spectrum"},
                 {"moire:scale", scale == PowerScale::linear ? "linear" : "log10"},
                 {"moire:range", shortest(range.black) + " " + shortest(range.white)},
                 {"moire:dc", "blanked"},
                 {"moire:clipped", std::to_string(clipped)},
                 {"moire:nan", std::to_string(nans)}};
  return raster;
}

}  // namespace moire
