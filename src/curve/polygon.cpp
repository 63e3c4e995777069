#include "curve/polygon.h"

#include <cmath>

namespace moire {

Polygon square(double h) { return {{-h, -h}, {h, -h}, {h, h}, {-h, h}}; }

void clip(const Polygon& polygon, const HalfPlane& half_plane, Polygon& out) {
  out.clear();
  if (polygon.empty()) return;
  Vec2 a = polygon.back();
  double da = half_plane.at(a);
  for (const Vec2 b : polygon) {
    const double db = half_plane.at(b);
    if ((da < 0) != (db < 0)) {
      const double t = da / (da - db);
      out.push_back({a.x == b.x ? a.x : a.x + t * (b.x - a.x), a.y == b.y ? a.y : a.y + t * (b.y - a.y)});
    }
    if (db >= 0) out.push_back(b);
    a = b;
    da = db;
  }
  if (out.size() < 3) out.clear();
}

double perimeter(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    sum += std::hypot(b.x - a.x, b.y - a.y);
  }
  return sum;
}

}  // namespace moire
