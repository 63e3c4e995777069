// The spectrum of point sets, as a matrix product: exp(-2 pi i (m x + n y)) is a number of (m, point) times a number of
// (n, point). With cosines and sines apart, one real product gives the frequencies (m, n) and (m, -n) together.
#include "measure/point_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/double_double.h"
#include "core/parallel.h"
#include "measure/chi_square.h"
#include "measure/outer_sums.h"
#include "measure/radial.h"

namespace moire {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Points that are summed plainly before their sum and its rounding error are added to those of all points. The tables
// of so many points stay in the second-level cache up to 512 frequencies.
constexpr std::size_t kBlock = 128;

std::size_t rounded_up(std::size_t n, std::size_t step) { return (n + step - 1) / step * step; }

struct Turned {
  double cosine, sine;
};

// cos and sin of 2 pi k x within 3 * 2^-53, for x in [0, 1) and integers |k| <= 4096. The turns k x are reduced to
// [-1/8, 1/8] with one rounding, of 2^-57 turns at most, so that quarter turns are exact.
Turned turned(std::size_t k, double x) {
  const Dd turns = two_prod(static_cast<double>(k), x);
  const double part = turns.hi - std::nearbyint(turns.hi);
  const double quarters = std::nearbyint(4 * part);
  const double angle = 2 * kPi * ((part - quarters / 4) + turns.lo);
  const double c = std::cos(angle), s = std::sin(angle);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

// cos and sin of 2 pi k x for all k < count, each the product of two computed directly: k = a * stride + b. Within
// 7 * 2^-53; there is no chain of products.
class Waves {
 public:
  explicit Waves(std::size_t count)
      : stride_(static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))))),
        cosine_(rounded_up(count, stride_)),
        sine_(cosine_.size()) {}

  void set(double x) {
    for (std::size_t b = 0; b < stride_; ++b) {
      const Turned near = turned(b, x);
      cosine_[b] = near.cosine;
      sine_[b] = near.sine;
    }
    const double* __restrict c = cosine_.data();
    const double* __restrict s = sine_.data();
    for (std::size_t begin = stride_; begin < cosine_.size(); begin += stride_) {
      const Turned far = turned(begin, x);
      double* __restrict cosine = &cosine_[begin];
      double* __restrict sine = &sine_[begin];
      for (std::size_t b = 0; b < stride_; ++b) {
        cosine[b] = far.cosine * c[b] - far.sine * s[b];
        sine[b] = far.sine * c[b] + far.cosine * s[b];
      }
    }
  }
  const double* cosine() const { return cosine_.data(); }
  const double* sine() const { return sine_.data(); }

 private:
  std::size_t stride_;
  std::vector<double> cosine_, sine_;
};

// The waves of a block of points at frequencies 0..count-1 in panels of kHalf frequencies: of every point first the
// cosines of a panel, then its sines, zero from `count` on. Tables of rows and of columns differ in kHalf alone.
template <std::size_t kHalf>
class Panels {
 public:
  explicit Panels(std::size_t count) : count_((count + kHalf - 1) / kHalf), values_(count_ * kPanel) {}

  void set(std::size_t point, const Waves& waves, std::size_t frequencies) {
    for (std::size_t k = 0; k < frequencies; ++k) {
      double* entry = &values_[k / kHalf * kPanel + point * 2 * kHalf + k % kHalf];
      entry[0] = waves.cosine()[k];
      entry[kHalf] = waves.sine()[k];
    }
  }
  std::size_t count() const { return count_; }
  const double* panel(std::size_t p) const { return &values_[p * kPanel]; }

 private:
  static constexpr std::size_t kPanel = kBlock * 2 * kHalf;
  std::size_t count_;
  std::vector<double> values_;
};

// A tile has all four products of cosines and sines of kRows frequencies m with kColumns frequencies n.
constexpr std::size_t kRows = kTileRows / 2, kColumns = kTileColumns / 2, kTile = kTileRows * kTileColumns;

// Sums of products over all points of a set: sum + rest is the sum of what the kernels gave, to 2^-100 or so.
struct TileSums {
  double sum[kTile] = {}, rest[kTile] = {};

  void add(const double (&tile)[kTile]) {
    for (std::size_t i = 0; i < kTile; ++i) {
      const Dd s = two_sum(sum[i], tile[i]);
      sum[i] = s.hi;
      rest[i] += s.lo;
    }
  }
  double at(std::size_t row, std::size_t column) const {
    const std::size_t i = row * kTileColumns + column;
    return sum[i] + rest[i];
  }
};

std::vector<TileSums> products(std::span<const double> x, std::span<const double> y, std::size_t frequencies) {
  constexpr std::size_t kPart = 16;  // points that one thread takes
  const TileKernel kernel = tile_kernels().back();
  Panels<kRows> rows(frequencies);
  Panels<kColumns> columns(frequencies);
  std::vector<TileSums> sums(rows.count() * columns.count());
  for (std::size_t begin = 0; begin < x.size(); begin += kBlock) {
    const std::size_t points = std::min(kBlock, x.size() - begin);
    parallel_for((points + kPart - 1) / kPart, [&](std::size_t part) {
      Waves waves(frequencies);
      for (std::size_t i = part * kPart; i < std::min(points, (part + 1) * kPart); ++i) {
        waves.set(x[begin + i]);
        rows.set(i, waves, frequencies);
        waves.set(y[begin + i]);
        columns.set(i, waves, frequencies);
      }
    });
    parallel_for(
        rows.count(),
        [&](std::size_t r) {
          double tile[kTile];
          for (std::size_t c = 0; c < columns.count(); ++c) {
            kernel(points, rows.panel(r), columns.panel(c), tile);
            sums[r * columns.count() + c].add(tile);
          }
        },
        4);
  }
  return sums;
}

// sin(pi x) / (pi x); exactly 0 at integers but 0.
double sinc(double x) {
  if (x == 0) return 1;
  return x == std::nearbyint(x) ? 0.0 : std::sin(kPi * std::remainder(x, 2)) / (kPi * x);
}

}  // namespace

int usual_frequencies(std::int64_t points) {
  int frequencies = 64;
  while (frequencies < 1024 && std::int64_t{frequencies} * frequencies < 64 * points) frequencies *= 2;
  return frequencies;
}

PointSpectrum::PointSpectrum(int frequencies)
    : frequencies_(frequencies),
      half_(static_cast<std::size_t>((std::int64_t{frequencies} / 2 + 1) * (frequencies + 1))) {
  assert(frequencies >= kMinFrequencies && frequencies <= kMaxFrequencies && frequencies % 2 == 0);
}

void PointSpectrum::add(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size() && !x.empty());
  const auto half = static_cast<std::size_t>(frequencies_ / 2), count = half + 1;
  const std::vector<TileSums> sums = products(x, y, count);
  const std::size_t tiles = (count + kColumns - 1) / kColumns;  // along n
  const double points = static_cast<double>(x.size());
  for (std::size_t m = 0; m < count; ++m) {
    double* const line = &half_[m * (2 * half + 1) + half];  // n = 0
    for (std::size_t n = 0; n < count; ++n) {
      const TileSums& s = sums[m / kRows * tiles + n / kColumns];
      const std::size_t r = m % kRows, c = n % kColumns;
      const double cc = s.at(r, c), cs = s.at(r, c + kColumns), sc = s.at(r + kRows, c),
                   ss = s.at(r + kRows, c + kColumns);
      // exp(-i (a + b)) = (cc - ss) - i (sc + cs), exp(-i (a - b)) = (cc + ss) - i (sc - cs).
      line[n] += ((cc - ss) * (cc - ss) + (sc + cs) * (sc + cs)) / points;
      if (n > 0) *(line - n) += ((cc + ss) * (cc + ss) + (sc - cs) * (sc - cs)) / points;
    }
  }
  ++sets_;
}

std::vector<double> PointSpectrum::power() const {
  assert(sets_ > 0);
  const int half = frequencies_ / 2;
  const double sets = static_cast<double>(sets_);
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(frequencies_) * static_cast<std::size_t>(frequencies_));
  for (int n = -half; n < half; ++n) {
    for (int m = -half; m < half; ++m) {
      const std::int64_t row = std::abs(m), column = (m < 0 ? -n : n) + half;
      out.push_back(half_[static_cast<std::size_t>(row * (frequencies_ + 1) + column)] / sets);
    }
  }
  return out;
}

std::vector<RadialPower> radial_power(std::span<const double> power, int frequencies, std::int64_t sets) {
  const std::vector<Ring> all = rings(power, frequencies, frequencies);
  const auto dc = static_cast<std::size_t>((std::int64_t{frequencies} + 1) * (frequencies / 2));
  const double none = kNoPower * power[dc];  // there P = N
  std::vector<RadialPower> out;
  for (int k = 1; k < frequencies / 2; ++k) {
    const Ring& ring = all[static_cast<std::size_t>(k)];
    const std::int64_t degrees = ring.bins * sets;
    out.push_back({k, ring.bins, degrees, ring.mean, power_interval(ring.mean, static_cast<double>(degrees)),
                   ring.mean > none ? ring.anisotropy_db : std::numeric_limits<double>::quiet_NaN()});
  }
  return out;
}

double jittered_power(int cells, double amount, int m, int n) {
  const double s = sinc(amount * m / cells) * sinc(amount * n / cells);
  const bool on_lattice = m % cells == 0 && n % cells == 0;
  return 1 - s * s + (on_lattice ? static_cast<double>(cells) * cells * s * s : 0.0);
}

}  // namespace moire
