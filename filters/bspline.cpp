// Uniform B-splines: the unit box convolved with itself `order` times, order being the polynomial degree.
//
// Unser, "Splines: a perfect fit for signal and image processing", IEEE Signal Processing Magazine 16(6), 1999. Order 0
// is the box, 1 the tent, 3 the cubic of the BC family with b = 1, c = 0. A partition of unity at every order.
#include "core/dd_math.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {integer("order", 3, 0, 5, "polynomial degree; the radius is (order + 1) / 2 pixels")};

struct BSpline {
  int order;
  explicit BSpline(const Args& a) : order(static_cast<int>(a.integer("order"))) {}

  double radius() const { return 0.5 * (order + 1); }
  std::vector<double> knots() const {
    std::vector<double> k;
    for (int i = 0; i <= order + 1; ++i) k.push_back(i - radius());
    return k;
  }
  int degree() const { return order; }

  // By truncated powers, from the nearer end: (1 / n!) sum over j of (-1)^j C(n + 1, j) (s - j)^n for the j <= s, s
  // counted from that end. At most half of the terms are there, and double-double has bits to spare.
  Dd shape(int piece, Dd x) const {
    const int from_end = piece <= order / 2 ? piece : order - piece;
    const Dd s = Dd(radius()) - dd_abs(x);
    Dd sum = 0.0, binomial = 1.0, factorial = 1.0;
    for (int i = 2; i <= order; ++i) factorial = factorial * Dd(i);
    for (int j = 0; j <= from_end; ++j) {
      Dd power = j % 2 == 0 ? binomial : -binomial;
      for (int i = 0; i < order; ++i) power = power * (s - Dd(j));
      sum = sum + power;
      binomial = binomial * Dd(order + 1 - j) / Dd(j + 1);
    }
    return sum / factorial;
  }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo bspline_filter;
constinit const FilterInfo bspline_filter =
    describe<BSpline>({.name = "bspline",
                       .title = "B-spline",
                       .cite = "Unser, \"Splines: a perfect fit for signal and image processing\", 1999",
                       .params = kParams});

}  // namespace moire
