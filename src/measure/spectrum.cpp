// Spectra of signed error images, split into structure and noise.
#include "measure/spectrum.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/names.h"
#include "core/sum.h"
#include "measure/dft.h"

namespace moire {
namespace {

constexpr auto kWindowNames = std::to_array<std::string_view>({"none", "hann"});

std::size_t area(int width, int height) { return static_cast<std::size_t>(std::int64_t{width} * height); }

double mean_square(std::span<const double> values) {
  Sum sum;
  for (const double v : values) sum.add(v * v);
  return sum.value() / static_cast<double>(values.size());
}

// Bins by which the window spreads a tone along an axis of n pixels. With n < 3 Hann is a constant.
int lobe(SpectrumWindow window, int n) { return window == SpectrumWindow::hann && n >= 3 ? 1 : 0; }

// The part of a trial that lies in the bins of the mean error, as coordinates along orthonormal images: the product of
// two trials there is the sum of products of theirs.
std::vector<double> mean_part(std::span<const std::complex<double>> spectrum, SpectrumWindow window, int width,
                              int height) {
  std::vector<double> part;
  const double pixels = static_cast<double>(width) * height;
  for (int l = -lobe(window, height); l <= lobe(window, height); ++l) {
    for (int k = 0; k <= lobe(window, width); ++k) {
      const double unit = std::sqrt((k == 0 ? 1 : 2) / pixels);  // column -k has the same
      const std::complex<double> c =
          spectrum[static_cast<std::size_t>(std::int64_t{(l + height) % height} * dft_columns(width) + k)];
      part.push_back(unit * c.real());
      part.push_back(unit * c.imag());
    }
  }
  return part;
}

}  // namespace

std::span<const std::string_view> window_names() { return kWindowNames; }

std::string_view name_of(SpectrumWindow window) { return kWindowNames[static_cast<std::size_t>(window)]; }

SpectrumWindow find_window(std::string_view name, std::string_view place) {
  for (std::size_t i = 0; i < kWindowNames.size(); ++i) {
    if (kWindowNames[i] == name) return static_cast<SpectrumWindow>(i);
  }
  throw Error(std::string(place), unknown_name("window", name, kWindowNames));
}

std::vector<double> window_values(SpectrumWindow window, int n) {
  std::vector<double> values(static_cast<std::size_t>(n), 1.0);
  if (window == SpectrumWindow::none || n < 3) return values;
  for (int i = 0; i < n; ++i) {
    // From the nearer side, so that both halves have the same bits.
    const double s = std::sin(std::numbers::pi * (std::min(i, n - 1 - i) + 0.5) / n);
    values[static_cast<std::size_t>(i)] = s * s;
  }
  return values;
}

bool Spectra::is_mean(int column, int row) const noexcept {
  return std::abs(column - width / 2) <= lobe(window, width) && std::abs(row - height / 2) <= lobe(window, height);
}

std::vector<std::uint8_t> Spectra::mean_bins() const {
  std::vector<std::uint8_t> mask;
  mask.reserve(total.size());
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) mask.push_back(is_mean(column, row) ? 1 : 0);
  return mask;
}

bool Spectra::is_first(int column, int row) const noexcept {
  // The partner's place; -n / 2 of an even side is its own negative.
  const auto partner = [](int place, int n) { return n % 2 == 0 && place == 0 ? 0 : 2 * (n / 2) - place; };
  const int other_row = partner(row, height);
  return row != other_row ? row > other_row : column >= partner(column, width);
}

ErrorSpectra::ErrorSpectra(int width, int height, SpectrumWindow window)
    : width_(width),
      height_(height),
      window_(window),
      window_x_(window_values(window, width)),
      window_y_(window_values(window, height)),
      mean_(area(dft_columns(width), height)),
      deviations_(mean_.size()),
      pixel_mean_(area(width, height)),
      pixel_deviations_(area(width, height)) {
  assert(width > 0 && height > 0);
}

void ErrorSpectra::add(std::span<const double> error) {
  assert(error.size() == pixel_mean_.size());
  // Welford's updates: sums of squares less the square of the sum would lose the noise beside a large structure.
  const double t = static_cast<double>(++trials_);
  std::vector<double> windowed(error.size());
  std::size_t p = 0;
  for (const double wy : window_y_) {
    for (const double wx : window_x_) {
      const double value = error[p] * (wx * wy), from_old = value - pixel_mean_[p];
      pixel_mean_[p] += from_old / t;
      pixel_deviations_[p] += from_old * (value - pixel_mean_[p]);
      windowed[p++] = value;
    }
  }
  const std::vector<std::complex<double>> spectrum = real_dft(windowed, width_, height_);
  groups_.add(windowed, mean_part(spectrum, window_, width_, height_));
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const std::complex<double> from_old = spectrum[k] - mean_[k];
    mean_[k] += from_old / t;
    const std::complex<double> from_new = spectrum[k] - mean_[k];
    deviations_[k] += from_old.real() * from_new.real() + from_old.imag() * from_new.imag();
  }
}

Spectra ErrorSpectra::finish(bool varies) const {
  assert(trials_ > 0);
  Spectra s;
  s.width = width_;
  s.height = height_;
  s.window = window_;
  s.trials = trials_;
  const std::size_t pixels = area(width_, height_);
  const double t = static_cast<double>(trials_);
  const bool split = trials_ > 1 || !varies;
  s.total.resize(pixels);
  if (split) {
    s.structured.resize(pixels);
    s.noise.resize(pixels);
    s.energy.resize(pixels);
    for (std::size_t p = 0; p < pixels && trials_ > 1; ++p) s.energy[p] = pixel_deviations_[p] / (t - 1);
  }

  const double scale = 1 / (static_cast<double>(pixels) * mean_square(window_x_) * mean_square(window_y_));
  if (trials_ > 1) s.products = groups_.finish(scale);
  for (int row = 0; row < height_; ++row) {
    for (int column = 0; column < width_; ++column) {
      // Where the transform has this bin, k >= 0 and l modulo the height; of a pair, both read the same one.
      int k = column - width_ / 2, l = row - height_ / 2;
      if (!s.is_first(column, row)) k = -k, l = -l;
      if (k < 0 && 2 * k != -width_) k = -k, l = -l;
      const auto from =
          static_cast<std::size_t>(std::int64_t{(l + height_) % height_} * dft_columns(width_) + std::abs(k));
      const double mean = std::norm(mean_[from]) * scale, deviations = deviations_[from] * scale;
      const std::size_t to = s.index(column, row);
      s.total[to] = mean + deviations / t;
      if (!split) continue;
      s.noise[to] = trials_ > 1 ? deviations / (t - 1) : 0.0;
      s.structured[to] = mean - s.noise[to] / t;
    }
  }
  return s;
}

}  // namespace moire
