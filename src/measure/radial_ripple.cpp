// The largest ripple: candidates from a scan of an eighth of a pixel, of circles and of their crossings, refined.
#include "measure/radial_ripple.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/sum.h"

namespace moire {
namespace {

constexpr int kGrid = 32;             // steps over half a pixel
constexpr double kLocated = 0x1p-27;  // pixels: inside, where maxima are flat
constexpr double kOnBend = 0x1p-46;   // pixels: along a circle, where another one may bend the sum to a tip
constexpr double kOnCircle = 1e-12;   // pixels from a knot: more than rounding, less than anything else
constexpr double kAside = 0x1p-20;    // pixels: on a circle, the side is decided this far away
constexpr std::size_t kRefined = 8;   // of the candidates of one scan, the largest

// A field of ones, one sample a pixel, filtered: at a phase, or on one side of a circle.
class FlatField {
 public:
  explicit FlatField(const RadialKernel& kernel) : kernel_(kernel) {
    // Phases between -1 and 1.
    const int reach = static_cast<int>(std::ceil(kernel.radius())) + 1;
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        if (std::hypot(i, j) < kernel.radius() + std::numbers::sqrt2)
          pixels_.push_back({static_cast<double>(i), static_cast<double>(j)});
      }
    }
    for (int p = 0; p < kernel.pieces(); ++p) {
      const double knot = kernel.knots()[static_cast<std::size_t>(p) + 1];
      const double next = p + 1 < kernel.pieces() ? kernel.k_piece(p + 1, knot) : 0;
      if (std::fabs(kernel.k_piece(p, knot) - next) > 1e-12 * kernel.k_max()) jumps_.push_back(knot);
    }
    x_.resize(pixels_.size());
    y_.resize(pixels_.size());
    weight_.resize(pixels_.size());
  }

  // Knots at which k jumps.
  const std::vector<double>& jumps() const { return jumps_; }

  // |sum - 1|. On a circle with a jump, where the sum is what the half-open kernel makes of it and no limit, 0.
  double ripple(Vec2 phase) {
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      x_[i] = phase.x + pixels_[i].x;
      y_[i] = phase.y + pixels_[i].y;
    }
    for (const double jump : jumps_) {
      for (std::size_t i = 0; i < pixels_.size(); ++i) {
        if (std::fabs(std::sqrt(x_[i] * x_[i] + y_[i] * y_[i]) - jump) <= kOnCircle) return 0;
      }
    }
    kernel_.weights(x_, y_, weight_);
    Sum sum;
    for (const double w : weight_) sum.add(w);
    return std::fabs(sum.value() - 1);
  }

  // The limit at `phase` from the direction `from`, of length 1.
  double ripple(Vec2 phase, Vec2 from) const {
    Sum sum;
    for (const Vec2& pixel : pixels_) {
      const double x = phase.x + pixel.x, y = phase.y + pixel.y, r = std::sqrt(x * x + y * y);
      int piece = kernel_.piece_of(r);
      const double x_aside = x + kAside * from.x, y_aside = y + kAside * from.y;
      const int aside = kernel_.piece_of(std::sqrt(x_aside * x_aside + y_aside * y_aside));
      if (aside != piece) {
        const double knot = kernel_.knots()[static_cast<std::size_t>(std::max(aside, piece))];
        if (std::fabs(r - knot) <= kOnCircle) piece = aside;
      }
      if (piece < kernel_.pieces()) sum.add(kernel_.k_piece(piece, r));
    }
    return std::fabs(sum.value() - 1);
  }

 private:
  const RadialKernel& kernel_;
  std::vector<Vec2> pixels_;
  std::vector<double> jumps_, x_, y_, weight_;
};

// Whether the slope of k changes at the outer end of a piece, seen by three points on either side: by more than 1e-7 of
// the largest slope. Bends that are less hold up a climb in steps only where it is flat.
bool bends(const RadialKernel& kernel, int piece) {
  const auto slope = [&](int p, double sign) {
    const auto i = static_cast<std::size_t>(p);
    const double knot = kernel.knots()[static_cast<std::size_t>(piece) + 1];
    const double h = sign * 0x1p-14 * (kernel.knots()[i + 1] - kernel.knots()[i]);
    return (-3 * kernel.k_piece(p, knot) + 4 * kernel.k_piece(p, knot + h) - kernel.k_piece(p, knot + 2 * h)) / (2 * h);
  };
  const double outside = piece + 1 < kernel.pieces() ? slope(piece + 1, 1) : 0;
  return std::fabs(slope(piece, -1) - outside) > 1e-7 * kernel.slope_max();
}

struct Candidate {
  double value;
  double at[2];
};

void keep_largest(std::vector<Candidate>& all) {
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
  if (all.size() > kRefined) all.resize(kRefined);
}

// Inside. The sum has the symmetry of the square lattice: 0 <= y <= x <= 1/2 is all there is. A maximum is climbed to
// in steps along the axes, halved where none leads up.
double inside(FlatField& field) {
  constexpr double kStep = 0.5 / kGrid;
  double value[kGrid + 1][kGrid + 1];
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= i; ++j) value[i][j] = value[j][i] = field.ripple({kStep * i, kStep * j});
  }
  const auto at = [&](int i, int j) {
    const auto folded = [](int n) { return n < 0 ? -n : n > kGrid ? 2 * kGrid - n : n; };
    return value[folded(i)][folded(j)];
  };
  std::vector<Candidate> peaks;
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= i; ++j) {
      bool top = true;
      for (int di = -1; di <= 1; ++di) {
        for (int dj = -1; dj <= 1; ++dj) top = top && at(i + di, j + dj) <= at(i, j);
      }
      if (top) peaks.push_back({at(i, j), {kStep * i, kStep * j}});
    }
  }
  keep_largest(peaks);
  double worst = 0;
  for (const Candidate& peak : peaks) {
    Vec2 here = {peak.at[0], peak.at[1]};
    double best = peak.value;
    for (double step = kStep / 2; step > kLocated;) {
      const Vec2 before = here;
      for (const Vec2 by : {Vec2{step, 0}, Vec2{-step, 0}, Vec2{0, step}, Vec2{0, -step}}) {
        const Vec2 there = {before.x + by.x, before.y + by.y};
        const double found = field.ripple(there);
        if (found > best) best = found, here = there;
      }
      if (here == before) step /= 2;
    }
    worst = std::max(worst, best);
  }
  return worst;
}

// On one circle around a pixel's centre, from its inner or its outer side; all others are its images. The phase needs
// no reduction to one pixel but for FlatField, which takes those between -1 and 1.
double on_circle(const FlatField& field, double radius, double side) {
  const auto ripple = [&](double angle) {
    const Vec2 way = {std::cos(angle), std::sin(angle)};
    const double x = radius * way.x, y = radius * way.y;
    return field.ripple({x - std::nearbyint(x), y - std::nearbyint(y)}, {side * way.x, side * way.y});
  };
  const int steps = std::max(2 * kGrid, static_cast<int>(std::ceil(std::numbers::pi / 4 * radius * 2 * kGrid)));
  const double step = std::numbers::pi / 4 / steps;
  std::vector<double> value;
  for (int i = 0; i <= steps; ++i) value.push_back(ripple(step * i));
  std::vector<Candidate> peaks;
  for (int i = 0; i <= steps; ++i) {
    const double here = value[static_cast<std::size_t>(i)];
    const double before = value[static_cast<std::size_t>(std::abs(i - 1))];
    const double after = value[static_cast<std::size_t>(i < steps ? i + 1 : steps - 1)];
    if (here >= before && here >= after) peaks.push_back({here, {step * i, 0}});
  }
  keep_largest(peaks);
  double worst = 0;
  for (const Candidate& peak : peaks) {
    worst = std::max(worst, peak.value);
    // Golden section.
    constexpr double kGolden = std::numbers::phi - 1;
    double low = peak.at[0] - step, high = peak.at[0] + step;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low), fa = ripple(a), fb = ripple(b);
    while ((high - low) * radius > kOnBend) {
      if (fa > fb) {
        high = b, b = a, fb = fa, a = high - kGolden * (high - low), fa = ripple(a);
      } else {
        low = a, a = b, fa = fb, b = low + kGolden * (high - low), fb = ripple(b);
      }
    }
    worst = std::max({worst, fa, fb});
  }
  return worst;
}

// Where a circle around a pixel's centre meets one around another: there up to four sums and more have their limits,
// in sectors; 32 directions find those wider than 11 degrees, and what is left between circles that touch.
double at_crossings(const FlatField& field, double radius, double other) {
  constexpr int kDirections = 32;
  const int reach = static_cast<int>(std::ceil(radius + other));
  double worst = 0;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      const double apart = std::hypot(i, j);
      if (apart == 0 || apart > radius + other + kOnCircle || apart < std::fabs(radius - other) - kOnCircle) continue;
      // Along the line of centres and across it.
      const double along = 0.5 * (apart + (radius - other) * (radius + other) / apart);
      const double across = std::sqrt(std::max(0.0, (radius - along) * (radius + along)));
      for (const double side : {across, -across}) {
        const double x = (along * i - side * j) / apart, y = (along * j + side * i) / apart;
        if (y < -kOnCircle || x < y - kOnCircle) continue;
        const Vec2 phase = {x - std::nearbyint(x), y - std::nearbyint(y)};
        for (int n = 0; n < kDirections; ++n) {
          const double angle = std::numbers::pi * (2 * n) / kDirections;
          worst = std::max(worst, field.ripple(phase, {std::cos(angle), std::sin(angle)}));
        }
      }
    }
  }
  return worst;
}

}  // namespace

double radial_ripple(const RadialKernel& kernel) {
  FlatField field(kernel);
  double worst = inside(field);
  for (int p = 0; p < kernel.pieces(); ++p) {
    const double knot = kernel.knots()[static_cast<std::size_t>(p) + 1];
    const bool jumps = std::find(field.jumps().begin(), field.jumps().end(), knot) != field.jumps().end();
    if (jumps || bends(kernel, p)) worst = std::max(worst, on_circle(field, knot, -1));
    if (jumps) worst = std::max(worst, on_circle(field, knot, 1));
  }
  for (const double radius : field.jumps()) {
    for (const double other : field.jumps()) worst = std::max(worst, at_crossings(field, radius, other));
  }
  return worst;
}

}  // namespace moire
