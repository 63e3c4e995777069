// A stretch of a line or a circle as the pixel's centre sees it, from its nearest or farthest point on.
//
// With the chord c from the circle's nearest point as the parameter, g = radius - D the signed distance of that point
// (positive: the pixel's centre is inside) and D that of the circle's centre, r^2 = g^2 + (D / radius) c^2: a sum of
// squares, free of cancellation however large or far the circle; a line is the case of an infinite radius. From the
// farthest point, at E = radius + D, it is r^2 = E^2 - (D / radius) c^2.
#pragma once

#include <algorithm>
#include <cmath>

namespace moire {

struct RadialTrack {
  double start = 0;  // g of a line or circle, or E
  double sense = 1;  // -1: from the farthest point, and r falls
  // D / radius, D / (2 radius^2), 1 / (2 radius).
  double lambda = 1, mu = 0, nu = 0;

  static RadialTrack line(double distance) { return {distance}; }
  static RadialTrack from_nearest(double g, double distance, double radius) {
    return {g, 1, distance / radius, 0.5 * (distance / radius) / radius, 0.5 / radius};
  }
  static RadialTrack from_farthest(double distance, double radius) {
    return {distance + radius, -1, distance / radius, 0.5 * (distance / radius) / radius, 0.5 / radius};
  }

  // For 0 <= c <= sqrt(2) radius, a quarter turn. For g right to 5 u, D to 2 u and c exact, r is right to 7 u of
  // itself, from the farthest point to 14 u: there r^2 >= E^2 / 2.
  double r(double c) const { return std::sqrt(start * start + sense * lambda * (c * c)); }
  // Where r is that, 0 or not a number where it never is; infinite on a circle around the centre.
  double chord(double r) const {
    const double e = std::fabs(start);
    return std::sqrt(std::max(0.0, sense * (r - e) * (r + e) / lambda));
  }
  // (x dy - y dx) / dc, and the same with the absolute terms of its sum. Right to 12 u of the second.
  double rise(double c) const { return (start + sense * mu * (c * c)) / root(c); }
  double absolute_rise(double c) const { return (std::fabs(start) + mu * (c * c)) / root(c); }
  // The point of chord c: x along the axis from the circle's centre to the pixel's, y >= 0 across it.
  double x(double c) const { return sense * (start - nu * (c * c)); }
  double y(double c) const { return c * root(c); }

  // The angle that the curve turns from chord c on, towards `end`, while r changes by at most the share e.
  double angle_near(double c, double end, double e) const {
    const double square = 2.1 * e * (start * start + sense * lambda * (c * c)) / lambda;
    const double to = c < end ? std::min(end, std::sqrt(c * c + square)) : std::sqrt(std::max(0.0, c * c - square));
    const double most = std::max(c, to), near = r(c);
    return std::fabs(to - c) * absolute_rise(most) / (near * near) * 1.01;
  }

  // How far r and the rise go in the complex plane, for c in the ellipse of semi-axes `real` and `imaginary` around
  // `mid`: r stays within `reach` of r(mid). False where that cannot be told.
  struct Reach {
    double reach, rise;
  };
  bool reach(double mid, double real, double imaginary, Reach& out) const {
    const double least = std::max(0.0, mid - real), most = mid + real;
    // Bounds on the real parts of r^2 and root^2, and so on the absolute values of r and root.
    const double square = sense > 0 ? start * start + lambda * (least * least - imaginary * imaginary)
                                    : start * start - lambda * most * most;
    const double root_square = (1 - nu * most) * (1 + nu * most);
    if (!(square > 0 && nu * most < 1)) return false;
    const double away = most * most + imaginary * imaginary;  // of |c|^2
    out = {real * lambda * std::sqrt(away / square), (std::fabs(start) + mu * away) / std::sqrt(root_square)};
    return true;
  }

 private:
  double root(double c) const { return std::sqrt((1 - nu * c) * (1 + nu * c)); }
};

}  // namespace moire
