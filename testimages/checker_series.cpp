// Error bounds are those of the sides (series_side.h) and the remainder R.
#include "testimages/checker_series.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "core/sum.h"

namespace moire {
namespace {

using Row = LocalHomography::Row;

WeightTerms terms_of(const BoardFrame& frame, const PieceWeight& x, const PieceWeight& y, double deepest) {
  const BoardFrame::Drift d = frame.drift({0.5 * (x.low + x.high), 0.5 * (y.low + y.high)}, deepest);
  return {x, y, d.x, d.y, frame.e_times(deepest)};
}

}  // namespace

CheckerSeries::CheckerSeries(const Row& smooth, const Row& jump, const Row& w, const PieceWeight& x,
                             const PieceWeight& y, double deepest)
    : frame_(smooth, jump, w),
      weight_(terms_of(frame_, x, y, deepest)),
      terms_{weight_.tops(), weight_.errors(), deepest, frame_.det} {}

// Of J after that many terms, for W up to `ratio` times the deepest.
double CheckerSeries::remainder(int terms, double area, double ratio) const {
  return kEuler.sup[static_cast<std::size_t>(terms)] * area * weight_.top(terms) * std::pow(ratio, terms) *
         (1 + 0x1p-40);
}

double CheckerSeries::reach(const Polygon& polygon, double area, double goal) const {
  if (!frame_.valid()) return 0;
  double along = 0;  // sum of |C / det|
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    along += std::fabs(row_at(frame_.jump, q).hi * row_at(frame_.w, p).hi -
                       row_at(frame_.jump, p).hi * row_at(frame_.w, q).hi);
  }
  along /= std::fabs(frame_.det.value);
  // Twice that of values: what places of lines add is alike where squares are, but stays when W becomes smaller.
  const auto rounded = [&](int m, double ratio) {
    return 2 * along * terms_.deepest * ratio *
           SeriesSizes(weight_.tops(), weight_.errors(), weight_.degree(), m, ratio).rounding();
  };
  double best = 0;
  for (int m = 1; m <= kMaxTerms && best < 1; ++m) {
    const double whole = remainder(m, area, 1);
    if (!std::isfinite(whole)) break;
    // Also where the remainder is 0.
    double ratio = whole <= goal ? 1 : std::pow(goal / whole, 1.0 / m);
    if (!(ratio > best)) continue;
    // Rounding grows at least as W does.
    double high = ratio;
    const double lost = rounded(m, ratio);
    if (lost > goal) ratio *= goal / lost;
    for (int step = 0; step < 6 && ratio < 0.9 * high; ++step) {
      const double mid = std::sqrt(ratio * high);
      (rounded(m, mid) <= goal ? ratio : high) = mid;
    }
    best = std::max(best, ratio);
  }
  return best * terms_.deepest;
}

void CheckerSeries::choose_terms(double area, double ratio, double goal) {
  remainder_ = HUGE_VAL;
  terms_.count = 1;
  for (int m = 1; m <= kMaxTerms && remainder_ > goal; ++m) {
    const double r = remainder(m, area, ratio);
    if (!(r < remainder_)) continue;
    remainder_ = r;
    terms_.count = m;
  }
  terms_.sizes = {weight_.tops(), weight_.errors(), weight_.degree(), terms_.count, ratio};
  terms_.nearby = 0;
  for (int j = 0; j < terms_.count; ++j) {
    terms_.nearby += kEuler.sup[static_cast<std::size_t>(j + 1)] * weight_.top_nearby(j, kBeside) * std::pow(ratio, j);
  }
}

void CheckerSeries::lay_out(const Polygon& polygon, double area, const SeriesAim& aim) {
  aim_ = aim;
  double reach = 0;
  for (const Vec2 p : polygon) reach = std::max({reach, std::fabs(p.x), std::fabs(p.y)});
  noise_.s = row_noise(frame_.smooth, reach);
  noise_.j = row_noise(frame_.jump, reach);
  noise_.w = row_noise(frame_.w, reach);
  sides_.clear();
  depth_ = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    sides_.emplace_back(frame_.smooth, frame_.jump, frame_.w, a, b, noise_.s, noise_.j, noise_.w);
    depth_ = std::max(depth_, sides_.back().w1.value() + noise_.w);
  }
  choose_terms(area, depth_ / terms_.deepest * (1 + 4 * kUnit), aim.remainder);
  // Nothing else need be much better than the remainder.
  aim_.remainder = std::max(aim.remainder, remainder_ / 4);
  aim_.horizon = std::max(aim.horizon, remainder_ / 4);

  double left_out = 0, lost = 0;
  for (BoardSide& side : sides_) {
    const auto [degree, extent] = weight_.extent(side.a, side.b);
    const SideEstimate estimate = moire::lay_out(side, degree, extent, terms_, noise_, aim_);
    left_out += estimate.left_out;
    lost += estimate.lost;
  }
  estimate_ = remainder_ + left_out + lost;
}

template <class Visit>
void CheckerSeries::for_sides(const Visit& visit) const {
  for (const BoardSide& side : sides_) {
    const WeightTerms::Along along(weight_, side.a, side.b, terms_.count);
    visit(side, SideWeight{along.degree(), along.extent(),
                           [&along](double tau, int count, double* g) { along.at(tau, count, g); },
                           [this](int j, double radius) { return weight_.top_nearby(j, radius); }});
  }
}

SeriesOutlook CheckerSeries::outlook() const {
  SeriesOutlook sum{remainder_, 0, remainder_, remainder_};
  for_sides([&](const BoardSide& side, const SideWeight& weight) {
    sum.add(moire::outlook(side, weight, terms_, noise_, aim_));
  });
  return sum;
}

Bounded CheckerSeries::integrate() const {
  if (!frame_.valid()) return {0, HUGE_VAL};
  Sum sum;
  double error = remainder_;
  for_sides([&](const BoardSide& side, const SideWeight& weight) {
    const Bounded part = moire::integrate(side, weight, terms_, noise_, aim_, sides_.size());
    sum.add(part.value);
    error += part.error;
  });
  return {sum.value(), error + 2 * kUnit * std::fabs(sum.value())};
}

}  // namespace moire
