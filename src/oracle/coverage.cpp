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
// `rounding` grows by what asin may be off by.
Quad segment(Quad radius, Quad chord, Quad& rounding) {
  const Quad s = chord / (2 * radius);
  if (s > Quad(1) / 8) {
    const long double half = std::asin(narrow(s));
    rounding += radius * radius * widen(0x1p-63L * half);
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

namespace {

// `lost`: what the half-plane's offset may be off by.
Value coverage(const HalfPlane& h, double width, Quad lost) {
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
  // The line's shift by `lost` and by the roundings of `corner`, times its length, which is that of the cut at most:
  // 1/a for each unit across, no longer than the window. Then the last rounding, to 64 bits.
  lost += widen(0x1p-111L) * (whole + abs(h.offset));
  const Quad deep = max(min(corner, whole - corner), 0) + lost;
  const Quad across = deep < w * b ? deep / b : w;
  return {narrow(part / (w * w)), narrow((lost * across / a + part * widen(0x1p-63L)) / (w * w))};
}

}  // namespace

Value coverage(const HalfPlane& half_plane, double width) { return coverage(half_plane, width, 0); }

Value coverage(const Edge& edge, Pixel pixel, double width) {
  const Quad terms = abs(relative(edge.through[0], pixel.x) * widen(edge.normal[0])) +
                     abs(relative(edge.through[1], pixel.y) * widen(edge.normal[1]));
  return coverage(around(edge, pixel), width, widen(0x1p-111L) * terms);
}

Value coverage(const Disk& disk, Pixel pixel, double width) { return coverage(around(disk, pixel), width); }

Value coverage(const Circle& c, double width) {
  const Quad half = widen(width) / 2, r = c.radius;
  const auto reach = [&](Quad d) { return sqrt((r - d) * (r + d)); };  // half chord at distance d from the centre
  const Quad top = max(-half, c.center.y - r), bottom = min(half, c.center.y + r);
  if (top >= bottom) return {0, 0};
  std::vector<Quad> cut{top, bottom, c.center.y};
  for (const Quad side : {-half, half})
    for (const Quad sign : {Quad(-1), Quad(1)}) cut.push_back(c.center.y + sign * reach(side - c.center.x));
  std::sort(cut.begin(), cut.end());
  Quad part = 0, rounding = 0;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    const Quad y1 = max(cut[i], top), y2 = min(cut[i + 1], bottom);
    if (y1 >= y2) continue;
    // Pieces are told apart by their middle: at a tangent side an end may fall on either side of it.
    const Quad mid = reach((y1 + y2) / 2 - c.center.y);
    if (c.center.x - mid >= half || c.center.x + mid <= -half) continue;
    const Quad s1 = reach(y1 - c.center.y), s2 = reach(y2 - c.center.y);
    const Quad chord = sqrt((y2 - y1) * (y2 - y1) + (s2 - s1) * (s2 - s1));
    const Quad arc = (y2 - y1) * (s1 + s2) / 2 + segment(r, chord, rounding);
    part += c.center.x + mid < half ? c.center.x * (y2 - y1) + arc : half * (y2 - y1);
    part -= c.center.x - mid > -half ? c.center.x * (y2 - y1) - arc : -half * (y2 - y1);
  }
  // Places on the circle are right across it to some roundings of its coordinates; where a cut between two pieces is
  // off by more, along the circle, both pieces have the same formula. Each row of pieces is used twice. Then the last
  // rounding, to 64 bits.
  rounding = 2 * rounding + widen(0x1p-107L) * (r + abs(c.center.x) + abs(c.center.y)) * (bottom - top);
  const Quad square = 4 * half * half;
  return {narrow(part / square), narrow((rounding + abs(part) * widen(0x1p-63L)) / square)};
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
