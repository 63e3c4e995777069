// Monotone in spite of rounding: at() is defined by bisection of the multiples of a step, whose midpoints do not depend
// on u, so that a larger u can at no time go to the left of a smaller one. Newton's method then only says how much of
// the way can be gone without an evaluation.
#include "engine/inverse_distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/rounding.h"
#include "engine/sign_stretches.h"

namespace moire {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

constexpr int kMaxSteps = 40;

std::vector<SignStretch> stretches_of(const Kernel& kernel, int piece) {
  const auto i = static_cast<std::size_t>(piece);
  EvaluatedPolynomial k;
  std::vector<double> t;
  k.at = [&](std::span<const double> x, double* out) {
    t.resize(x.size());
    for (std::size_t j = 0; j < x.size(); ++j) t[j] = kernel.t_of(piece, x[j]);
    kernel.k_at(piece, t, out);
  };
  k.degree = kernel.degree();
  k.largest = kernel.bounds(piece).k;
  k.error = kernel.bounds(piece).k_error_at_x;
  k.begin = kernel.knots()[i];
  k.end = kernel.knots()[i + 1];
  return sign_stretches(k);
}

std::vector<SignStretch> stretches_of(const RadialKernel& kernel, int piece) {
  const auto i = static_cast<std::size_t>(piece);
  EvaluatedPolynomial k;
  k.at = [&](std::span<const double> r, double* out) {
    for (std::size_t j = 0; j < r.size(); ++j) out[j] = kernel.k_piece(piece, r[j]);
  };
  k.degree = kernel.degree();
  k.largest = kernel.bounds(piece).k;
  k.error = kernel.bounds(piece).k_error;
  k.begin = kernel.knots()[i];
  k.end = kernel.knots()[i + 1];
  return sign_stretches(k);
}

}  // namespace

InverseDistribution::InverseDistribution(const Filter& filter)
    : kernel_(filter.is_radial() ? nullptr : &filter.kernel()),
      radial_(filter.is_radial() ? &filter.radial_kernel() : nullptr),
      step_(std::exp2(std::ilogb(filter.radius()) - 52)) {
  const int pieces = kernel_ != nullptr ? kernel_->pieces() : radial_->pieces();
  double worst = 0;
  for (int piece = 0; piece < pieces; ++piece) add_piece(piece, bounds_of(piece), worst);
  // Once for what lies before a stretch and once for A; within a stretch; and u A and its rest are rounded.
  error_ = 2 * error_ + worst + 4 * kUnit * total_;
  // The integral of k is 1.
  if (!has_negative_lobes_) total_ = 1;
}

void InverseDistribution::add_piece(int piece, const Bounds& bounds, double& worst) {
  // Two integrals and their difference.
  const double rounding = 2 * bounds.integral_error + 4 * kUnit * bounds.integral;
  // What |k| may amount to where a stretch has the wrong sign: below 6 errors, or near two zeros that were not told
  // apart. There are at most 2^6 such places: one on either side of each of k's zeros, of which a series has 40.
  const double wrong =
      6 * bounds.density_error * bounds.length + 0x1p-80 * bounds.slope * bounds.length * bounds.length;
  for (const SignStretch& found : kernel_ != nullptr ? stretches_of(*kernel_, piece) : stretches_of(*radial_, piece)) {
    Stretch s{piece, found.sign, found.begin, found.end, integral(piece, found.begin), 0};
    const double mass = gain(s, s.end);
    if (!(mass > 0)) continue;
    // The true gain rises but for what is wrong, and both values of it may be off by the rounding.
    s.noise = 2 * rounding + wrong;
    mass_.push_back(total_);
    stretches_.push_back(s);
    total_ += mass;
    has_negative_lobes_ |= s.sign < 0;
    error_ += rounding + 2 * wrong + kUnit * total_;
    worst = std::max(worst, 3 * rounding + wrong + bounds.density * step_);
  }
  error_ += wrong;  // where there are no stretches
}

InverseDistribution::Bounds InverseDistribution::bounds_of(int piece) const {
  if (kernel_ != nullptr) {
    const Kernel::PieceBounds& b = kernel_->bounds(piece);
    return {b.K, b.K_error_at_x, b.k, b.k_error_at_x, b.slope, 2 * kernel_->half_length(piece)};
  }
  const RadialKernel::PieceBounds& b = radial_->bounds(piece);
  const double begin = radial_->knots()[static_cast<std::size_t>(piece)];
  const double r = radial_->knots()[static_cast<std::size_t>(piece) + 1], disk = kTwoPi * r * r;
  // Three products each, and 2 pi is rounded.
  return {disk * b.q,
          disk * (b.q_error + 4 * kUnit * b.q),
          kTwoPi * r * b.k,
          kTwoPi * r * (b.k_error + 4 * kUnit * b.k),
          kTwoPi * (b.k + r * b.slope),
          r - begin};
}

double InverseDistribution::integral(int piece, double x) const noexcept {
  return kernel_ != nullptr ? kernel_->K_piece(piece, x) : kTwoPi * (x * x) * radial_->q_piece(piece, x);
}

double InverseDistribution::density(int piece, double x) const noexcept {
  return kernel_ != nullptr ? kernel_->k_piece(piece, x) : kTwoPi * x * radial_->k_piece(piece, x);
}

std::size_t InverseDistribution::stretch_of(double mass) const noexcept {
  return static_cast<std::size_t>(std::upper_bound(mass_.begin() + 1, mass_.end(), mass) - mass_.begin()) - 1;
}

int InverseDistribution::sign(double u) const noexcept {
  return has_negative_lobes_ ? stretches_[stretch_of(u * total_)].sign : 1;
}

InverseDistribution::Point InverseDistribution::at(double u) const noexcept {
  const double mass = u * total_;
  const std::size_t i = stretch_of(mass);
  return {solve(stretches_[i], mass - mass_[i]), stretches_[i].sign};
}

// Newton's steps where they stay in the bracket and halve the last one, else bisection.
InverseDistribution::Near InverseDistribution::newton(const Stretch& s, double w) const noexcept {
  const std::size_t i = static_cast<std::size_t>(&s - stretches_.data());
  const double whole = (i + 1 < mass_.size() ? mass_[i + 1] : total_) - mass_[i];
  double low = s.begin, high = s.end, last = high - low;
  Near near{low + last * (w < whole ? w / whole : 0.5), 0};
  for (int step = 0; step < kMaxSteps; ++step) {
    const double miss = gain(s, near.x) - w;
    near.slope = s.sign * density(s.piece, near.x);
    (miss > 0 ? high : low) = near.x;
    if (std::fabs(miss) <= s.noise) break;
    const double next = near.x - miss / near.slope;
    const bool good = next > low && next < high && std::fabs(next - near.x) < 0.5 * last;  // false for NaN, too
    const double to = good ? next : 0.5 * (low + high);
    last = std::fabs(to - near.x);
    if (last <= step_) break;
    near.x = to;
  }
  return near;
}

double InverseDistribution::solve(const Stretch& s, double w) const noexcept {
  const Near near = newton(s, w);
  // Where bisection surely goes right and left.
  const double around = 3 * s.noise / std::max(near.slope, 0x1p-100) + 2 * step_;
  const double left = near.x - around, right = near.x + around;
  const double surely_right = left > s.begin && gain(s, left) + s.noise <= w ? left : s.begin;
  const double surely_left = right < s.end && gain(s, right) - s.noise > w ? right : s.end;
  // The point is in [low, high) of multiples of the step. Bisection halves aligned ranges, and so has the digits that
  // all of [low, high) share without a question.
  const std::uint64_t low = number_of(surely_right), high = std::max(low + 1, number_of(surely_left) + 1);
  const int digits = static_cast<int>(std::bit_width(low ^ (high - 1)));
  std::uint64_t at = low >> digits << digits;
  for (std::uint64_t half = std::uint64_t{1} << digits >> 1; half > 0; half >>= 1) {
    const double middle = place_of(at + half);
    if (middle <= surely_right || (middle < surely_left && gain(s, middle) <= w)) at += half;
  }
  return std::max(s.begin, place_of(at));
}

}  // namespace moire
