// Lagrange filters: what central local interpolation by polynomials of degree `order` weighs a sample with.
//
// Schafer and Rabiner, "A digital signal processing approach to interpolation", Proc. IEEE 61(6), 1973. Order 1 is the
// tent, order 3 what ImageMagick calls Lagrange. Even orders take the nearest sample as their middle one and jump where
// it changes, half a pixel from the samples.
#include "core/dd_math.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {integer("order", 3, 1, 9, "polynomial degree; the radius is (order + 1) / 2 pixels")};

struct Lagrange {
  int order;
  explicit Lagrange(const Args& a) : order(static_cast<int>(a.integer("order"))) {}

  std::vector<double> knots() const {
    std::vector<double> k;
    for (int i = 0; i <= order + 1; ++i) k.push_back(i - 0.5 * (order + 1));
    return k;
  }
  int degree() const { return order; }

  // On this piece the samples that take part lie at piece - order .. piece, seen from the one that is weighed, at 0:
  // its basis polynomial is 1 there and 0 at the others.
  Dd shape(int piece, Dd x) const {
    Dd product = 1.0;
    for (int node = piece - order; node <= piece; ++node) {
      if (node != 0) product = product * (Dd(node) - x) / Dd(node);
    }
    return product;
  }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo lagrange_filter;
constinit const FilterInfo lagrange_filter =
    describe<Lagrange>({.name = "lagrange",
                        .title = "Lagrange interpolation",
                        .cite = "Schafer and Rabiner, \"A digital signal processing approach to interpolation\", 1973",
                        .params = kParams});

}  // namespace moire
