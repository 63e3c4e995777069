// Hard images and point sets for spectra: constants, single pixels, tones, 300 orders of magnitude in one image, prime
// sides, one row or column; against sums over all pixels in 64 bits, whose phases are reduced in integers.
//
// Limits where the program claims none: a bin's power |X|^2 / pixels follows from the transform's error d by 2 |X| d +
// d^2, with six roundings more; the mean over all bins (Parseval) from that of the bins; the mean of a ring's bins has
// two roundings, of the compensated sum and of the quotient.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/rounding.h"
#include "measure/dft.h"
#include "measure/point_spectrum.h"
#include "measure/radial.h"
#include "measure/spectrum.h"
#include "oracle/quad.h"
#include "stress/chance.h"
#include "stress/family.h"
#include "stress/weighted_points.h"
#include "stress/worst.h"

namespace moire::stress {
namespace {

using oracle::Quad;
using Long = long double;

constexpr double kExtended = 0x1p-64;  // of a rounding in 64 bits

struct Complex {
  Long re = 0, im = 0;
};

using Case = ManyValues;

std::string_view image_kind(std::size_t kind) {
  constexpr std::string_view kKinds[] = {"constant",           "one pixel",        "tone", "checkered", "1e-150..1e150",
                                         "noise on an offset", "row of two values"};
  return kKinds[kind % std::size(kKinds)];
}

struct Image {
  int width = 1, height = 1;
  std::vector<double> value;
  double norm = 0;  // root of the sum of squares
  double sum = 0;   // of absolute values
};

Image hard_image(Chance& chance, std::size_t kind, double largest, std::string& text) {
  constexpr int kSides[] = {1, 2, 3, 4, 5, 7, 8, 13, 16, 17, 31, 32, 37, 48};
  Image image;
  image.width = chance.pick(kSides);
  image.height = chance.pick(kSides);
  if (chance.below(16) == 0) {
    // One long row or column, prime sides among them.
    constexpr int kLong[] = {251, 509, 1021, 2048, 4093};
    image.width = chance.pick(kLong);
    image.height = 1;
    if (chance.coin()) std::swap(image.width, image.height);
  }
  const double scale = chance.sign() * chance.decades(1 / largest, largest);
  const auto k = chance.below(static_cast<std::uint64_t>(image.width)),
             l = chance.below(static_cast<std::uint64_t>(image.height));
  const std::string_view name = image_kind(kind);
  const double offset = chance.decades(1, 1e15);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double v = 1;
      if (name == "one pixel") v = x == static_cast<int>(k) && y == static_cast<int>(l) ? 1 : 0;
      if (name == "tone") {
        v = std::cos(2 * std::numbers::pi *
                     (static_cast<double>(k) * x / image.width + static_cast<double>(l) * y / image.height));
      }
      if (name == "checkered") v = (x + y) % 2 == 0 ? 1 : -1;
      if (name == "1e-150..1e150") v = chance.sign() * chance.decades(1 / largest, largest) / scale;
      if (name == "noise on an offset") v = 1 + chance.between(-1, 1) / offset;
      if (name == "row of two values") v = x < static_cast<int>(k) ? 1 : 1 + 1 / offset;
      image.value.push_back(scale * v);
    }
  }
  Long squares = 0, sum = 0;
  for (const double v : image.value) {
    squares += static_cast<Long>(v) * static_cast<Long>(v);
    sum += std::fabs(static_cast<Long>(v));
  }
  image.norm = static_cast<double>(std::sqrt(squares));
  image.sum = static_cast<double>(sum);
  text = fmt::format("{} of {} x {} pixels, scale {:.17g}", name, image.width, image.height, scale);
  return image;
}

// exp(-2 pi i a / n).
Complex turn(std::int64_t a, int n) {
  const Long angle = 2 * std::numbers::pi_v<Long> * static_cast<Long>(a % n) / static_cast<Long>(n);
  return {std::cos(angle), -std::sin(angle)};
}

// One bin by the definition; naive: the same in double, the phase not reduced.
Complex bin(const Image& image, int k, int l, Complex& naive) {
  Complex sum;
  double re = 0, im = 0;
  std::size_t p = 0;
  for (int y = 0; y < image.height; ++y) {
    Complex row;
    for (int x = 0; x < image.width; ++x, ++p) {
      const Complex t = turn(std::int64_t{k} * x, image.width);
      row.re += static_cast<Long>(image.value[p]) * t.re;
      row.im += static_cast<Long>(image.value[p]) * t.im;
      const double angle = -2 * std::numbers::pi *
                           (static_cast<double>(k) * x / image.width + static_cast<double>(l) * y / image.height);
      re += image.value[p] * std::cos(angle);
      im += image.value[p] * std::sin(angle);
    }
    const Complex t = turn(std::int64_t{l} * y, image.height);
    sum.re += row.re * t.re - row.im * t.im;
    sum.im += row.re * t.im + row.im * t.re;
  }
  naive = {static_cast<Long>(re), static_cast<Long>(im)};
  return sum;
}

// Of a bin, whose terms have some 8 roundings of their factors and those of the additions.
double bin_oracle_error(const Image& image) { return (8 + image.width + image.height) * kExtended * image.sum; }
double dft_bound(const Image& image) { return 4e-16 * (image.width + image.height) * image.sum; }

double distance(const Complex& a, const Complex& b) {
  return static_cast<double>(std::hypot(a.re - b.re, a.im - b.im));
}

// All fields over the norm: images of 300 orders of magnitude in one table. Twice: over its square, for power.
Measured over(Measured m, double norm) {
  for (double* v : {&m.computed, &m.wanted, &m.error, &m.bound, &m.oracle_error, &m.naive_error}) *v /= norm;
  return m;
}

void transform(Chance& chance, std::size_t kind, Case& c) {
  const Image image = hard_image(chance, kind, 1e150, c.text);
  const auto got = real_dft(image.value, image.width, image.height);
  const int columns = dft_columns(image.width);
  for (int i = 0; i < 24; ++i) {
    const int k = static_cast<int>(chance.below(static_cast<std::uint64_t>(columns)));
    const int l = i == 0 ? 0 : static_cast<int>(chance.below(static_cast<std::uint64_t>(image.height)));
    const auto& x = got[static_cast<std::size_t>(l * columns + k)];
    Complex naive;
    const Complex want = bin(image, k, l, naive);
    Measured m;
    m.quantity = "X";
    m.at = l * columns + k;
    m.computed = std::abs(x);
    m.wanted = static_cast<double>(std::hypot(want.re, want.im));
    m.error = distance({static_cast<Long>(x.real()), static_cast<Long>(x.imag())}, want);
    m.bound = dft_bound(image);
    m.oracle_error = bin_oracle_error(image);
    m.naive_error = distance(naive, want);
    c.worst.see(over(m, image.norm));
  }
}

void periodogram(Chance& chance, std::size_t kind, Case& c) {
  const Image image = hard_image(chance, kind, 1e140, c.text);
  ErrorSpectra spectra(image.width, image.height, SpectrumWindow::none);
  spectra.add(image.value);
  const Spectra got = spectra.finish();
  const Long pixels = static_cast<Long>(image.value.size());
  const double d = dft_bound(image), oracle_d = bin_oracle_error(image);
  const auto bound_of = [&](double size, double error) {
    return (2 * size * error + error * error) / static_cast<double>(pixels);
  };
  Long total = 0;
  double total_bound = 0;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const double power = got.total[got.index(column, row)];
      total += static_cast<Long>(power);
      const double size = std::sqrt(std::fabs(power) * static_cast<double>(pixels)) + d;
      total_bound += bound_of(size, d) + 6.01 * kUnit * power;
      if (chance.below(image.value.size()) >= 12) continue;
      Complex naive;
      const Complex want = bin(image, (column - image.width / 2 + image.width) % image.width,
                               (row - image.height / 2 + image.height) % image.height, naive);
      const Long truth = (want.re * want.re + want.im * want.im) / pixels;
      Measured m;
      m.quantity = "power";
      m.at = static_cast<double>(got.index(column, row));
      m.computed = power;
      m.wanted = static_cast<double>(truth);
      m.error = static_cast<double>(std::fabs(static_cast<Long>(power) - truth));
      const double true_size = static_cast<double>(std::hypot(want.re, want.im));
      m.bound = bound_of(true_size, d) + 6.01 * kUnit * m.wanted;
      m.oracle_error = bound_of(true_size, oracle_d) + 8 * kExtended * m.wanted;
      m.naive_error = static_cast<double>(std::fabs((naive.re * naive.re + naive.im * naive.im) / pixels - truth));
      c.worst.see(over(over(m, image.norm), image.norm));
    }
  }
  // Parseval: the mean over bins is the mean square over pixels.
  Long squares = 0;
  for (const double v : image.value) squares += static_cast<Long>(v) * static_cast<Long>(v);
  Measured m;
  m.quantity = "mean power";
  m.computed = static_cast<double>(total / pixels);
  m.wanted = static_cast<double>(squares / pixels);
  m.error = static_cast<double>(std::fabs(total - squares) / pixels);
  m.bound = total_bound / static_cast<double>(pixels);
  m.oracle_error = 2 * static_cast<double>(pixels) * kExtended * m.wanted;
  c.worst.see(over(over(m, image.norm), image.norm));
}

// Powers at integer frequencies; P(m, n) and sums over N, in units of N.
void point_power(Chance& chance, std::size_t kind, Case& c) {
  WeightedPoints w = hard_points(chance, kind % kPointKinds.size(), 60);
  if (chance.coin()) multiply(w, 1 + chance.below(500));
  const PlainPoints p = spread(w, chance);
  constexpr int kSizes[] = {4, 8, 16, 64};
  const int frequencies = chance.pick(kSizes), half = frequencies / 2;
  PointSpectrum spectrum(frequencies);
  spectrum.add(p.x, p.y);
  const std::vector<double> power = spectrum.power();
  const double n = static_cast<double>(w.points());
  c.text =
      fmt::format("{} points, {}, {} frequencies", w.points(), kPointKinds[kind % kPointKinds.size()], frequencies);
  // The phase's fraction in 113 bits: m x has at most 65.
  const auto turns = [](int m, double x) {
    const Quad all = static_cast<Quad>(m) * oracle::widen(x);
    return all - static_cast<Quad>(static_cast<std::int64_t>(all));
  };
  for (int i = 0; i < 16; ++i) {
    const int column = static_cast<int>(chance.below(static_cast<std::uint64_t>(frequencies)));
    const int row = static_cast<int>(chance.below(static_cast<std::uint64_t>(frequencies)));
    Complex sum;
    double re = 0, im = 0;
    for (std::size_t j = 0; j < w.places(); ++j) {
      const Quad phase = turns(column - half, w.x[j]) + turns(row - half, w.y[j]);
      const Long angle = -2 * std::numbers::pi_v<Long> * oracle::narrow(phase), count = static_cast<Long>(w.count[j]);
      sum.re += count * std::cos(angle);
      sum.im += count * std::sin(angle);
      const double plain = -2 * std::numbers::pi * ((column - half) * w.x[j] + (row - half) * w.y[j]);
      re += static_cast<double>(w.count[j]) * std::cos(plain);
      im += static_cast<double>(w.count[j]) * std::sin(plain);
    }
    const Long truth = (sum.re * sum.re + sum.im * sum.im) / static_cast<Long>(n);
    Measured m;
    m.quantity = "P";
    m.at = row * frequencies + column;
    m.computed = power[static_cast<std::size_t>(row * frequencies + column)];
    m.wanted = static_cast<double>(truth);
    m.error = static_cast<double>(std::fabs(static_cast<Long>(m.computed) - truth));
    const auto bound_of = [&](double e) { return 2 * e * std::sqrt(m.wanted * n) + e * e * n; };
    m.bound = bound_of(2e-14);
    // Angles up to 4 pi, their rounding, and that of the additions.
    m.oracle_error = bound_of((30 + static_cast<double>(w.places())) * kExtended) + 8 * kExtended * m.wanted;
    m.naive_error = std::fabs((re * re + im * im) / n - m.wanted);
    c.worst.see(over(m, n));
  }
}

void ring_means(Chance& chance, std::size_t, Case& c) {
  const int side = 1 + static_cast<int>(chance.below(40));
  std::vector<double> power;
  for (int i = 0; i < side * side; ++i) power.push_back(chance.decades(1e-150, 1e150));
  c.text = fmt::format("rings of {0} x {0} bins of 1e-150..1e150", side);
  const std::vector<Ring> got = rings(power, side, side);
  for (std::size_t ring = 1; ring < got.size(); ++ring) {
    Quad sum = 0;
    double naive = 0;
    std::int64_t bins = 0;
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const std::int64_t u = i - side / 2, v = j - side / 2, four = 4 * (u * u + v * v);
        const auto k = static_cast<std::int64_t>(ring);
        if (four == 0 || four < (2 * k - 1) * (2 * k - 1) || four >= (2 * k + 1) * (2 * k + 1)) continue;
        const double p = power[static_cast<std::size_t>(j * side + i)];
        sum += oracle::widen(p);
        naive += p;
        ++bins;
      }
    }
    if (bins != got[ring].bins) c.worst.fault(fmt::format("ring {} has {} bins, not {}", ring, got[ring].bins, bins));
    if (bins == 0) continue;
    const Quad mean = sum / static_cast<Quad>(bins);
    const auto error_of = [&](double v) { return static_cast<double>(oracle::abs(oracle::widen(v) - mean)); };
    Measured m;
    m.quantity = "ring";
    m.at = static_cast<double>(ring);
    m.computed = got[ring].mean;
    m.wanted = static_cast<double>(mean);
    m.error = error_of(m.computed);
    m.bound = (2.01 * kUnit + static_cast<double>(bins * bins) * 0x1p-106) * m.wanted;
    m.oracle_error = static_cast<double>(bins + 2) * 0x1p-112 * m.wanted;
    m.naive_error = error_of(naive / static_cast<double>(bins));
    c.worst.see(over(m, m.wanted));
  }
}

Case run_case_of(CaseKey key) {
  constexpr void (*kKinds[])(Chance&, std::size_t, Case&) = {transform, periodogram, point_power, ring_means};
  Chance chance("spectra", key);
  Case c;
  kKinds[key.index % std::size(kKinds)](chance, key.index / std::size(kKinds), c);
  // Bins far below the largest are where digits are lost.
  const Measured& worst = c.worst.worst();
  c.severity = worst.wanted > 0 ? std::clamp(1 / worst.wanted, 1e-3, 1e40) : 1e40;
  return c;
}

Outcome run(CaseKey key) { return run_case_of(key).outcome(); }

std::string describe(CaseKey key) {
  const Case c = run_case_of(key);
  return fmt::format("{} {} of {}", c.worst.worst().quantity, c.worst.worst().at, c.text);
}

}  // namespace

extern const Family spectra;
constinit const Family spectra = {
    .name = "spectra",
    .title = "constants, single pixels, tones, 1e-150 to 1e150 in one image, prime sides; point sets; rings",
    .quantity = "transforms over the image's norm, power over its square, of points over N, rings relative",
    .severity = "norm over the value",
    .claim = "measure/dft.h, point_spectrum.h; power and means by what follows from them and roundings counted",
    .share = 1,
    .run = run,
    .describe = describe};

}  // namespace moire::stress
