// Orientation of three points in 128-bit integers, or as an expansion where they do not fit.
#include "measure/discrepancy/exact_turn.h"

#include <cmath>

#include "core/expansion.h"

namespace moire {
namespace {

__extension__ typedef __int128 Wide;  // not ISO C++, but g++ and clang have it on every 64-bit machine

// The products' rounding errors must not fall below the smallest double.
constexpr double kLift = 0x1p500;

}  // namespace

ExactTurn::ExactTurn(const PointView& points) : points_(points), fixed_(points.size()) {
  for (std::size_t i = 0; i < fixed_.size(); ++i) {
    const double x = points.x[i] * 0x1p63, y = points.y[i] * 0x1p63;
    fixed_[i] = {static_cast<std::int64_t>(x), static_cast<std::int64_t>(y), x == std::floor(x) && y == std::floor(y)};
  }
}

int ExactTurn::operator()(std::size_t i, std::size_t j, std::size_t k) const {
  const Fixed &p = fixed_[i], &q = fixed_[j], &r = fixed_[k];
  if (p.exact && q.exact && r.exact) {
    const Wide left = static_cast<Wide>(q.x - p.x) * (r.y - p.y), right = static_cast<Wide>(q.y - p.y) * (r.x - p.x);
    return (left > right) - (left < right);
  }
  // x_i y_i cancels. Scaling by powers of two is exact: coordinates are below 1.
  const auto x = [this](std::size_t a) { return points_.x[a] * kLift; };
  const auto y = [this](std::size_t a) { return points_.y[a] * kLift; };
  Expansion sum;
  sum.add_product(x(j), y(k));
  sum.add_product(-x(j), y(i));
  sum.add_product(-x(i), y(k));
  sum.add_product(-y(j), x(k));
  sum.add_product(y(j), x(i));
  sum.add_product(y(i), x(k));
  return sum.sign();
}

}  // namespace moire
