// Where swept curves are cut. u = 2^-53, W = SweptGrid::reach(), R a circle's radius; e is the motion's unit vector.
#include "engine/swept_track.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"

namespace moire {
namespace {

// Sorts what is between the ends and puts these around it.
void close(double from, double to, std::vector<double>& cuts) {
  cuts.push_back(from);
  cuts.push_back(to);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
}

}  // namespace

Rect SweptGrid::window() const {
  const double r = kernel.radius();
  return {{-r - std::max(motion.x, 0.0), -r - std::max(motion.y, 0.0)},
          {r - std::min(motion.x, 0.0), r - std::min(motion.y, 0.0)}};
}

double SweptGrid::travel() const { return std::max(std::fabs(motion.x), std::fabs(motion.y)); }

double SweptGrid::reach() const { return kernel.radius() + travel(); }

// Places in the window come from Arc::passes(), right to 24 u W and 2^-98 R, and 2 u W for a knot moved back. Corners:
//  - near, R <= 4 W: their offset across the path from the centre, from differences below 6.5 W, errs by 50 u W. The
//    point with that offset is off the circle by 8 u R and its parameter is rounded: 24 u R.
//  - far: lambda, from the corner along the path, solves lambda^2 + 2 b lambda + c = 0. b = e . (corner - centre) errs
//    by 28 u R, c (the corner's excess) by 20 u R W, and the roots are those of coefficients 4 u off: with lambda <=
//    3 W that leaves an excess of at most 200 u R W, which is 100 u W across the circle, 141 u W along the other
//    coordinate, and 10 u W for the point.
double ArcTrack::miss(const SweptGrid& grid, const Arc& arc) {
  const double W = grid.reach(), R = arc.circle.radius;
  if (grid.motion.x == 0 || grid.motion.y == 0) return 26 * kUnit * W + 0x1p-97 * R;
  return (arc.near ? 64 * kUnit * W + 24 * kUnit * R : 160 * kUnit * W) + 0x1p-96 * R;
}

void ArcTrack::cut(const SweptGrid& grid, std::vector<double>& cuts) const {
  cuts.clear();
  const Rect window = grid.window();
  const bool upright = arc_.upright;
  const double from = std::max(arc_.v0, arc_.v_of(upright ? window.lo.y : window.lo.x));
  const double to = upright ? std::min(arc_.v1, arc_.v_of(window.hi.y)) : arc_.v1;
  if (!(from < to)) return;
  // Right of the window nothing may be cut: there a piece counts by its ends alone, and far out on a large circle these
  // are not known well enough.
  const double last = upright ? to : std::min(to, arc_.v_of(window.hi.x));
  const auto knots = grid.kernel.knots();
  for (const double at_time : {0.0, 1.0}) {
    for (const double knot : knots) {
      const double x = knot - at_time * grid.motion.x, y = knot - at_time * grid.motion.y;
      cuts.push_back(arc_.v_of(upright ? y : x));
      const auto passes = arc_.passes(upright ? x : y);  // the first of them along the quarter, which is not asked
      cuts.push_back(passes[1]);
      cuts.push_back(passes[2]);
    }
  }
  if (grid.motion.x != 0 && grid.motion.y != 0) {
    for (const double x : knots) {
      for (const double y : knots) cut_corner(grid, {x, y}, cuts);
    }
  }
  std::erase_if(cuts, [&](double v) { return !(v > from && v <= last && v < to); });
  close(from, to, cuts);
}

void ArcTrack::cut_corner(const SweptGrid& grid, Vec2 corner, std::vector<double>& cuts) const {
  const Circle& circle = arc_.circle;
  const double length = std::hypot(grid.motion.x, grid.motion.y), R = circle.radius, W = grid.reach();
  const Vec2 e{grid.motion.x / length, grid.motion.y / length};
  const Vec2 from_centre{(corner.x - circle.center.x) - circle.center_rest.x,
                         (corner.y - circle.center.y) - circle.center_rest.y};
  const double along = e.x * from_centre.x + e.y * from_centre.y;
  // How far along the path a place may be off where it touches the circle; a cut too many does no harm.
  const double slack = 1e-5 * W + std::sqrt(0x1p-43 * R * W);
  const auto cut = [&](double lambda, Vec2 relative, double v) {
    const bool on_the_way = lambda <= slack && lambda >= -length - slack;
    if (on_the_way && (arc_.upright ? relative.x : relative.y) * arc_.side >= 0) cuts.push_back(v);
  };
  if (arc_.near) {
    const double across = e.x * from_centre.y - e.y * from_centre.x;
    if (std::fabs(across) > R) return;
    const double half_chord = std::sqrt((R - across) * (R + across));
    for (const double h : {half_chord, -half_chord}) {
      const Vec2 relative{h * e.x - across * e.y, h * e.y + across * e.x};
      cut(h - along, relative, arc_.upright ? relative.y : relative.x);
    }
    return;
  }
  const double excess =
      corner.x * (corner.x - 2 * circle.center.x) + corner.y * (corner.y - 2 * circle.center.y) - circle.power;
  const double discriminant = along * along - excess;
  if (discriminant < 0) return;
  const double far = -(along + std::copysign(std::sqrt(discriminant), along));
  for (const double lambda : {far, far == 0 ? 0 : excess / far}) {
    const Vec2 p{corner.x + lambda * e.x, corner.y + lambda * e.y};
    cut(lambda, {p.x - circle.center.x, p.y - circle.center.y}, arc_.upright ? p.y : p.x);
  }
}

// arc.h: u |coordinate| and 8 u |tau|, and 2 u half for the node itself. On the path, one sum, and 9 u of the motion
// for times (a cut to 2 u, nodes between cuts to 4 u more), their products and the motion itself.
double ArcTrack::off(const SweptGrid& grid, double half) const {
  return kUnit * (2.1 * grid.reach() + 9 * grid.travel() + 11 * half) + 0x1p-98 * arc_.circle.radius;
}

ArcTrack::Piece::Piece(const ArcTrack& track, double from, double to)
    : arc_(track.arc_), half_(0.5 * (to - from)), middle_(track.arc_, 0.5 * (from + to)) {}

TrackPoint ArcTrack::Piece::at(double tau) const {
  const ArcMiddle::Point p = middle_.at(tau);
  if (arc_.upright) return {{p.other, p.run}, 1};
  return {{p.run, p.other}, -p.relative / p.offset};
}

std::optional<TrackDisk> ArcTrack::Piece::disk(double reach) const {
  // |v - centre| <= e R there, so that |d other / d v| <= e / sqrt(1 - e^2).
  const double e = (std::fabs(middle_.relative) + reach) / arc_.circle.radius;
  if (e > 0.96) return std::nullopt;
  const double slope = e / std::sqrt((1 - e) * (1 + e));
  if (arc_.upright) return TrackDisk{{reach * slope, reach}, 1};
  return TrackDisk{{reach, reach * slope}, slope};
}

Rect ArcTrack::Piece::extent() const {
  Rect box{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  const auto hold = [&](double run, double other) {
    const Vec2 p = arc_.upright ? Vec2{other, run} : Vec2{run, other};
    box = {{std::min(box.lo.x, p.x), std::min(box.lo.y, p.y)}, {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y)}};
  };
  for (const double tau : {-half_, half_}) hold(middle_.at(tau).run, middle_.at(tau).other);
  if (std::fabs(middle_.relative) < half_) {  // the extreme point is on it
    const ArcMiddle::Point p = middle_.at(-middle_.relative);
    hold(p.run, p.other);
  }
  return box;
}

// A parameter is a quotient of two differences, right to 3 u of itself and what a knot moved back errs by: 3 u of a way
// of at most 2 W, and 2 u W. A corner's are products that err by 5 u of 4 W each.
double SegmentTrack::miss(const SweptGrid& grid, const Segment& segment) {
  const bool corners = grid.motion.x != 0 && grid.motion.y != 0;
  return (corners ? 64 : 8) * kUnit * grid.reach() + 2 * segment.doubt;
}

void SegmentTrack::cut(const SweptGrid& grid, std::vector<double>& cuts) const {
  cuts.clear();
  const Vec2 a = segment_.a, along{segment_.b.x - a.x, segment_.b.y - a.y}, d = grid.motion;
  const auto knots = grid.kernel.knots();
  for (const double at_time : {0.0, 1.0}) {
    for (const double knot : knots) {
      cuts.push_back((knot - at_time * d.x - a.x) / along.x);
      cuts.push_back((knot - at_time * d.y - a.y) / along.y);
    }
  }
  if (d.x != 0 && d.y != 0) {
    const double size = std::max(std::fabs(d.x), std::fabs(d.y));
    const Vec2 e{d.x / size, d.y / size};
    const double across = along.x * e.y - along.y * e.x;
    for (const double x : knots) {
      for (const double y : knots) cuts.push_back(((x - a.x) * e.y - (y - a.y) * e.x) / across);
    }
  }
  std::erase_if(cuts, [](double v) { return !(v > 0 && v < 1); });
  close(0, 1, cuts);
}

// The ends' doubt; three roundings of at most W, one of them of a difference of twice as much but at most half of that
// is walked; a node to 2 u of the way; and the path as for arcs.
double SegmentTrack::off(const SweptGrid& grid, double) const {
  return kUnit * (6 * grid.reach() + 9 * grid.travel()) + segment_.doubt;
}

Vec2 SegmentTrack::place(double v) const {
  const Vec2 &a = segment_.a, &b = segment_.b;
  if (v <= 0.5) return {a.x + v * (b.x - a.x), a.y + v * (b.y - a.y)};
  return {b.x - (1 - v) * (b.x - a.x), b.y - (1 - v) * (b.y - a.y)};
}

TrackPoint SegmentTrack::Piece::at(double tau) const {
  const Segment& s = track_.segment_;
  return {track_.place(middle_ + tau), s.b.y - s.a.y};
}

std::optional<TrackDisk> SegmentTrack::Piece::disk(double reach) const {
  const Segment& s = track_.segment_;
  const double dx = std::fabs(s.b.x - s.a.x), dy = std::fabs(s.b.y - s.a.y);
  return TrackDisk{{reach * dx, reach * dy}, dy};
}

Rect SegmentTrack::Piece::extent() const {
  const Vec2 a = track_.place(middle_ - half_), b = track_.place(middle_ + half_);
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

}  // namespace moire
