// The noise spectrum to expect of an image from one set of points over all of it, without regard to pixels
// (layout=image), under the un-normalised estimator: second moments of point processes (M. S. Bartlett, "The spectral
// analysis of two-dimensional point processes", Biometrika 51, 1964), carried through filter and pixels.
//
// f is the scene, 0 or 1, k the filter's kernel in the plane, H its response. n points x_i lie in a rectangle of area
// A, the image and its apron; rho = n / A is their density per square pixel. Pixel c gets v(c) = sum over i of k(x_i -
// c) f(x_i) / rho, whose mean is the exact value. A pattern is stationary if its law is unchanged by shifts on the
// torus of the rectangle: then all that counts of it is its power P(f) (point_spectrum.h; frequencies in cycles per
// pixel), or p(u), the transform of P - 1: p / rho + 1 is the pair correlation, by how much more often than independent
// points two points lie at distance u. By Campbell's formulas
//
//   rho cov(v(c), v(c')) = integral of k(x - c) k(x - c') f(x) dx
//                        + integral of k(x - c) k(y - c') f(x) f(y) (p(x - y) - P(0) / A) dx dy
//
// with P(0) the power near zero frequency. A fixed number of points has no power at zero frequency itself, which on the
// torus takes the constant P(0) / A off p; a random number of points would not have that term. It matters for zero
// frequency and its neighbours only. The spectrum in units of spectrum.h, whose mean over the W x H bins is the mean
// variance of a pixel, is
//
//   S(f) = 1 / (W H) sum over pixels c, c' of cov(v(c), v(c')) exp(-2 pi i f (c - c')).
//
// That is what is computed here: with the image's border as it is (windows reach into the apron, and pixels without a
// neighbour have no covariance with it), and with the filter's weights where they are with respect to the pixels.
// Averaged over the place of the pixel lattice, and away from borders, it is
//
//   S(f) = sum over pairs of integers m of |H(f + m)|^2 N(f + m),
//   N(f) = 1 / (rho W H) integral of |F(f - g)|^2 (P(g) - peak at 0) dg,
//
// F the transform of the scene in the image: the scene spreads the pattern's power, the filter weighs it, the pixels
// fold it. For random points P = 1 and N is flat, the covered part of the image over rho. For jittered ones, of a grid
// with cells of sides a and b at a random place, P(f) = 1 - sinc^2(a f_x) sinc^2(b f_y), so p(u) is
// -tri(u_x / a) tri(u_y / b) / (a b) with tri(t) = max(0, 1 - |t|), and rho N(f) = C(0) minus the transform of
// C(u) tri(u_x / a) tri(u_y / b), C the scene's autocorrelation per pixel.
//
// With layout=pixel, a box of one pixel and any unbiased pattern with numbers of its own in every pixel, the pixels'
// errors are independent and S is flat: the mean variance.
#pragma once

#include <functional>
#include <vector>

#include "core/geometry.h"
#include "filters/kernel.h"

namespace moire {

// The scene over the image and its apron, in square cells of side 1 / per_pixel pixels.
struct FineCoverage {
  Grid image;                 // pixels
  int apron = 0;              // pixels on each side: at least ceil(R - 1/2) for a kernel of radius R
  int per_pixel = 2;          // even, so that the knots of kernels at halves of pixels are sides of cells
  std::vector<double> value;  // covered part of each cell, row-major, (width + 2 apron) per_pixel a row
};

// p at the cells' distances: means over all pairs of points of two cells.
struct PairExcess {
  int per_pixel = 2;
  int reach = -1;             // cells; -1: nothing
  std::vector<double> value;  // per square pixel, (2 reach + 1)^2, row-major, distance 0 in the middle; p(-u) = p(u)
  double zero_power = 1;      // P(0)
};

// Independent uniform points: p = 0.
PairExcess random_pairs(int per_pixel);

// One point in each cell of a grid of `cell_width` x `cell_height` pixels, at random in its cell, the grid at a random
// place on the torus of the points.
PairExcess jittered_pairs(double cell_width, double cell_height, int per_pixel);

// From P(f_x, f_y), even, at frequencies up to per_pixel / 2 cycles per pixel in both axes; beyond them it is taken as
// 1, and p as 0 where |u_x| or |u_y| is more than `reach` pixels. P(0, 0) is the limit, without the peak.
PairExcess pairs_of_power(const std::function<double(double, double)>& power, double reach, int per_pixel);

// S for `density` > 0 points per pixel, width x height bins in the order of spectrum.h; rings() of radial.h makes the
// radial mean. `pairs` and `scene` have the same per_pixel, and the distances of `pairs` are below half the sides of
// the torus.
//
// Error: of second order in 1 / per_pixel where detail of the scene and jumps of the kernel fall into one cell, of
// fourth order elsewhere. With 8 cells to a pixel and disks of radius 1/4 it was 0.3% of the mean power under a box at
// 4 points per pixel, 0.05% with 16 cells, and below 0.1% under smooth filters for jittered points. Dart-throwing,
// whose p jumps at its radius, had 0.7% with 8 cells, frequencies to 4 cycles per pixel, and 0.2% with twice as many of
// both.
//
// Time: for 64 x 64 pixels of 8 x 8 cells 0.1 s for a jittered grid at 1 point per pixel and 2 s for pairs up to 6
// pixels; it grows as the cells that are not empty, the distances of `pairs`, and the kernel's radius. In parallel,
// with the same bits for any number of threads.
std::vector<double> expected_noise(const Kernel& kernel, const FineCoverage& scene, double density,
                                   const PairExcess& pairs);

}  // namespace moire
