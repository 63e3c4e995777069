#include "testimages/board_side.h"

#include <cmath>
#include <utility>

#include "core/rounding.h"

namespace moire {
namespace {

using Row = LocalHomography::Row;

// Beyond so many squares from the origin the ends of a side, right to 2^-98 or so, no longer tell single squares apart.
constexpr double kFarthest = 0x1p40;

// a b - c d.
Bounded cross(Dd a, Dd b, Dd c, Dd d) {
  return {(a * b - c * d).value(), 0x1p-98 * (std::fabs(a.hi * b.hi) + std::fabs(c.hi * d.hi))};
}

// floor(f / w), right up to 2^-98 or so of f.
double square_at(Dd f, Dd w) {
  double k = std::floor(f.hi / w.hi);
  const Dd rest = f - Dd(k) * w;
  if (rest.hi < 0) return k - 1;
  return (rest - w).hi >= 0 ? k + 1 : k;
}

}  // namespace

double row_noise(const Row& r, double reach) {
  return r.c_error + 0x1p-100 * ((std::fabs(r.a) + std::fabs(r.b)) * reach + std::fabs(r.c.hi));
}

BoardSide::BoardSide(const Row& smooth, const Row& jump, const Row& w, Vec2 p, Vec2 q, double s_noise, double j_noise,
                     double w_noise)
    : a(p), b(q) {
  if (row_at(w, a).hi > row_at(w, b).hi) {
    std::swap(a, b);
    sign = -1;
  }
  s0 = row_at(smooth, a), j0 = row_at(jump, a), w0 = row_at(w, a);
  s1 = row_at(smooth, b), j1 = row_at(jump, b), w1 = row_at(w, b);
  along_s = cross(s1, w0, s0, w1);
  along_j = cross(j1, w0, j0, w1);
  along_s.error += 2 * (s_noise * std::fabs(w1.hi) + w_noise * std::max(std::fabs(s0.hi), std::fabs(s1.hi)));
  along_j.error += 2 * (j_noise * std::fabs(w1.hi) + w_noise * std::max(std::fabs(j0.hi), std::fabs(j1.hi)));
}

// Between W = a and W = w1 the side crosses (|S'W - SW'| + |J'W - JW'|) (1/a - 1/w1) / (w1 - w0) lines; nearly level,
// as many on all of it.
double BoardSide::lines_beyond(double depth) const {
  const double along = std::fabs(along_s.value) + std::fabs(along_j.value);
  const double low = w0.value(), high = w1.value();
  if (depth <= low) return along / (low * high);
  if (depth >= high) return 0;
  return along * ((high - depth) / (high - low)) / (depth * high);
}

SideLines::SideLines(Dd f0, Dd f1, const BoardSide& side, double f_noise, double w_noise)
    : w0_(side.w0.value()), w1_(side.w1.value()) {
  const Dd t = side.from;
  const double first = square_at(f0 + t * (f1 - f0), side.w0 + t * (side.w1 - side.w0)), last = square_at(f1, side.w1);
  if (!(std::fabs(first) < kFarthest && std::fabs(last) < kFarthest)) return;
  valid_ = true;
  first_ = first;
  last_ = last;
  current_ = first;
  step_ = last < first ? -1 : 1;
  left_ = std::fabs(last - first);
  base0_ = (f0 - Dd(first) * side.w0).value();
  base1_ = (f1 - Dd(last) * side.w1).value();
  noise_ = 4 * (f_noise + (std::max(std::fabs(first), std::fabs(last)) + 2) * w_noise) +
           0x1p-98 * (std::fabs(f0.hi) + std::fabs(f1.hi));
  at_ = side.from;
  find();
}

void SideLines::find() {
  next_ = 2;
  if (!(left_ > 0)) return;
  const double k = step_ > 0 ? current_ + 1 : current_;
  const double l0 = base0_ + (first_ - k) * w0_, l1 = base1_ + (last_ - k) * w1_, slope = std::fabs(l0 - l1);
  // Rounding may put the line beyond an end or before its predecessor.
  next_ = slope > 0 ? std::clamp(l0 / (l0 - l1), at_, 1.0) : at_;
  const double depth = (1 - next_) * std::fabs(w0_) + next_ * std::fabs(w1_);
  // L0 and L1 have opposite signs: errors of 3u of each move t by 6u t (1 - t), and t itself is rounded.
  const double miss = kUnit * (next_ * (1 - next_) * 6 + 2.5 * next_) * slope + 3 * kUnit * depth + noise_;
  const double d = slope > 0 ? std::min(miss / slope, 1.0) : 1;
  jump_error_ += depth * d;
  kink_error_ += miss * d;
}

}  // namespace moire
