// The series of checker_series.h for a radial weight k(r): J over a part of its support (radial_part.h).
//
// The part is cut into rings, between the knots of k and further in at smaller and smaller radii: a bound on the
// remainder in each, the smaller the nearer the horizon the ring is. The same terms everywhere, so that rings of one
// piece of k have no boundary between them but that of a core around the origin, where the part holds it, in which
// there is one term. Boundaries are:
//  - the chord W = constant and the notch, sides like any others;
//  - circles at knots, the last of which is the rim: where what jumps there comes to little, by absolute values, |C /
//    det| being |G - e p| at most on each unit of length; otherwise as a polygon inside the circle, so near to it that
//    the area between the two is bound enough;
//  - the circle around the core, by absolute values.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "curve/piece_weight.h"
#include "testimages/board_frame.h"
#include "testimages/board_side.h"
#include "testimages/homography.h"
#include "testimages/radial_part.h"
#include "testimages/radial_rings.h"
#include "testimages/radial_terms.h"
#include "testimages/series_side.h"

namespace moire {

class RadialSeries {
 public:
  // By parts along the first row's family. The weight is to stay.
  RadialSeries(const LocalHomography::Row& smooth, const LocalHomography::Row& jump, const LocalHomography::Row& w,
               const RadialWeight& weight, const RadialPart& part);

  // Chooses terms and polygons for a bound on J of about `goal`, if that can be had.
  void lay_out(double goal);
  // What the bound will be, but for rounding and what sides lose.
  double estimate() const { return bound_; }
  // What of that squares can take away, being the remainder of the series.
  double remainder() const { return remainder_; }
  // J and its bound.
  Bounded integrate();

 private:
  // low <= r <= high of one piece, inside the part; W up to `depth`.
  struct Ring {
    std::size_t piece;
    double low, high, depth, area;
    TermBounds top;
  };
  // Where sides run: the weight there, of one piece or of one less another, and what holds of its terms.
  struct Stretch {
    std::size_t piece;
    bool less_next;
    double scale;
    SeriesTerms terms;
    TermBounds beside, around;  // at complex points within kBeside scales, and within one
  };
  struct Side {
    BoardSide side;
    std::size_t stretch;
    double extent;
    SeriesAim aim;
  };

  // A polygon along a circle: so many steps on each arc, none longer than `longest`.
  struct CirclePlan {
    std::size_t circle;
    double goal, step, longest;
    std::vector<std::pair<DiskPart::Arc, double>> runs;
  };

  void make_rings(std::span<const RadialRing> rings);
  double remainder_after(int terms) const;
  double by_length(const TermBounds& top, double r, int terms, int first) const;
  double by_size(const TermBounds& top, double r, int terms, int first) const;
  std::size_t add_stretch(std::size_t piece, double low, double high);
  std::size_t add_stretch_at(std::size_t circle, double within);
  void finish(Stretch stretch, double w);
  void add_side(Vec2 a, Vec2 b, std::size_t stretch, double horizon);
  void add_line(Vec2 a, Vec2 b, double horizon);
  double lines_across(double r, const DiskPart::Arc& arc) const;
  double last_side(double r, const DiskPart::Arc& arc, double least, double most) const;
  void plan_circle(std::size_t circle, double goal);
  void add_circle(const CirclePlan& plan);
  double circle_radius(std::size_t circle) const { return pieces_[circle].high; }
  TermBounds jump_at(std::size_t circle, double within) const;

  BoardFrame frame_;
  std::span<const PieceWeight> pieces_;
  DiskPart part_;
  SeriesNoise noise_;
  std::vector<RadialTerms> weights_;  // of each piece
  std::vector<Ring> rings_;           // from the outside in
  double core_ = 0;                   // radius of what lies inside all rings; 0: they leave nothing out
  int count_ = 1;
  double goal_ = 0, remainder_ = 0, bound_ = 0;  // bound_: on all but the sides
  std::vector<CirclePlan> circles_;
  std::vector<Stretch> stretches_;
  std::vector<Side> sides_;
  double touched_ = 0;  // what circles that sides just touch may come to
};

}  // namespace moire
