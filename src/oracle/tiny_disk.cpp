// Sections of a disk in units of its radius; see tiny_disk.h.
#include "oracle/tiny_disk.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace moire::oracle {
namespace {

// A kernel's knots in one axis as the disk sees them: from its centre, in radii.
class Axis {
 public:
  Axis(const Kernel& k, Quad center, Quad radius) : k_(k), center_(narrow(center)), radius_(narrow(radius)) {
    for (const long double knot : k.knots()) at_.push_back((widen(knot) - center) / radius);
  }

  const std::vector<Quad>& knots() const { return at_; }

  // The number of the piece that holds a point which is none of the knots; -1 outside of the support.
  int piece_of(long double s) const {
    const auto after = std::upper_bound(at_.begin(), at_.end(), widen(s)) - at_.begin();
    return after == static_cast<std::ptrdiff_t>(at_.size()) ? -1 : static_cast<int>(after) - 1;
  }

  // k of that piece at s; kept inside of it, which rounding may leave.
  long double k(int piece, long double s) const {
    const auto i = static_cast<std::size_t>(piece);
    const long double lo = k_.knots()[i], hi = std::nextafter(k_.knots()[i + 1], lo);
    return k_(std::clamp(center_ + radius_ * s, lo, hi));
  }

 private:
  const Kernel& k_;
  long double center_, radius_;
  std::vector<Quad> at_;
};

}  // namespace

Value filtered_per_square(const Kernel& k, const Disk& disk, Pixel pixel) {
  const Circle c = around(disk, pixel);
  const Axis across(k, c.center.x, c.radius), down(k, c.center.y, c.radius);
  constexpr long double kHalfTurn = std::numbers::pi_v<long double> / 2;
  // Angles where a section changes its formula: at a knot of y, and where its ends pass a knot of x.
  std::vector<long double> turns{-kHalfTurn, kHalfTurn};
  const auto root = [](Quad s) { return std::sqrt(narrow((1 - s) * (1 + s))); };
  for (const Quad s : down.knots())
    if (abs(s) < 1) turns.push_back(std::atan2(narrow(s), root(s)));
  for (const Quad s : across.knots()) {
    if (!(abs(s) < 1)) continue;
    const long double angle = std::atan2(root(s), narrow(abs(s)));
    turns.push_back(angle);
    turns.push_back(-angle);
  }
  std::sort(turns.begin(), turns.end());

  const Rule along(16);
  long double wide = 0, high = 0;  // the largest factors met
  const auto section = [&](long double angle) {
    const long double height = std::sin(angle), reach = std::cos(angle);
    const int row = down.piece_of(height);
    if (row < 0) return 0.0L;
    std::vector<long double> cut{-reach};
    for (const Quad s : across.knots())
      if (abs(s) < widen(reach)) cut.push_back(narrow(s));
    cut.push_back(reach);
    long double sum = 0;
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
      const long double mid = (cut[i] + cut[i + 1]) / 2, half = (cut[i + 1] - cut[i]) / 2;
      const int column = across.piece_of(mid);
      if (column < 0) continue;
      for (std::size_t n = 0; n < along.x.size(); ++n) {
        const long double at = across.k(column, mid + half * along.x[n]);
        wide = std::max(wide, std::fabs(at));
        sum += half * along.w[n] * at;
      }
    }
    const long double at = down.k(row, height);
    if (sum != 0) high = std::max(high, std::fabs(at));
    return sum * at * reach;
  };
  const RulePair rules{Rule(16), Rule(24)};
  Value v;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i)
    if (turns[i] < turns[i + 1]) v += integrate(rules, section, turns[i], turns[i + 1]);
  // Rounding of the kernel's values and places, 8 long double ulps of the largest value, times the other factor and pi.
  v.error += 0x1p-58L * k.gain() * k(0) * (wide + high);
  return v;
}

}  // namespace moire::oracle
