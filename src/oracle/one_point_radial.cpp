// Chords, row by row of squares, and the limit at the horizon; see one_point_radial.h.
#include "oracle/one_point_radial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "oracle/quadrature.h"

namespace moire::oracle {
namespace {

Quad floor(Quad a) {
  const Quad whole = static_cast<Quad>(static_cast<std::int64_t>(a));  // values are below 2^60
  return whole > a ? whole - 1 : whole;
}

// The same place of a wave of period 2.
long double reduced(Quad a) { return narrow(a - 2 * floor(a / 2)); }

// Around the pixel's centre, x along the horizon, y = horizon + d the distance towards the ground, in pixels.
struct View {
  long double horizon;                    // y
  long double u_phase, u_rate, u_centre;  // u = u_phase + u_rate (x - u_centre) / d, u_rate > 0
  long double v_phase, v_rate;            // v = v_phase + v_rate / d, v_rate > 0
  long double sign;                       // of s(v), for lines that were counted backwards
  long double skew;                       // what v changes along x, over what u does: rounding of the stored doubles
};

View view_of(const Board& board, Pixel pixel) {
  if (std::isfinite(board.extent[0])) throw std::invalid_argument("a board without end");
  const Quad cx = static_cast<Quad>(pixel.x) + Quad(1) / 2, cy = static_cast<Quad>(pixel.y) + Quad(1) / 2;
  struct Row {
    Quad along, down, constant;
  };
  std::array<Row, 3> rows{};
  const Quad gx = widen(board.homography[6]), gy = widen(board.homography[7]), w = sqrt(gx * gx + gy * gy);
  if (!(w > 0)) throw std::invalid_argument("a board with a horizon");
  for (std::size_t i = 0; i < 3; ++i) {
    const Quad px = widen(board.homography[3 * i]), py = widen(board.homography[3 * i + 1]);
    rows[i] = {(px * gy - py * gx) / w, (px * gx + py * gy) / w,
               widen(board.homography[3 * i + 2]) + px * cx + py * cy};
  }
  Row u = rows[0], v = rows[1];
  const Quad z = rows[2].constant;
  if (abs(u.along) < abs(v.along)) std::swap(u, v);
  const Quad skew = abs(v.along / u.along);
  if (!(skew < Quad(1) / 1000000000000)) throw std::invalid_argument("a board in one-point perspective");
  const Quad horizon = -z / w;
  View view{};
  view.horizon = narrow(horizon);
  // U at the horizon is u.along (x - centre), and there is nothing left of it but slope at greater depth.
  const Quad at_horizon = u.constant + u.down * horizon, centre = -at_horizon / u.along;
  // Mirrored where u falls along x: k does not care.
  const bool mirrored = u.along < 0;
  view.u_phase = reduced(u.down / w);
  view.u_rate = narrow(abs(u.along) / w);
  view.u_centre = narrow(mirrored ? -centre : centre);
  const Quad ahead = (v.constant + v.down * horizon) / w;
  // s(-v) = -s(v)
  view.sign = ahead < 0 ? -1 : 1;
  view.v_phase = reduced(ahead < 0 ? -(v.down / w) : v.down / w);
  view.v_rate = narrow(abs(ahead));
  view.skew = narrow(skew);
  return view;
}

struct Resolution {
  int nodes, few_nodes;  // per panel; the few where it is narrow and waves are short
  long double boole;     // chords by their ends from this times the kernel's least rate on
  long double most_rows;
};

// The integral of s(v) times chords over 0 < d, by its limits in octaves of depth.
class Limit {
 public:
  Limit(const ChordKernel& k, const View& view, const Resolution& resolution)
      : k_(k),
        view_(view),
        rule_(resolution.nodes),
        short_rule_(resolution.few_nodes),
        boole_(resolution.boole * k.least_rate()),
        most_rows_(resolution.most_rows) {}

  Value operator()() {
    top_ = k_.radius() - view_.horizon;
    if (top_ <= 0) return {};
    // No more than the kernel over the ground: for slivers of it that are finer than all rows that are looked at.
    const long double widest = 2 * std::sqrt(std::min(2 * k_.radius(), top_) * 2 * k_.radius());
    const Value unknown{0, top_ * widest * std::fabs(k_.rings()(0))};
    if (std::ldexp(view_.v_rate / top_, kLeastOctaves) > 2 * most_rows_) return unknown;
    // From one end of a circle to the next, d falling.
    std::vector<long double> ends{0};
    for (const long double r : k_.circles())
      for (const long double y : {-r, r}) ends.push_back(std::max(y - view_.horizon, 0.0L));
    std::sort(ends.begin(), ends.end(), std::greater<>());
    // Where the support ends before the horizon the sum is finite.
    const long double nearest = std::max(-k_.radius() - view_.horizon, 0.0L);
    for (std::size_t i = 0; i + 1 < ends.size() && !done_; ++i)
      if (ends[i + 1] >= nearest) stretch(ends[i + 1], ends[i]);
    if (done_) return best_.error < unknown.error ? best_ : unknown;
    long double sum = 0;
    for (const Octave& o : octaves_) sum += o.whole;
    return {sum, 0};
  }

 private:
  struct Octave {
    long double whole = 0, stepped = 0;  // its integral, plain and times the step that rises in it from 0 to 1
  };

  // Over lo < d < hi with square roots at both ends, which d = lo + (hi - lo) sin^2(t / 2) takes away.
  void stretch(long double lo, long double hi) {
    if (!(lo < hi)) return;
    stretch_lo_ = lo;
    stretch_size_ = hi - lo;
    std::vector<long double> cuts = places(lo, hi);
    long double top = hi;
    for (const long double cut : cuts) {
      rows(cut, top);
      if (done_) return;
      top = cut;
    }
    rows(lo, top);
  }

  // Between lo and hi, falling: where lines of u touch a circle, the tangents from their vanishing point; where Boole's
  // formula begins; and in ever smaller steps, y = 0, where a cusp's integrals are not smooth.
  std::vector<long double> places(long double lo, long double hi) const {
    std::vector<long double> all{view_.u_rate / boole_};
    const long double c = view_.u_centre, h = view_.horizon, square = c * c + h * h;
    for (const long double r : k_.circles()) {
      if (square <= r * r) continue;
      // x c + y h = r^2
      const long double root = std::fabs(c) * std::sqrt(square - r * r);
      for (const long double side : {-root, root}) all.push_back(r * (r * h + side) / square - h);
    }
    if (k_.has_cusp()) {
      all.push_back(-h);
      for (long double y = k_.radius() / 2; y > 1e-6L; y /= 4)
        for (const long double side : {-y, y}) all.push_back(side - h);
    }
    std::erase_if(all, [=](long double d) { return !(d > lo && d < hi); });
    std::sort(all.begin(), all.end(), std::greater<>());
    return all;
  }

  // Row by row of squares.
  void rows(long double lo, long double hi) {
    long double line = std::floor(view_.v_phase + view_.v_rate / hi), top = hi;
    while (top > lo && !done_) {
      const long double next = view_.v_rate / (line + 1 - view_.v_phase);
      const long double bottom = std::max(std::min(next, top), lo);
      row(bottom, top, line - 2 * std::floor(line / 2) < 0.5L ? view_.sign : -view_.sign);
      top = bottom;
      line += 1;
    }
  }

  // One row, or what it has in common with a stretch, cut where lines of u leave a circle. A row may be as deep as the
  // window: no panel ends more than twice as far from the horizon as it begins, or holds much of the kernel.
  void row(long double lo, long double hi, long double sign) {
    if (!(lo < hi)) return;
    cut_.assign({lo, hi});
    for (long double d = hi;;) {
      d = std::max(d / 2, d - widest(d));
      if (!(d > lo)) break;
      cut_.push_back(d);
    }
    for (const long double r : k_.circles()) {
      const long double y = view_.horizon + (lo + hi) / 2;
      if (std::fabs(y) >= r) continue;
      for (const long double side : {-1.0L, 1.0L}) leaving(r, side, lo, hi);
    }
    std::sort(cut_.begin(), cut_.end());
    for (std::size_t i = cut_.size() - 1; i-- > 0;) {
      if (cut_[i] < cut_[i + 1]) panel(cut_[i], cut_[i + 1], sign);
      if (done_) return;
    }
  }

  // Of a panel from d upwards. Lines of u sweep across a cusp, which is as wide as |y|, at the slope of their distance
  // from the vanishing point over d; next to the horizon and to y = 0 that is of no weight.
  long double widest(long double d) const {
    const long double radius = k_.radius();
    if (!k_.has_cusp() || d < 1e-3L * radius) return radius / 8;
    const long double away = std::max(std::fabs(view_.horizon + d), 1e-3L * radius);
    return std::min(radius / 8, away / 2 / (1 + std::fabs(view_.u_centre) / d));
  }

  long double u_at_end(long double r, long double side, long double d) const {
    const long double y = view_.horizon + d, x = side * std::sqrt(std::max(0.0L, (r - y) * (r + y)));
    return view_.u_phase + view_.u_rate * (x - view_.u_centre) / d;
  }

  // u is monotone along that side of the circle between lo and hi. On the line u = n, x - centre = slope d.
  void leaving(long double r, long double side, long double lo, long double hi) {
    const long double a = u_at_end(r, side, lo), b = u_at_end(r, side, hi);
    const long double c = view_.u_centre, h = view_.horizon, constant = c * c + h * h - r * r;
    for (long double n = std::floor(std::min(a, b)) + 1; n < std::max(a, b); n += 1) {
      const long double slope = (n - view_.u_phase) / view_.u_rate;
      const long double square = slope * slope + 1, linear = slope * c + h;
      const long double root = std::sqrt(std::max(0.0L, linear * linear - square * constant));
      const long double larger = linear < 0 ? root - linear : -root - linear;
      for (const long double d : {larger / square, constant / larger})
        if (d > lo && d < hi) cut_.push_back(d);
    }
  }

  // t of stretch().
  long double turn(long double d) const {
    const long double share = std::sqrt(std::clamp((d - stretch_lo_) / stretch_size_, 0.0L, 1.0L));
    return 2 * std::asin(share);
  }

  void panel(long double lo, long double hi, long double sign) {
    const long double from = turn(lo), to = turn(hi), mid = (from + to) / 2, half = (to - from) / 2;
    // There the integrand is the square wave's antiderivatives of degrees 1, 2, ..., each much less than the one
    // before.
    const bool few = view_.u_rate >= boole_ * hi && 64 * (hi - lo) < lo;
    const Rule& rule = few ? short_rule_ : rule_;
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      const long double t = mid + half * rule.x[i], s = std::sin(t / 2);
      const long double d = stretch_lo_ + stretch_size_ * s * s;
      const long double weight = half * rule.w[i] * stretch_size_ * s * std::sqrt((1 - s) * (1 + s));
      add(d, sign * weight * chord(d));
    }
    reached(lo);
  }

  long double chord(long double d) const {
    const long double y = view_.horizon + d, rate = view_.u_rate / d;
    if (std::fabs(y) >= k_.radius()) return 0;
    const ChordWave wave{view_.u_phase - rate * view_.u_centre, rate};
    return rate < boole_ ? k_.wave_by_wave(y, wave) : k_.by_ends(y, wave);
  }

  // 0 at share 0, 1 at share 1, with all derivatives.
  static long double step(long double share) {
    if (share <= 0) return 0;
    if (share >= 1) return 1;
    return 1 / (1 + std::exp(1 / share - 1 / (1 - share)));
  }

  // Octave number o is top / 2^(o+1) <= d < top / 2^o.
  void add(long double d, long double term) {
    const long double share = d / top_;
    const auto o = static_cast<std::size_t>(std::max(0, -1 - std::ilogb(share)));
    if (o >= octaves_.size()) octaves_.resize(o + 1);
    octaves_[o].whole += term;
    octaves_[o].stepped += term * step(std::ldexp(share, static_cast<int>(o) + 1) - 1);
  }

  // All that lies further than d from the horizon has been added: limits at the ends of whole octaves, extrapolated. Of
  // the columns of the extrapolation the steadiest is best: near a circle's end errors are no whole powers.
  void reached(long double d) {
    while (d <= std::ldexp(top_, -static_cast<int>(finished_) - 1) && finished_ < octaves_.size() && !done_) {
      std::array<long double, kPowers> now{};
      now[0] = above_ + octaves_[finished_].stepped;
      above_ += octaves_[finished_].whole;
      ++finished_;
      long double factor = 4;  // the error of the first column falls by D^2, of the next by D^3, ...
      for (std::size_t p = 1; p < kPowers; ++p, factor *= 2)
        now[p] = (factor * now[p - 1] - last_[p - 1]) / (factor - 1);
      best_ = {now[0], HUGE_VALL};
      for (std::size_t p = 0; p < kPowers; ++p) {
        const long double gap = std::fabs(now[p] - last_[p]);
        const long double error = finished_ >= p + kLeastOctaves ? gap + gap_[p] : HUGE_VALL;
        gap_[p] = gap;
        if (error < best_.error) best_ = {now[p], error};
      }
      last_ = now;
      const long double rows = view_.v_rate / d;
      done_ = rows > kLeastRows && (best_.error < kGoal || (2 * rows > most_rows_ && finished_ >= kLeastOctaves));
    }
  }

  static constexpr std::size_t kPowers = 5, kLeastOctaves = 3;  // the latter to tell an error from
  static constexpr long double kGoal = 1e-12L, kLeastRows = 200;

  const ChordKernel& k_;
  const View view_;
  const Rule rule_, short_rule_;
  const long double boole_, most_rows_;
  long double stretch_lo_ = 0, stretch_size_ = 0;
  std::vector<long double> cut_;  // of the row at hand

  long double top_ = 0, above_ = 0;
  std::vector<Octave> octaves_;
  std::size_t finished_ = 0;
  std::array<long double, kPowers> last_{}, gap_{};
  Value best_;
  bool done_ = false;
};

}  // namespace

Value one_point(const ChordKernel& k, const Board& board, Pixel pixel) {
  const View view = view_of(board, pixel);
  const Value fine = Limit(k, view, {.nodes = 18, .few_nodes = 6, .boole = 1.25L, .most_rows = 6e5L})();
  const Value coarse = Limit(k, view, {.nodes = 14, .few_nodes = 5, .boole = 1, .most_rows = 3e5L})();
  // The ground, whose edge is a double here, of some pixels at most where it matters: two ulps of 1 times the longest
  // chord.
  const double edge = 0.5 + static_cast<double>(view.horizon);
  Value v = filtered(k.rings(), Edge{{0, edge}, {0, 1}}, Pixel{0, 0});
  const long double radius = k.radius(), largest = std::fabs(k.rings()(0));
  v.error += 0x1p-51L * 2 * radius * largest;
  v.value = (v.value + fine.value) / 2;
  v.error += std::fabs(fine.value - coarse.value) + fine.error + 1e-15L * k.rings().gain();
  // Lines of v that are not quite level are off by skew times what u changes from x = 0, at most 1 row: over all depths
  // the integral of min(1, skew radius u_rate / d) is that times a logarithm, below 50.
  v.error += 2 * largest * 2 * radius * view.skew * radius * view.u_rate * 50;
  return v;
}

}  // namespace moire::oracle
