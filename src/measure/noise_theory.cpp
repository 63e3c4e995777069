// The noise spectrum to expect: covariances of pixels, summed over pairs of cells of an oversampled scene.
#include "measure/noise_theory.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "measure/dft.h"

namespace moire {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// sin(pi x) / (pi x)
double sinc(double x) {
  const double angle = std::numbers::pi * x;
  return std::fabs(angle) < 1e-4 ? 1 - angle * angle / 6 : std::sin(angle) / angle;
}

// One axis of the torus: its cells, and the pixels whose windows hold them.
class AxisWeights {
 public:
  AxisWeights(const Kernel& kernel, int pixels, int apron, int per_pixel)
      : kernel_(kernel), pixels_(pixels), per_pixel_(per_pixel), cells_((pixels + 2 * apron) * per_pixel) {
    seen_.resize(index(cells_));
    const auto kappa = [&](double from) { return kernel.K(from + side()) - kernel.K(from); };
    // Just inside the cell: its sides may be knots where the kernel jumps.
    const auto rise = [&](double from) {
      const double inset = side() * 0x1p-20;
      return kernel.k(from + side() - inset) - kernel.k(from + inset);
    };
    for (int c = 0; c < pixels; ++c) {
      const double middle = (apron + c + 0.5) * per_pixel, reach = kernel.radius() * per_pixel;
      // One cell more on each side, where differences are not zero yet.
      const int begin = std::max(0, static_cast<int>(std::floor(middle - reach)) - 1);
      const int end = std::min(cells_, static_cast<int>(std::ceil(middle + reach)) + 1);
      for (int i = begin; i < end; ++i) {
        const double from = (i - middle) / per_pixel, before = from - side(), after = from + side();
        seen_[index(i)].push_back(
            {c, from, kappa(from), rise(from), kappa(after) - kappa(before), rise(after) - rise(before)});
      }
    }
  }

  int cells() const noexcept { return cells_; }
  int pixels() const noexcept { return pixels_; }

  // What each cell weighs in each pixel.
  struct Seen {
    int pixel;
    double from;                    // the cell's lower side from the pixel's centre, pixels
    double weight;                  // integral of the kernel over the cell
    double rise;                    // of the kernel from one side of the cell to the other
    double weight_step, rise_step;  // of the next cell less that of the one before
  };
  const std::vector<Seen>& seen(int cell) const { return seen_[index(cell)]; }

  // For two points u cells apart: weight(i, slot) is the sum, over pairs of pixels of distance lag[slot] (modulo the
  // number of pixels), of the first one's weight of cell i times the second one's of cell i + u.
  struct Pairs {
    std::vector<int> lag;
    std::vector<double> weight;  // row i has lag.size() entries
  };
  Pairs two_points(int u) const {
    return pairs([this, u](int i, const auto& add) {
      const int other = ((i + u) % cells_ + cells_) % cells_;
      for (const Seen& a : seen_[index(i)])
        for (const Seen& b : seen_[index(other)]) add(b.pixel - a.pixel, product(a, b));
    });
  }

  // The same for one point, which both pixels see: integrals over the cell of the product of their weights.
  Pairs one_point() const {
    return pairs([this](int i, const auto& add) {
      // Gauss's rule of four points on [-1, 1]: exact for products of cubics.
      constexpr double kNodes[] = {0.33998104358485626, 0.86113631159405258};
      constexpr double kWeights[] = {0.65214515486254614, 0.34785484513745386};
      const double half = 0.5 / per_pixel_;
      for (const Seen& a : seen_[index(i)]) {
        for (const Seen& b : seen_[index(i)]) {
          double sum = 0;
          for (int node = 0; node < 2; ++node) {
            for (const double sign : {-1.0, 1.0}) {
              const double at = half * (1 + sign * kNodes[node]);
              sum += kWeights[node] * half * kernel_.k(a.from + at) * kernel_.k(b.from + at);
            }
          }
          add(b.pixel - a.pixel, sum);
        }
      }
    });
  }

 private:
  double side() const noexcept { return 1.0 / per_pixel_; }

  // The mean over two cells, of side h, of k(x) k(y) G(y - x) is that of k(x) k(y) times that of G, plus h^2 / 12 times
  // (k(x) k'(y) - k'(x) k(y)) G'(y - x): where neither kernel nor G is constant in a cell, the places where one is
  // large are not those where the other is. Summed by parts over y, G' becomes G and the factor its difference.
  double product(const Seen& a, const Seen& b) const noexcept {
    return a.weight * b.weight + side() / 24 * (a.rise * b.weight_step - a.weight * b.rise_step);
  }

  // visit(i, add) calls add(lag, weight) for what belongs to cell i.
  template <class Visit>
  Pairs pairs(const Visit& visit) const {
    const auto wrapped = [this](int lag) { return (lag % pixels_ + pixels_) % pixels_; };
    std::map<int, std::size_t> slots;
    for (int i = 0; i < cells_; ++i) visit(i, [&](int lag, double) { slots.emplace(wrapped(lag), 0); });
    Pairs out;
    for (auto& [lag, slot] : slots) {
      slot = out.lag.size();
      out.lag.push_back(lag);
    }
    out.weight.assign(index(cells_) * slots.size(), 0);
    for (int i = 0; i < cells_; ++i) {
      double* const row = out.weight.data() + index(i) * slots.size();
      visit(i, [&](int lag, double weight) { row[slots.find(wrapped(lag))->second] += weight; });
    }
    return out;
  }

  const Kernel& kernel_;
  int pixels_, per_pixel_, cells_;
  std::vector<std::vector<Seen>> seen_;  // of each cell
};

// Adds scale * sum over cells (i, j) of product(i, j) * across.weight(i, .) * down.weight(j, .) to `sums`, which has
// one entry for each pair of lags: the image's size, row-major. product(j, row) writes row j.
template <class Product>
void add_lags(const AxisWeights::Pairs& across, const AxisWeights::Pairs& down, int columns, int rows, int width,
              double scale, const Product& product, std::span<double> sums) {
  const std::size_t n = across.lag.size(), m = down.lag.size();
  std::vector<double> cells(index(columns)), row(n), lags(n * m, 0.0);
  for (int j = 0; j < rows; ++j) {
    if (!product(j, std::span(cells))) continue;
    std::fill(row.begin(), row.end(), 0.0);
    for (int i = 0; i < columns; ++i) {
      const double value = cells[index(i)];
      if (value == 0) continue;
      const double* const weight = across.weight.data() + index(i) * n;
      for (std::size_t slot = 0; slot < n; ++slot) row[slot] += value * weight[slot];
    }
    for (std::size_t b = 0; b < m; ++b) {
      const double weight = down.weight[index(j) * m + b];
      for (std::size_t a = 0; a < n; ++a) lags[b * n + a] += weight * row[a];
    }
  }
  for (std::size_t b = 0; b < m; ++b) {
    for (std::size_t a = 0; a < n; ++a)
      sums[index(down.lag[b]) * index(width) + index(across.lag[a])] += scale * lags[b * n + a];
  }
}

// Products of cells are those of a scene smoothed twice by a cell, which adds h^2 / 6 times its second derivatives to
// the autocorrelation (h a cell's side, edges in any place of their cells): a sixth of the second differences takes
// that off. It is the scene alone that is treated so; edges of kernels are sides of cells.
std::vector<double> sharpened(const std::vector<double>& scene, int columns, int rows) {
  const auto along = [&](const std::vector<double>& in, int length, std::size_t step, const auto& begin, int lines) {
    std::vector<double> out(in.size());
    for (int line = 0; line < lines; ++line) {
      const std::size_t first = begin(line);
      for (int i = 0; i < length; ++i) {
        const double here = in[first + index(i) * step];
        const double before = in[first + index(std::max(i - 1, 0)) * step];
        const double after = in[first + index(std::min(i + 1, length - 1)) * step];
        out[first + index(i) * step] = here - (before - 2 * here + after) / 6;
      }
    }
    return out;
  };
  const std::size_t row = index(columns);
  const std::vector<double> across = along(
      scene, columns, 1, [row](int j) { return index(j) * row; }, rows);
  return along(
      across, rows, row, [](int i) { return index(i); }, columns);
}

class NoiseSums {
 public:
  NoiseSums(const Kernel& kernel, const FineCoverage& scene)
      : scene_(scene),
        across_(kernel, scene.image.width, scene.apron, scene.per_pixel),
        down_(kernel, scene.image.height, scene.apron, scene.per_pixel),
        sharpened_(sharpened(scene.value, across_.cells(), down_.cells())) {
    assert(scene.per_pixel >= 2 && scene.per_pixel % 2 == 0);
    assert(scene.value.size() == index(across_.cells()) * index(down_.cells()));
  }

  std::size_t pixels() const { return index(across_.pixels()) * index(down_.pixels()); }

  // By lag, modulo the image's size: sums over pixels of rho times their covariances, without the constant of p.
  std::vector<double> covariances(const PairExcess& pairs) const {
    assert(pairs.reach < 0 || pairs.per_pixel == scene_.per_pixel);
    assert(2 * pairs.reach < std::min(across_.cells(), down_.cells()));
    std::vector<double> sums(pixels(), 0.0);
    add_lags(
        across_.one_point(), down_.one_point(), across_.cells(), down_.cells(), across_.pixels(), 1.0,
        [this](int j, std::span<double> out) {
          const auto row = this->row(scene_.value, j);
          std::copy(row.begin(), row.end(), out.begin());
          return true;
        },
        sums);
    if (pairs.reach < 0) return sums;

    // Distances u and -u give the same at opposite lags, which have the same cosines: those with u_y > 0, or u_y = 0
    // and u_x > 0, count twice.
    const int side = 2 * pairs.reach + 1;
    std::vector<AxisWeights::Pairs> down;
    for (int u = 0; u <= pairs.reach; ++u) down.push_back(down_.two_points(u));
    std::vector<std::vector<double>> parts(index(side));
    parallel_for(index(side), [&](std::size_t column) {
      const int ux = static_cast<int>(column) - pairs.reach;
      const AxisWeights::Pairs across = across_.two_points(ux);
      std::vector<double>& part = parts[column];
      part.assign(pixels(), 0.0);
      for (int uy = ux < 0 ? 1 : 0; uy <= pairs.reach; ++uy) {
        const double value = pairs.value[index(pairs.reach + uy) * index(side) + column];
        if (value == 0) continue;
        const double scale = ux == 0 && uy == 0 ? value : 2 * value;
        add_lags(
            across, down[index(uy)], across_.cells(), down_.cells(), across_.pixels(), scale,
            [this, ux, uy](int j, std::span<double> out) { return multiply_rows(j, ux, uy, out); }, part);
      }
    });
    for (const std::vector<double>& part : parts)
      for (std::size_t i = 0; i < part.size(); ++i) sums[i] += part[i];
    return sums;
  }

  // The exact image, as the cells know it.
  std::vector<double> image() const {
    std::vector<double> out(pixels(), 0.0), row(index(across_.pixels()));
    for (int j = 0; j < down_.cells(); ++j) {
      std::fill(row.begin(), row.end(), 0.0);
      for (int i = 0; i < across_.cells(); ++i)
        for (const auto& s : across_.seen(i)) row[index(s.pixel)] += s.weight * this->row(scene_.value, j)[index(i)];
      for (const auto& s : down_.seen(j))
        for (std::size_t c = 0; c < row.size(); ++c) out[index(s.pixel) * row.size() + c] += s.weight * row[c];
    }
    return out;
  }

 private:
  std::span<const double> row(const std::vector<double>& cells, int j) const {
    return std::span(cells).subspan(index(j) * index(across_.cells()), index(across_.cells()));
  }

  // The scene times itself (ux, uy) further on the torus; false where the row is empty.
  bool multiply_rows(int j, int ux, int uy, std::span<double> out) const {
    const int n = across_.cells();
    const auto a = row(scene_.value, j), b = row(sharpened_, (j + uy) % down_.cells());
    const int shift = (ux % n + n) % n;
    bool any = false;
    for (int i = 0; i < n - shift; ++i) any |= (out[index(i)] = a[index(i)] * b[index(i + shift)]) != 0;
    for (int i = n - shift; i < n; ++i) any |= (out[index(i)] = a[index(i)] * b[index(i + shift - n)]) != 0;
    return any;
  }

  const FineCoverage& scene_;
  AxisWeights across_, down_;
  std::vector<double> sharpened_;
};

// Entry (column, row) of a half spectrum that is stored with zero frequency first, for a bin of centred order.
template <class Value>
Value centred(std::span<const Value> half, int width, int height, int column, int row) {
  int k = (column - width / 2 + width) % width, l = (row - height / 2 + height) % height;
  if (k >= dft_columns(width)) {
    k = width - k;
    l = (height - l) % height;
  }
  return half[index(l) * index(dft_columns(width)) + index(k)];
}

}  // namespace

PairExcess random_pairs(int per_pixel) {
  PairExcess none;
  none.per_pixel = per_pixel;
  return none;
}

PairExcess jittered_pairs(double cell_width, double cell_height, int per_pixel) {
  assert(cell_width > 0 && cell_height > 0);
  const double h = 1.0 / per_pixel;
  PairExcess out;
  out.per_pixel = per_pixel;
  out.reach = static_cast<int>(std::ceil(std::max(cell_width, cell_height) * per_pixel)) + 1;
  out.zero_power = 0;
  // tri(u / a) is the second difference of |u| / (2 a); averaged over two cells it is that of |u|^3 / (12 a), taken
  // once more.
  const auto profile = [&](double a) {
    const auto integral = [a](double x) {
      const auto cube = [](double v) { return std::fabs(v) * v * v; };
      return (cube(x + a) - 2 * cube(x) + cube(x - a)) / (12 * a);
    };
    const auto mean = [&](int j) {
      return (integral((j + 1) * h) - 2 * integral(j * h) + integral((j - 1) * h)) / (h * h);
    };
    std::vector<double> values;
    for (int j = -out.reach; j <= out.reach; ++j) values.push_back(mean(j));
    return values;
  };
  const std::vector<double> x = profile(cell_width), y = profile(cell_height);
  for (const double v : y)
    for (const double u : x) out.value.push_back(-u * v / (cell_width * cell_height));
  return out;
}

PairExcess pairs_of_power(const std::function<double(double, double)>& power, double reach, int per_pixel) {
  assert(reach > 0);
  // A period of more than twice the largest distance keeps the p of the neighbouring periods away.
  int period = 8;
  while (period < 4 * reach) period *= 2;
  const int n = period * per_pixel, half = n / 2;
  std::vector<double> table;
  table.reserve(index(n) * index(n));
  // In the transform's order, zero frequency first. The mean over pairs of cells is a factor of sinc^2 in each axis.
  const auto frequency = [&](int k) { return static_cast<double>(k < half ? k : k - n) / period; };
  const auto cell = [&](double f) { return std::pow(sinc(f / per_pixel), 2); };
  for (int l = 0; l < n; ++l) {
    for (int k = 0; k < n; ++k) {
      const double fx = frequency(k), fy = frequency(l);
      table.push_back((power(fx, fy) - 1) * cell(fx) * cell(fy));
    }
  }
  const std::vector<std::complex<double>> transform = real_dft(table, n, n);

  PairExcess out;
  out.per_pixel = per_pixel;
  out.reach = static_cast<int>(reach * per_pixel);
  out.zero_power = power(0, 0);
  const double scale = 1.0 / (static_cast<double>(period) * period);
  for (int j = -out.reach; j <= out.reach; ++j) {
    for (int i = -out.reach; i <= out.reach; ++i)
      out.value.push_back(scale * centred(std::span(transform), n, n, i + half, j + half).real());
  }
  return out;
}

std::vector<double> expected_noise(const Kernel& kernel, const FineCoverage& scene, double density,
                                   const PairExcess& pairs) {
  const NoiseSums sums(kernel, scene);
  const int width = scene.image.width, height = scene.image.height;
  const std::vector<std::complex<double>> covariance = real_dft(sums.covariances(pairs), width, height),
                                          image = real_dft(sums.image(), width, height);
  const double area = (width + 2.0 * scene.apron) * (height + 2.0 * scene.apron);
  const double unit = 1 / (density * static_cast<double>(sums.pixels()));
  std::vector<double> out;
  out.reserve(sums.pixels());
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double pair_sum = centred(std::span(covariance), width, height, column, row).real();
      const double power = std::norm(centred(std::span(image), width, height, column, row));
      out.push_back(unit * (pair_sum - pairs.zero_power / area * power));
    }
  }
  return out;
}

}  // namespace moire
