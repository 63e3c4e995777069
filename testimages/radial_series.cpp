#include "testimages/radial_series.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rounding.h"
#include "core/sum.h"
#include "testimages/side_interpolant.h"

namespace moire {
namespace {

using Row = LocalHomography::Row;

constexpr double kSlack = 1 + 0x1p-20;
// Rings of the innermost piece, each half as large as the one before.
constexpr int kMostRings = 24;
// Lines between squares that a polygon along the rim may cross, of some 100 ns each, and its sides.
constexpr double kMostLines = 1000000;
constexpr double kMostSides = 8000;
constexpr double kMostPieces = 100000;  // of a side
// A polygon along a knot's circle leaves the next piece of k by at most this share of its half length: the piece's
// polynomial and twice the bounds on its errors are good for that.
constexpr double kBeyondKnot = 0.001;

double sup(int j) { return kEuler.sup[static_cast<std::size_t>(j)]; }

}  // namespace

RadialSeries::RadialSeries(const Row& smooth, const Row& jump, const Row& w, const RadialWeight& weight,
                           const RadialPart& part)
    : frame_(smooth, jump, w),
      pieces_(weight.pieces),
      part_(w, weight.radius(), part),
      noise_{row_noise(smooth, weight.radius()), row_noise(jump, weight.radius()), row_noise(w, weight.radius())} {
  weights_.reserve(pieces_.size());
  for (const PieceWeight& piece : pieces_) weights_.emplace_back(frame_, piece, part.depth);
  make_rings(weight.rings());
}

void RadialSeries::make_rings(std::span<const RadialRing> rings) {
  const double away = part_.distance();
  const auto add = [&](std::size_t piece, double low, double high, const TermBounds& top) {
    rings_.push_back({piece, low, high, part_.largest_w(high) + noise_.w, part_.area(low, high), top});
  };
  double least = part_.radius();
  for (const RadialRing& ring : rings) {
    if (ring.high <= away) break;
    least = std::max(ring.low, away);
    add(ring.piece, least, ring.high, weights_[ring.piece].top(ring.along, ring.high));
  }
  if (least <= away) return;
  for (int left = kMostRings; left > 0; --left, least *= 0.5) {
    add(0, 0.5 * least, least, weights_[0].top(0.5 * least, least));
    core_ = 0.5 * least;
  }
}

// Of the integral of the terms from `first` on over a unit of length on a circle or near it, by absolute values.
double RadialSeries::by_length(const TermBounds& top, double r, int terms, int first) const {
  const double w = part_.largest_w(r) + noise_.w, ratio = w / part_.depth();
  double sum = 0;
  for (int j = first; j < terms; ++j) sum += sup(j + 1) * top[static_cast<std::size_t>(j)] * std::pow(ratio, j);
  return weights_.back().drift(r) * ratio * sum * kSlack;
}

// The same over all of the circle.
double RadialSeries::by_size(const TermBounds& top, double r, int terms, int first) const {
  return part_.length_of(r) * by_length(top, r, terms, first) * kSlack;
}

// What is left after so many terms, with the best core. Sides do not pass through it.
double RadialSeries::remainder_after(int terms) const {
  const auto left = [&](const Ring& ring, int m) {
    return sup(m) * ring.area * ring.top[static_cast<std::size_t>(m)] * std::pow(ring.depth / part_.depth(), m) *
           kSlack;
  };
  double outside = 0;
  if (core_ == 0) {
    for (const Ring& ring : rings_) outside += left(ring, terms);
    return outside;
  }
  double best = HUGE_VAL;
  for (const Ring& ring : rings_) {
    outside += left(ring, terms);
    if (ring.piece > 0 || ring.low > part_.path_distance()) continue;
    const double r = ring.low, w = part_.largest_w(r) + noise_.w;
    const double core = sup(1) * std::numbers::pi * r * r * weights_[0].top(r, r)[1] * (w / part_.depth()) * kSlack;
    best = std::min(best, outside + core + by_size(ring.top, r, terms, 1));
  }
  return best;
}

TermBounds RadialSeries::jump_at(std::size_t circle, double within) const {
  const RadialTerms* outer = circle + 1 < weights_.size() ? &weights_[circle + 1] : nullptr;
  return RadialTerms::jump(weights_[circle], outer, circle_radius(circle), within);
}

void RadialSeries::finish(Stretch s, double w) {
  s.terms.error = SideInterpolant::error(s.terms.error, s.terms.top, s.beside);
  double power = 1;
  const double ratio = (w + noise_.w) / part_.depth() * (1 + 0x1p-30);
  s.terms.sizes = {s.terms.top, s.terms.error, kNoPolynomial, count_, ratio};
  for (int j = 0; j < count_; ++j, power *= ratio) {
    s.terms.nearby += sup(j + 1) * s.beside[static_cast<std::size_t>(j)] * power;
  }
  stretches_.push_back(s);
}

std::size_t RadialSeries::add_stretch(std::size_t piece, double low, double high) {
  const RadialTerms& weight = weights_[piece];
  const double scale = weight.scale(low);
  finish({piece,
          false,
          scale,
          {weight.top(low, high), weight.error(low, high), part_.depth(), frame_.det, count_},
          weight.nearby(low, high, kBeside * scale),
          weight.nearby(low, high, scale)},
         part_.largest_w(high));
  return stretches_.size() - 1;
}

// Along a polygon inside a circle, no further from it than `within`.
std::size_t RadialSeries::add_stretch_at(std::size_t circle, double within) {
  const double high = circle_radius(circle), low = high - within;
  const RadialTerms& inner = weights_[circle];
  Stretch s{circle,
            false,
            inner.scale(low),
            {jump_at(circle, within), inner.error(low, high), part_.depth(), frame_.det, count_},
            {},
            {}};
  s.beside = inner.nearby(low, high, kBeside * s.scale);
  s.around = inner.nearby(low, high, s.scale);
  if (circle + 1 < weights_.size()) {
    const RadialTerms& outer = weights_[circle + 1];
    s.less_next = true;
    const TermBounds error = outer.error(low, high), beside = outer.nearby(low, high, kBeside * s.scale + within),
                     around = outer.nearby(low, high, s.scale + within);
    for (std::size_t j = 0; j < error.size(); ++j) {
      s.terms.error[j] += 2 * error[j];
      s.beside[j] += beside[j];
      s.around[j] += around[j];
    }
  }
  finish(s, part_.largest_w(high));
  return stretches_.size() - 1;
}

void RadialSeries::add_side(Vec2 a, Vec2 b, std::size_t stretch, double horizon) {
  if (a == b) return;
  const Stretch& s = stretches_[stretch];
  sides_.push_back({BoardSide(frame_.smooth, frame_.jump, frame_.w, a, b, noise_.s, noise_.j, noise_.w),
                    stretch,
                    std::hypot(b.x - a.x, b.y - a.y) / s.scale * kSlack,
                    {goal_, horizon, kMostPieces}});
  Side& side = sides_.back();
  moire::lay_out(side.side, kNoPolynomial, side.extent, s.terms, noise_, side.aim);
}

// A straight line, cut where it passes a knot or has doubled its distance from the origin.
void RadialSeries::add_line(Vec2 a, Vec2 b, double horizon) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0)) return;
  const Vec2 along{(b.x - a.x) / length, (b.y - a.y) / length};
  // Places are counted from the foot of the origin on the line.
  const double begin = a.x * along.x + a.y * along.y, end = begin + length;
  const double nearest = std::fabs(a.x * along.y - a.y * along.x);
  std::vector<double> cuts{begin, end};
  const auto cut_at = [&](double r) {
    const double square = (r - nearest) * (r + nearest);
    if (!(square >= 0)) return;
    const double place = std::sqrt(square);
    for (const double s : {place, -place}) {
      if (s > begin && s < end) cuts.push_back(s);
    }
  };
  for (double r = nearest; r < part_.radius(); r *= 2) cut_at(r);
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    const double r = circle_radius(i), touch = std::max(0x1p-40 * r, 8 * kUnit * part_.reach());
    cut_at(r);
    // Where a line just touches a knot's circle, rounding says how far it runs on which side.
    if (std::fabs(r - nearest) < touch) touched_ += 4 * std::sqrt(r * touch) * by_length(jump_at(i, 0), r, count_, 0);
  }
  std::sort(cuts.begin(), cuts.end());
  Vec2 from = a;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (!(cuts[i + 1] > cuts[i])) continue;
    const double share = (cuts[i + 1] - begin) / length;
    const Vec2 to = i + 2 == cuts.size() ? b : Vec2{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
    // No cut lies inside, so that r has its ends there.
    const double r0 = std::hypot(nearest, cuts[i]), r1 = std::hypot(nearest, cuts[i + 1]);
    const double low = std::min(r0, r1), high = std::max(r0, r1);
    std::size_t piece = pieces_.size() - 1;
    while (piece > 0 && pieces_[piece].low >= 0.5 * (low + high)) --piece;
    add_side(from, to, add_stretch(piece, low * (1 - 0x1p-40), high * (1 + 0x1p-40)), horizon);
    from = to;
  }
}

// Lines that cross both chords of an arc, about as many as cross the arc.
double RadialSeries::lines_across(double r, const DiskPart::Arc& arc) const {
  double lines = 0;
  for (const double sign : {1.0, -1.0}) {
    const BoardSide chord(frame_.smooth, frame_.jump, frame_.w, part_.on_circle(r, sign * arc.from),
                          part_.on_circle(r, sign * arc.to), noise_.s, noise_.j, noise_.w);
    lines += chord.lines_beyond(chord.w0.value());
  }
  return lines;
}

// Of an arc that ends on the horizon the angle of its last side: the smallest from `least` on, to a hundredth, so that
// no more lines cross the rest than may; `most`, if it takes more.
double RadialSeries::last_side(double r, const DiskPart::Arc& arc, double least, double most) const {
  const auto enough = [&](double last) { return lines_across(r, {arc.from, arc.to - last}) <= kMostLines; };
  double too_short = least, last = least;
  while (last < most && !enough(last)) {
    too_short = last;
    last = std::min(1.5 * last, most);
  }
  while (last > 1.01 * too_short) {
    const double between = std::sqrt(last * too_short);
    (enough(between) ? last : too_short) = between;
  }
  return last;
}

// A circle as a polygon inside it.
void RadialSeries::plan_circle(std::size_t circle, double goal) {
  const double r = circle_radius(circle);
  CirclePlan plan{circle, goal, 0, 0, {}};
  const std::vector<DiskPart::Arc> arcs = part_.arcs_of(r);
  double length = 0;
  for (const DiskPart::Arc& arc : arcs) length += arc.to - arc.from;
  // Two slivers of angle a: of r^2 a^3 / 12 at most each, and r a^2 / 8 high.
  double half = weights_[circle].half();
  if (circle + 1 < weights_.size()) half = std::min(half, weights_[circle + 1].half());
  plan.longest = std::min(0.125, std::sqrt(8 * kBeyondKnot * half / r));
  const double within = r * plan.longest * plan.longest / 8;
  const double jump = jump_at(circle, 0)[0], steepest = jump_at(circle, within)[0] - jump;
  const auto slivers = [&](double a) {
    const double share = a / plan.longest;
    return r * r * a * a * a / 6 * (jump + steepest * share * share) * kSlack;
  };
  const auto widest = [&](const auto& lost, double share) {
    double a = plan.longest;
    while (a > 1e-9 && lost(a) > share) a *= 0.8;
    return a;
  };
  plan.step = std::max(widest([&](double a) { return slivers(a) * length / a; }, 0.5 * goal),
                       std::min(plan.longest, 2 * length / kMostSides));
  for (const DiskPart::Arc& arc : arcs) {
    const auto add = [&](double from, double to) {
      const double steps = std::ceil((to - from) / plan.step);
      if (!(steps > 0)) return;
      bound_ += steps * slivers((to - from) / steps);
      plan.runs.push_back({{from, to}, steps});
    };
    double end = arc.to;
    if (part_.meets_horizon(r) && &arc == &arcs.back()) {
      // On the horizon the last side may be long, for a quarter of the goal: beyond it lines have no end.
      const double most = std::min(plan.longest, arc.to - arc.from);
      const double last = last_side(r, arc, std::min(widest(slivers, 0.25 * goal), most), most);
      end = arc.to - last;
      bound_ += slivers(last);
      plan.runs.push_back({{end, arc.to}, 1});
    }
    add(arc.from, end);
  }
  circles_.push_back(plan);
}

void RadialSeries::add_circle(const CirclePlan& plan) {
  const double r = circle_radius(plan.circle);
  const std::size_t stretch = add_stretch_at(plan.circle, r * (plan.longest * plan.longest / 8 + 0x1p-40));
  for (const auto& [arc, steps] : plan.runs) {
    const double each = (arc.to - arc.from) / steps, share = 0.1 * plan.goal / steps;
    for (double i = 0; i < steps; ++i) {
      const double from = arc.from + i * each, to = i + 1 == steps ? arc.to : arc.from + (i + 1) * each;
      add_side(part_.on_circle(r, from), part_.on_circle(r, to), stretch, share);
      add_side(part_.on_circle(r, -to), part_.on_circle(r, -from), stretch, share);
    }
  }
}

void RadialSeries::lay_out(double goal) {
  goal_ = 0.1 * goal;
  circles_.clear();
  bound_ = HUGE_VAL;
  if (!frame_.valid() || !(noise_.w < 0x1p-30 * part_.depth())) return;
  for (int m = 1; m <= kMaxTerms && bound_ > 0.3 * goal; ++m) {
    const double bound = remainder_after(m);
    if (!(bound < bound_)) continue;
    bound_ = bound;
    count_ = m;
  }
  if (!std::isfinite(bound_)) return;
  remainder_ = bound_;
  goal_ = std::max(goal_, 0.1 * bound_);
  // Besides the terms: what the pieces of k and the places of cuts may be off by.
  double fit = 0, most = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    fit = std::max(fit, pieces_[i].error);
    most = std::max(most, pieces_[i].top);
  }
  bound_ += fit * part_.area(0, part_.radius()) + 64 * kUnit * part_.radius() * part_.reach() * most;
  const double each = goal_ / static_cast<double>(pieces_.size());
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double lost = by_size(jump_at(i, 0), circle_radius(i), count_, 0);
    double lines = 0;
    if (lost > each && !part_.meets_horizon(circle_radius(i))) {
      for (const DiskPart::Arc& arc : part_.arcs_of(circle_radius(i))) lines += lines_across(circle_radius(i), arc);
    }
    if (lost <= each || lines > 3 * kMostLines) {
      bound_ += lost;
      remainder_ += lost;  // more squares take away of that, too
    } else {
      plan_circle(i, 4 * each);
    }
  }
}

Bounded RadialSeries::integrate() {
  if (!std::isfinite(bound_)) return {0, HUGE_VAL};
  stretches_.clear();
  sides_.clear();
  touched_ = 0;
  for (const CirclePlan& plan : circles_) add_circle(plan);
  const std::vector<Vec2> path = part_.path();
  for (std::size_t i = 1; i < path.size(); ++i) add_line(path[i - 1], path[i], 0.25 * goal_);
  Sum sum;
  double error = bound_ + touched_;
  for (const Side& side : sides_) {
    const Stretch& stretch = stretches_[side.stretch];
    const RadialTerms& terms = weights_[stretch.piece];
    const Vec2 a = side.side.a, b = side.side.b;
    SideInterpolant values(
        [&](double tau, int count, double* g) {
          const Vec2 p{a.x + tau * (b.x - a.x), a.y + tau * (b.y - a.y)};
          terms.at(p, count, g);
          if (!stretch.less_next) return;
          double next[kMaxTerms];
          weights_[stretch.piece + 1].at(p, count, next);
          for (int j = 0; j < count; ++j) g[j] -= next[j];
        },
        side.extent);
    const SideWeight weight{kNoPolynomial, side.extent,
                            [&](double tau, int count, double* g) { values.at(tau, count, g); },
                            [&](int j, double radius) {
                              if (radius > 1) return HUGE_VAL;
                              return (radius <= kBeside ? stretch.beside : stretch.around)[static_cast<std::size_t>(j)];
                            }};
    const Bounded part = moire::integrate(side.side, weight, stretch.terms, noise_, side.aim, sides_.size());
    sum.add(part.value);
    error += part.error;
  }
  return {sum.value(), (error + 2 * kUnit * std::fabs(sum.value())) * kSlack};
}

}  // namespace moire
