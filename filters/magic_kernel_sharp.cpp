// Magic Kernel Sharp: the quadratic B-spline after a sharpening by a few whole-pixel weights, which sum to 1.
//
// Costella, "Solving the mystery of Magic Kernel Sharp", 2021. The version of 2013 has k(0) = 17/16 and k(2) = -1/32,
// that of 2021 almost interpolates: k(0) = 577/576. ImageMagick 7 has both, MagicKernelSharp2013 and -2021.
#include <cstdlib>

#include "core/dd_math.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    choice("version", "2021", "2021|2013", "year of the sharpening; radius 4.5 or 2.5 pixels")};

// weight[|i|] / denominator: of the B-spline i pixels away.
struct Sharpening {
  int reach;
  double weight[4], denominator;
};
constexpr Sharpening kOf2013 = {1, {6, -1, 0, 0}, 4}, kOf2021 = {3, {204, -35, 6, -1}, 144};

struct MagicKernelSharp {
  const Sharpening& sharp;
  explicit MagicKernelSharp(const Args& a) : sharp(a.text("version") == "2013" ? kOf2013 : kOf2021) {}

  double radius() const { return sharp.reach + 1.5; }
  std::vector<double> knots() const {
    std::vector<double> k;
    for (int i = 0; i <= 2 * sharp.reach + 3; ++i) k.push_back(i - radius());
    return k;
  }
  int degree() const { return 2; }

  // Three B-splines reach each piece: those centred at its middle and one pixel to either side.
  Dd shape(int piece, Dd x) const {
    Dd sum = 0.0;
    for (int i = piece - sharp.reach - 2; i <= piece - sharp.reach; ++i) {
      if (std::abs(i) > sharp.reach) continue;
      const Dd d = dd_abs(x - Dd(i));
      const Dd s = Dd(1.5) - d;
      const bool central = i == piece - sharp.reach - 1;
      sum = sum + Dd(sharp.weight[std::abs(i)]) * (central ? Dd(0.75) - d * d : Dd(0.5) * s * s);
    }
    return sum / Dd(sharp.denominator);
  }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo magic_kernel_sharp_filter;
constinit const FilterInfo magic_kernel_sharp_filter =
    describe<MagicKernelSharp>({.name = "magic-kernel-sharp",
                                .title = "Magic Kernel Sharp",
                                .cite = "Costella, \"Solving the mystery of Magic Kernel Sharp\", 2021",
                                .params = kParams});

}  // namespace moire
