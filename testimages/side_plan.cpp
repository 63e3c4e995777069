#include "testimages/side_plan.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "core/sum.h"
#include "testimages/horizon_tail.h"

namespace moire {
namespace {

// What of the stretch towards the horizon its integral leaves in doubt, for the choice of that stretch.
constexpr double kTailShare = 1e-8;
// A side that fewer lines cross is integrated between them to its end: an integral towards the horizon takes as long as
// the first number of lines, its difference to another one, in front of the horizon, longer and to less avail. Where
// such a difference leaves more in doubt than is asked, five times as many lines are worth their time: some 0.1 us
// each.
constexpr double kFewLines = 1000, kFewLinesInFront = 20000, kMostLinesInFront = 5 * kFewLinesInFront;
// Of a side's largest W, from where on its noise puts its lines in doubt: on the horizon, or coordinates beyond 2^45.
constexpr double kWInDoubt = 0x1p-54;
// Into stretches of this length, in half lengths of the weight, the part that is left to integrals towards the horizon
// is cut where one polynomial would miss too much. Shorter ones are known better, but each takes up to some
// milliseconds.
constexpr double kStretch = 0.5;
// What the integrals over short stretches may lose, as a share of what they leave in doubt anyway.
constexpr double kShareOfDoubt = 0.25;
// What a side with more than kFewLines may come to, as a share of what may be lost to all, without being integrated.
constexpr double kNotWorth = 0.25;

// An estimate for a side: of the terms' values; of places of jumps, each by 8 units of rounding in tau; of
// S - (k + 1/2) W, which at the ends of the side is as large as its squares are many.
double rounding_on(const BoardSide& side, const SeriesTerms& terms) {
  const SeriesSizes& s = terms.sizes;
  const double w0 = std::max(side.w0.value(), 0.0), w1 = std::max(side.w1.value(), 0.0);
  if (!(w1 > 0)) return 0;
  const double per_w = 1 / std::max(w0, w1 / 8), along_s = std::fabs(side.along_s.value),
               along_j = std::fabs(side.along_j.value);
  return along_j / std::fabs(terms.det.value) *
         (w1 * s.rounding() + 16 * kUnit * s.size * along_j * per_w + 8 * kUnit * s.slope * along_s * per_w);
}

// Lines per unit of 1 / W.
double line_rate(const BoardSide& side) {
  return (std::fabs(side.along_s.value) + std::fabs(side.along_j.value)) / (side.w1.value() - side.w0.value());
}

// Leaves out W from side.w0, or 0, to `delta`, a W between side.w0 and side.w1.
void leave_out(BoardSide& side, double delta, const SeriesNoise& noise) {
  side.from = std::clamp((delta - side.w0.value()) / (side.w1.value() - side.w0.value()), 0.0, 1.0);
  side.left_out = side.from * (std::max(side.w0.value(), 0.0) + delta) / 2 * (1 + 0x1p-20) + noise.w;
}

// What of a side is left to integrals towards the horizon, 0 <= tau <= side.from, cut into equal stretches.
class Tail {
 public:
  Tail(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms, const SeriesNoise& noise,
       double count)
      : side_(side), weight_(weight), terms_(terms), noise_(noise), count_(count) {}

  // About what the integrals leave in doubt.
  double doubt() const {
    if (!(side_.left_out > 0)) return 0;
    double sum = 0;
    for (double i = 0; i < count_; ++i) sum += tail_doubt(stretch(i));
    return std::min(sum, terms_.sizes.size * side_.left_out);
  }
  Bounded integrate(double goal) const {
    if (count_ == 1) return horizon_tail(stretch(0), goal);
    const double each = std::max(goal, kShareOfDoubt * doubt()) / count_;
    Sum sum;
    double error = 0;
    for (double i = 0; i < count_; ++i) {
      const Bounded part = horizon_tail(stretch(i), each);
      sum.add(part.value);
      error += part.error;
    }
    return {sum.value(), error * (1 + 0x1p-40) + 2 * kUnit * std::fabs(sum.value())};
  }

 private:
  HorizonStretch stretch(double i) const {
    if (count_ == 1) return {side_, weight_, terms_, noise_, 0, side_.from, side_.left_out};
    const auto w_at = [&](double tau) {
      return std::max(side_.w0.value() + tau * (side_.w1.value() - side_.w0.value()), 0.0);
    };
    const double start = side_.from * (i / count_), end = side_.from * ((i + 1) / count_);
    const double integral_of_w = (end - start) * (w_at(start) + w_at(end)) / 2 * (1 + 0x1p-20) + noise_.w;
    return {side_, weight_, terms_, noise_, start, end, integral_of_w};
  }

  const BoardSide& side_;
  const SideWeight& weight_;
  const SeriesTerms& terms_;
  const SeriesNoise& noise_;
  double count_;
};

// Lines that a side is integrated between.
double lines_of(const BoardSide& side) {
  if (side.from >= 1) return 0;
  const double w0 = side.w0.value(), w1 = side.w1.value(), from = w0 + side.from * (w1 - w0);
  return w1 > 0 ? side.lines_beyond(std::max(from, 0x1p-40 * w1)) : 0;
}

// The ways to integrate a side that has been laid out.
class Plans {
 public:
  Plans(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms, const SeriesNoise& noise)
      : side_(side), weight_(weight), terms_(terms), noise_(noise), laid_out_(plan(side, 1)) {}

  const SidePlan& laid_out() const { return laid_out_; }

  // As laid out, if that leaves no more than `share` in doubt; else in short stretches from the first lines on, if that
  // does; else between all lines in front of the horizon, if they are not too many; else in short stretches from the
  // first lines on, if that is no worse than as laid out; else in short stretches as far as laid out, if that is
  // better.
  SidePlan within(double share) const {
    if (settled() || laid_out_.doubt <= share) return laid_out_;
    SidePlan few = few_lines();
    if (few.doubt <= share) return few;
    const double w0 = side_.w0.value();
    if (w0 > noise_.w && side_.lines_beyond(w0) <= kMostLinesInFront) return to_its_end();
    if (few.doubt <= laid_out_.doubt) return few;
    SidePlan cut = plan(side_, short_stretches(side_));
    return cut.doubt < laid_out_.doubt ? cut : laid_out_;
  }

  // As within(), but never between many lines.
  SidePlan quick(double share) const {
    if (settled() || (laid_out_.doubt <= share && lines_of(side_) <= kFewLinesInFront)) return laid_out_;
    return few_lines();
  }

 private:
  // There is nothing to choose: the weight is a polynomial in W for all lengths, W itself is in doubt, or constant.
  bool settled() const {
    const double rise = side_.w1.value() - side_.w0.value();
    return weight_.degree < static_cast<int>(kTailPowers) || noise_.w > kWInDoubt * side_.w1.value() ||
           !(rise > 4 * noise_.w);
  }
  double short_stretches(const BoardSide& side) const {
    return std::max(std::ceil(side.from * weight_.extent / kStretch), 1.0);
  }
  SidePlan few_lines() const {
    BoardSide few = side_;
    leave_out(few, 1 / (1 / side_.w1.value() + kFewLines / line_rate(side_)), noise_);
    return plan(few, short_stretches(few));
  }
  SidePlan to_its_end() const {
    BoardSide all = side_;
    all.from = all.left_out = 0;
    return plan(all, 1);
  }
  SidePlan plan(const BoardSide& side, double stretches) const {
    return {side, stretches, Tail(side, weight_, terms_, noise_, stretches).doubt()};
  }

  const BoardSide& side_;
  const SideWeight& weight_;
  const SeriesTerms& terms_;
  const SeriesNoise& noise_;
  const SidePlan laid_out_;
};

}  // namespace

SideEstimate lay_out(BoardSide& side, int degree, double extent, const SeriesTerms& terms, const SeriesNoise& noise,
                     const SeriesAim& aim) {
  SideEstimate out;
  const double w0 = std::max(side.w0.value(), 0.0), w1 = std::max(side.w1.value(), 0.0);
  const double weight = std::fabs(side.along_j.value / terms.det.value) * terms.sizes.size;
  // A side of many lines that comes to less, all in all, than what may be lost.
  const double mean = (w0 + w1) / 2 * (1 + 0x1p-20) + noise.w;
  if (weight * mean <= kNotWorth * aim.horizon && side.lines_beyond(w0) > kFewLines) {
    side.from = 1;
    side.left_out = mean;
    out.left_out += weight * mean;
    return out;
  }
  if (noise.w > kWInDoubt * w1) {
    side.from = 1;
    side.left_out = w1 + noise.w;
    out.left_out += weight * side.left_out;
  } else if (w0 <= 0x1p-40 * w1 || side.lines_beyond(w0) > std::min(kFewLinesInFront, aim.max_pieces)) {
    // Down to where the rest does as asked, a quarter of that for each of the sides that meet the horizon.
    const double rise = w1 - side.w0.value(), rate = line_rate(side);
    double delta = std::sqrt(0.5 * rise * aim.horizon / (weight * kTailShare));
    delta = std::min(delta, 1 / (1 / w1 + kFewLines / rate));
    if (degree >= static_cast<int>(kTailPowers)) {
      delta = std::min(delta, w0 + kTailLength / extent * rise);
    }
    delta = std::max({delta, 1 / (1 / w1 + aim.max_pieces / rate), w0 / largest_tail_start(degree)});
    delta = std::max(delta, 0x1p-40 * w1);
    if (delta < w1) {
      leave_out(side, delta, noise);
      out.left_out += kTailShare * weight * side.left_out;
    } else if (side.lines_beyond(w0) > aim.max_pieces) {
      // Too many lines at almost one depth.
      side.from = 1;
      side.left_out = w1 + noise.w;
      out.left_out += weight * side.left_out;
    }
  }
  out.lost = rounding_on(side, terms);
  return out;
}

void SeriesOutlook::add(const SeriesOutlook& other) {
  doubt += other.doubt;
  lines += other.lines;
  quick += other.quick;
  laid_out += other.laid_out;
}

SeriesOutlook outlook(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms,
                      const SeriesNoise& noise, const SeriesAim& aim) {
  const double factor = std::fabs(side.along_j.value / terms.det.value), share = aim.horizon / (4 * factor);
  const Plans plans(side, weight, terms, noise);
  const SidePlan plan = plans.within(share);
  return {factor * plan.doubt, lines_of(plan.side), factor * plans.quick(share).doubt, factor * plans.laid_out().doubt};
}

SidePlan plan_side(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms, const SeriesNoise& noise,
                   double share, bool quick) {
  const Plans plans(side, weight, terms, noise);
  return quick ? plans.quick(share) : plans.within(share);
}

Bounded integrate_rest(const SidePlan& plan, const SideWeight& weight, const SeriesTerms& terms,
                       const SeriesNoise& noise, double goal) {
  return Tail(plan.side, weight, terms, noise, plan.stretches).integrate(goal);
}

}  // namespace moire
