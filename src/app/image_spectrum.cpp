// The spectrum of an image's error.
#include "app/image_spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/sum.h"
#include "measure/contrast_sensitivity.h"
#include "measure/radial_spectrum.h"
#include "reports/preview.h"
#include "study/noise_measures.h"

namespace moire {
namespace {

struct Coverage {
  Grid grid;
  std::vector<double> y;
};

// `ending` in small letters.
bool ends_in(std::string_view word, std::string_view ending) {
  if (word.size() < ending.size()) return false;
  const std::string_view last = word.substr(word.size() - ending.size());
  return std::equal(last.begin(), last.end(), ending.begin(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

// The linear luminance of a pixel's channels: the weights of IEC 61966-2-1.
double luminance(const std::uint8_t* pixel, int channels) {
  if (channels == 1) return linear_of_srgb8(pixel[0]);
  return 0.2126 * linear_of_srgb8(pixel[0]) + 0.7152 * linear_of_srgb8(pixel[1]) + 0.0722 * linear_of_srgb8(pixel[2]);
}

Coverage read_coverage(const std::string& path) {
  Coverage image;
  if (ends_in(path, ".exr")) {
    const ExrImage exr = read_exr(path);
    image.grid = exr.grid;
    image.y.assign(exr.y.begin(), exr.y.end());
  } else {
    const Raster png = read_png(path);
    if (png.channels != 1 && png.channels != 3) {
      throw Error(path, fmt::format("has {} channels; give an image with 1 or 3, without alpha", png.channels));
    }
    image.grid = png.grid;
    for (std::size_t i = 0; i < png.pixels.size(); i += static_cast<std::size_t>(png.channels)) {
      image.y.push_back(luminance(&png.pixels[i], png.channels));
    }
  }
  const auto bad = std::find_if(image.y.begin(), image.y.end(), [](double v) { return !std::isfinite(v); });
  if (bad != image.y.end()) {
    const auto at = bad - image.y.begin();
    throw Error(path, fmt::format("pixel ({}, {}) is not finite; a spectrum needs a number everywhere",
                                  at % image.grid.width, at / image.grid.width));
  }
  return image;
}

Coverage read_error(const std::string& path, const std::string& reference) {
  Coverage error = read_coverage(path);
  if (reference.empty()) return error;
  const Coverage exact = read_coverage(reference);
  if (exact.grid.width != error.grid.width || exact.grid.height != error.grid.height) {
    throw Error(reference, fmt::format("is {} x {} pixels, but {} is {} x {}; give two images of one size",
                                       exact.grid.width, exact.grid.height, path, error.grid.width, error.grid.height));
  }
  for (std::size_t i = 0; i < error.y.size(); ++i) error.y[i] -= exact.y[i];
  return error;
}

Table radial_table(const Spectra& spectra) {
  Table table;
  for (const RadialSpectrum& ring : radial_spectrum(spectra)) {
    Row row;
    row.set("frequency", ring.frequency);
    row.set("bins", ring.total.bins);
    row.set("power", finite_cell(ring.total.mean));
    row.set("anisotropy_db", finite_cell(ring.total.anisotropy_db));
    table.push_back(std::move(row));
  }
  return table;
}

}  // namespace

bool is_image_name(std::string_view word) { return ends_in(word, ".exr") || ends_in(word, ".png"); }

SpectrumOutput image_spectrum(const std::string& path, const std::string& reference, SpectrumWindow window,
                              double pixels_per_degree) {
  const Coverage error = read_error(path, reference);
  if (!has_spectrum(error.grid)) {
    throw Error(path, fmt::format("has {} x {} pixels; a spectrum takes at most {}, and {} to a side", error.grid.width,
                                  error.grid.height, kMaxSpectrumPixels, kMaxSpectrumSide));
  }
  ErrorSpectra collected(error.grid.width, error.grid.height, window);
  collected.add(error.y);
  const Spectra spectra = collected.finish();
  Sum sum, squares;
  for (const double e : error.y) {
    sum.add(e);
    squares.add(e * e);
  }
  const double pixels = static_cast<double>(error.y.size());
  const double rmse = std::sqrt(squares.value() / pixels), csf_rms = csf_weighted_rms(spectra, pixels_per_degree);

  SpectrumOutput out;
  out.title =
      fmt::format("{}{}, {} x {} pixels{}: RMS {:.4g}, weighted with the eye's contrast sensitivity {:.4g}", path,
                  reference.empty() ? "" : " - " + reference, error.grid.width, error.grid.height,
                  window == SpectrumWindow::none ? "" : fmt::format(", window {}", name_of(window)), rmse, csf_rms);
  out.head.set("what", path);
  out.head.set("reference", reference.empty() ? Cell() : Cell(reference));
  out.head.set("width", std::int64_t{error.grid.width});
  out.head.set("height", std::int64_t{error.grid.height});
  out.head.set("window", std::string(name_of(window)));
  out.head.set("pixels_per_degree", pixels_per_degree);
  out.head.set("bias", sum.value() / pixels);
  out.head.set("rmse", rmse);
  out.head.set("csf_rms", csf_rms);
  out.radial = radial_table(spectra);
  out.columns = {
      {"frequency", "{:.4f}", "cycles per pixel: the middle of a ring as wide as one step"},
      {"bins", "", "frequencies in it; the rings above 0.5 have corners alone"},
      {"power", "{:.4g}",
       window == SpectrumWindow::none
           ? "mean power per pixel; the mean over all bins, that of zero too, is the mean squared error"
           : "mean power per pixel, through the window; rings without the 3 x 3 bins of the mean error"},
      {"anisotropy_db", "{:.1f}", "variance over mean^2 of the ring's bins (Ulichney 1988); isotropic: about 0 dB"}};
  out.grid = error.grid;
  out.power = spectra.total;
  out.scale = PowerScale::logarithmic;
  out.attributes = {{"moire:window", std::string(name_of(window))}};
  return out;
}

}  // namespace moire
