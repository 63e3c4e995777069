// Inner products of the errors of trials among themselves.
#include "measure/trial_products.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/parallel.h"

namespace moire {
namespace {

// Eight interleaved sums: compilers vectorise that, and the bits are the same for any vector width.
template <class Value>
double dot(std::span<const Value> a, std::span<const Value> b) {
  std::array<double, 8> sums{};
  std::size_t i = 0;
  for (; i + 8 <= a.size(); i += 8)
    for (std::size_t k = 0; k < 8; ++k) sums[k] += static_cast<double>(a[i + k]) * static_cast<double>(b[i + k]);
  for (; i < a.size(); ++i) sums[i % 8] += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

// The largest power of two that is not above the largest absolute value; 0 for zeros and for what is not finite.
double unit_of(std::span<const double> values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::fabs(v));
  return largest > 0 && std::isfinite(largest) ? std::ldexp(1.0, std::ilogb(largest)) : 0.0;
}

}  // namespace

double TrialProducts::squared_covariance(double unit) const {
  if (groups < 4) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<std::size_t>(groups);
  const double g = groups;
  // Centred: the sums below do not change, and lose nothing to a large mean. Rows then add up to 0, so that the part of
  // a row off the diagonal is the diagonal's negative.
  std::vector<double> row_mean(n, 0.0);
  double mean = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) row_mean[i] += products[i * n + j] / unit / g;
    mean += row_mean[i] / g;
  }
  double pairs = 0, diagonal = 0, diagonal_squared = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double h = products[i * n + j] / unit - row_mean[i] - row_mean[j] + mean;
      if (i != j) pairs += h * h;
      if (i != j) continue;
      diagonal += h;
      diagonal_squared += h * h;
    }
  }
  const double triples = diagonal_squared - pairs;
  const double quadruples = diagonal * diagonal - 4 * diagonal_squared + 2 * pairs;
  const double of_groups =
      pairs / (g * (g - 1)) - 2 * triples / (g * (g - 1) * (g - 2)) + quadruples / (g * (g - 1) * (g - 2) * (g - 3));
  const double m = static_cast<double>(group_trials);
  return m * m * of_groups;  // a mean of m trials has the covariance C / m
}

double TrialProducts::linear_variance(double share, std::int64_t trials, double unit) const {
  if (groups < 4) return 0;
  const auto n = static_cast<std::size_t>(groups);
  const double g = groups;
  const auto kernel = [&](std::size_t i, std::size_t j) {
    return products[i * n + j] / unit - share * (0.5 * (power[i] / unit + power[j] / unit));
  };
  double mean = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) mean += i == j ? 0 : kernel(i, j) / (g * (g - 1));
  // What is wanted is the covariance of two pairs that share one group: the mean of products of such pairs less that of
  // pairs that share none. To subtract the squared mean of all pairs instead would take off 4/T of it.
  double pairs = 0, triples = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0, squares = 0;
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const double h = kernel(i, j) - mean;
      row += h;
      squares += h * h;
    }
    pairs += squares;
    triples += row * row - squares;
  }
  const double quadruples = -4 * triples - 2 * pairs;  // all products together are 0
  const double of_group = triples / (g * (g - 1) * (g - 2)) - quadruples / (g * (g - 1) * (g - 2) * (g - 3));
  return std::max(0.0, 4 * static_cast<double>(group_trials) * of_group / static_cast<double>(trials));
}

void TrialGroups::add(std::span<const double> image, std::span<const double> left_out) {
  if (unit_ == 0) unit_ = unit_of(image);
  if (groups_.empty() || groups_.back().trials == group_trials_) {
    if (groups_.size() == static_cast<std::size_t>(kMostGroups)) join();
    groups_.push_back({std::vector<float>(image.size(), 0.0F), std::vector<double>(left_out.size(), 0.0), 0.0, 0});
  }
  Group& group = groups_.back();
  assert(group.image.size() == image.size() && group.left_out.size() == left_out.size());
  if (unit_ != 0) {  // else all of it is 0
    for (std::size_t i = 0; i < image.size(); ++i) group.image[i] += static_cast<float>(image[i] / unit_);
  }
  for (std::size_t i = 0; i < left_out.size(); ++i) group.left_out[i] += left_out[i];
  group.power += dot(image, image) - dot(left_out, left_out);
  ++group.trials;
}

void TrialGroups::join() {
  for (std::size_t i = 0; i < groups_.size() / 2; ++i) {
    if (i > 0) groups_[i] = std::move(groups_[2 * i]);
    const Group& other = groups_[2 * i + 1];
    Group& group = groups_[i];
    for (std::size_t p = 0; p < group.image.size(); ++p) group.image[p] += other.image[p];
    for (std::size_t p = 0; p < group.left_out.size(); ++p) group.left_out[p] += other.left_out[p];
    group.power += other.power;
    group.trials += other.trials;
  }
  groups_.resize(groups_.size() / 2);
  group_trials_ *= 2;
}

TrialProducts TrialGroups::finish(double scale) const {
  std::size_t n = groups_.size();
  if (n > 0 && groups_.back().trials < group_trials_) --n;
  TrialProducts out;
  out.groups = static_cast<int>(n);
  out.group_trials = group_trials_;
  out.products.resize(n * n);
  const double m = static_cast<double>(group_trials_), unit = unit_ * unit_;
  parallel_for(n, [&](std::size_t i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double product =
          unit * dot<float>(groups_[i].image, groups_[j].image) - dot<double>(groups_[i].left_out, groups_[j].left_out);
      out.products[i * n + j] = out.products[j * n + i] = scale * (product / (m * m));
    }
  });
  for (std::size_t i = 0; i < n; ++i) out.power.push_back(scale * (groups_[i].power / m));
  return out;
}

}  // namespace moire
