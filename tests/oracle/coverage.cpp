// Areas of half-planes, disks and boards in a square by elementary geometry; see coverage.h.
#include "oracle/coverage.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace moire::oracle {
namespace {

// The area between a chord and its arc of a quarter circle at most: r^2/2 (theta - sin theta), theta = 2 asin(s),
// s = chord / (2 r). Small angles by the series of asin in 113 bits; the others come with small radii, where long
// double is good for r^2 1e-18.
Quad segment(Quad radius, Quad chord) {
  const Quad s = chord / (2 * radius);
  if (s > Quad(1) / 8) {
    const long double half = std::asin(narrow(s));
    return radius * radius * (widen(half) - s * sqrt((1 - s) * (1 + s)));
  }
  // asin s - s sqrt(1 - s^2) = sum over n >= 1 of s^(2n+1) c_n [1/(2n+1) + 1/(2n-1)], c_n = (2n-1)!!/(2n)!!:
  // asin's coefficients, and the binomial ones of the root, of opposite sign; no term is negative.
  Quad sum = 0, power = s, c = 1;
  for (int n = 1; n <= 18; ++n) {
    c = c * (2 * n - 1) / (2 * n);
    power = power * s * s;
    sum += power * c * (Quad(1) / (2 * n + 1) + Quad(1) / (2 * n - 1));
  }
  return radius * radius * sum;
}

}  // namespace

Value coverage(const Edge& edge, Pixel pixel, double width) {
  const HalfPlane h = around(edge, pixel);
  const Quad w = widen(width), a = max(abs(h.nx), abs(h.ny)), b = min(abs(h.nx), abs(h.ny));
  const Quad whole = w * (a + b);
  const Quad corner = whole / 2 + h.offset;  // at the corner that is inside first; the opposite one has corner - whole
  Quad part = 0;
  const auto cut_corner = [&](Quad e) { return e <= 0 ? Quad(0) : e * e / (2 * a * b); };
  if (corner <= 0)
    part = 0;
  else if (corner >= whole)
    part = w * w;
  else if (corner <= w * b)
    part = cut_corner(corner);
  else if (corner <= w * a)
    part = w * (corner - w * b / 2) / a;
  else
    part = w * w - cut_corner(whole - corner);
  return {narrow(part / (w * w)), 1e-19L};
}

Value coverage(const Disk& disk, Pixel pixel, double width) {
  const Circle c = around(disk, pixel);
  const Quad half = widen(width) / 2, r = c.radius;
  const auto reach = [&](Quad d) { return sqrt((r - d) * (r + d)); };  // half chord at distance d from the centre
  const Quad top = max(-half, c.center.y - r), bottom = min(half, c.center.y + r);
  if (top >= bottom) return {0, 0};
  std::vector<Quad> cut{top, bottom, c.center.y};
  for (const Quad side : {-half, half})
    for (const Quad sign : {Quad(-1), Quad(1)}) cut.push_back(c.center.y + sign * reach(side - c.center.x));
  std::sort(cut.begin(), cut.end());
  Quad part = 0;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    const Quad y1 = max(cut[i], top), y2 = min(cut[i + 1], bottom);
    if (y1 >= y2) continue;
    // Pieces are told apart by their middle: at a tangent side an end may fall on either side of it.
    const Quad mid = reach((y1 + y2) / 2 - c.center.y);
    if (c.center.x - mid >= half || c.center.x + mid <= -half) continue;
    const Quad s1 = reach(y1 - c.center.y), s2 = reach(y2 - c.center.y);
    const Quad chord = sqrt((y2 - y1) * (y2 - y1) + (s2 - s1) * (s2 - s1));
    const Quad arc = (y2 - y1) * (s1 + s2) / 2 + segment(r, chord);
    part += c.center.x + mid < half ? c.center.x * (y2 - y1) + arc : half * (y2 - y1);
    part -= c.center.x - mid > -half ? c.center.x * (y2 - y1) - arc : -half * (y2 - y1);
  }
  // Only asin rounds at 64 bits: at most 12 segments, each to r^2 s 5e-20, and r s <= 0.71 width.
  const Quad square = 4 * half * half;
  return {narrow(part / square), 3e-18L * narrow(min(1, r * r / square))};
}

Value coverage(const Board& board, Pixel pixel, double width, double squares) {
  const Quad w = widen(width), half = w / 2;
  Quad nearest = 0, beyond = 0;
  if (!std::isfinite(board.extent[0])) {
    const Polygon seen = clip_front(board, pixel, half, 0);
    const auto depth = [&](Quad x, Quad y) {
      return widen(board.homography[6]) * (x + static_cast<Quad>(pixel.x) + Quad(1) / 2) +
             widen(board.homography[7]) * (y + static_cast<Quad>(pixel.y) + Quad(1) / 2) + widen(board.homography[8]);
    };
    const Quad corner[] = {depth(-half, -half), depth(half, -half), depth(half, half), depth(-half, half)};
    const Quad lowest = *std::min_element(corner, corner + 4), highest = *std::max_element(corner, corner + 4);
    if (highest <= 0) return {0, 0};
    if (lowest <= 0) {
      // The nearest line W = const to the horizon that leaves no more squares in front of it.
      Quad low = 0, high = highest;
      for (int step = 0; step < 60; ++step) {
        const Quad mid = (low + high) / 2;
        const Polygon front = clip_front(board, pixel, half, mid);
        const bool few = front.size() < 3 || squares_in(board, pixel, front) <= widen(squares);
        (few ? high : low) = mid;
      }
      nearest = high;
      beyond = area(seen) - area(clip_front(board, pixel, half, nearest));
    }
  }
  Quad part = beyond / 2;
  for (const Polygon& p : clip(board, pixel, half, nearest)) part += area(p);
  return {narrow(part / (w * w)), 1e-19L + narrow(beyond / (2 * w * w))};
}

}  // namespace moire::oracle
