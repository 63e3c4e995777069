// Mean power by distance from zero frequency.
#include "measure/radial.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/sum.h"

namespace moire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Calls visit(ring, power, own) for every bin but zero frequency and those left out, row by row; `own`: the bin is its
// own partner.
template <class Visit>
void for_each_bin(std::span<const double> power, int width, int height, std::span<const std::uint8_t> left_out,
                  const Visit& visit) {
  const double larger = std::max(width, height), per_column = larger / width, per_row = larger / height;
  const auto is_own = [](int k, int n) { return k == 0 || (n % 2 == 0 && k == -(n / 2)); };
  for (int j = -(height / 2); j < height - height / 2; ++j) {
    for (int i = -(width / 2); i < width - width / 2; ++i) {
      const auto at = static_cast<std::size_t>(std::int64_t{j + height / 2} * width + i + width / 2);
      if ((i == 0 && j == 0) || (!left_out.empty() && left_out[at] != 0)) continue;
      const auto ring = static_cast<std::size_t>(ring_of(i * per_column, j * per_row));
      visit(ring, power[at], is_own(i, width) && is_own(j, height));
    }
  }
}

}  // namespace

int ring_of(double u, double v) { return static_cast<int>(std::sqrt(u * u + v * v) + 0.5); }

std::vector<Ring> rings(std::span<const double> power, int width, int height, std::span<const std::uint8_t> left_out) {
  assert(width > 0 && height > 0 && power.size() == static_cast<std::size_t>(std::int64_t{width} * height));
  assert(left_out.empty() || left_out.size() == power.size());
  const double larger = std::max(width, height);
  const int last = ring_of((width / 2) * (larger / width), (height / 2) * (larger / height));
  const auto count = static_cast<std::size_t>(last) + 1;
  std::vector<Ring> out(count);
  std::vector<Sum> sums(count), squares(count);
  std::vector<std::int64_t> own(count, 0);
  for_each_bin(power, width, height, left_out, [&](std::size_t k, double p, bool is_own) {
    ++out[k].bins;
    own[k] += is_own ? 1 : 0;
    sums[k].add(p);
  });
  for (std::size_t k = 0; k < count; ++k) out[k].mean = sums[k].value() / static_cast<double>(out[k].bins);
  for_each_bin(power, width, height, left_out, [&](std::size_t k, double p, bool is_own) {
    const double deviation = p - out[k].mean;
    squares[k].add((is_own ? 1.0 : 0.5) * deviation * deviation);  // a pair comes twice and counts once
  });
  for (std::size_t k = 0; k < count; ++k) {
    Ring& ring = out[k];
    ring.distinct = (ring.bins + own[k]) / 2;
    const double variance = squares[k].value() / static_cast<double>(ring.distinct - 1);
    const double scatter = variance / (ring.mean * ring.mean);
    const bool usable = ring.distinct > 1 && ring.mean > 0 && scatter > kFlat;
    ring.anisotropy_db = usable ? 10 * std::log10(scatter) : kNan;
  }
  return out;
}

}  // namespace moire
