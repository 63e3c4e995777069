// Quadrature over rings; see rings.h. Definitions as in shapes.cpp, of r in place of |x|; the jinc by the library's
// Bessel function.
#include "oracle/rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "oracle/shapes.h"
#include "oracle/spec_values.h"

namespace moire::oracle {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

struct Shape {
  std::vector<long double> breaks;
  std::function<long double(long double)> value;
};

// The separable kernel of that description as a function of r.
Shape turned(const std::string& separable) {
  const HalfKernel half = half_kernel(parse_spec(separable, "oracle"));
  return {half.breaks, half.shape};
}

// The given parameters but the preset, for another filter's name.
std::string with_parameters(const Spec& spec, const std::string& name) {
  std::string text = name;
  for (const auto& [key, value] : spec.given) {
    if (key == "preset") continue;
    text += (text == name ? ":" : ",") + key + "=" + value.text;
  }
  return text;
}

Shape radial_bc(const Spec& spec) {
  const std::string_view preset = text_of(spec, "preset", "none");
  if (preset == "renderman-catmull-rom") return turned("catmull-rom");
  if (preset == "imagemagick-robidoux") return turned("robidoux");
  if (preset == "imagemagick-robidoux-sharp") return turned("robidoux-sharp");
  if (preset != "ospray-mitchell") return turned(with_parameters(spec, "mitchell"));
  const Shape whole = turned("mitchell");
  // Negative from 8/7 on: kept up to the double next to it, where the program's support ends.
  const auto end = static_cast<long double>(8.0 / 7);
  return {{0, 1, end}, whole.value};
}

// The zeros of J1 over pi: signs of the library's function, halved.
long double jinc_zero(int number) {
  long double lo = static_cast<long double>(number) + 0.1L, hi = lo + 0.3L;
  const bool rising = std::cyl_bessel_jl(1, kPi * hi) > 0;
  for (int i = 0; i < 70; ++i) {
    const long double mid = (lo + hi) / 2;
    ((std::cyl_bessel_jl(1, kPi * mid) > 0) == rising ? hi : lo) = mid;
  }
  return lo;
}

long double jinc(long double x) {
  if (x < 1e-12L) return 1;
  return 2 * std::cyl_bessel_jl(1, kPi * x) / (kPi * x);
}

// The program's knots are doubles, and its kernel is what these make of the formula.
long double stored(long double x) { return static_cast<long double>(static_cast<double>(x)); }

Shape windowed_jinc(const Spec& spec) {
  const std::string_view preset = text_of(spec, "preset", "none");
  int lobes = static_cast<int>(number_of(spec, "lobes", 3));
  long double blur = number_of(spec, "blur", 1);
  if (preset == "imagemagick2" || preset == "imagemagick2-sharp") lobes = 2;
  if (preset == "imagemagick-sharp") blur = stored(0.9812505644269356L);
  if (preset == "imagemagick2-sharp") blur = stored(0.9549963639785485L);
  Shape s{{0}, {}};
  for (int i = 1; i <= lobes; ++i) s.breaks.push_back(stored(stored(jinc_zero(i)) * blur));
  const long double narrow = jinc_zero(1) / jinc_zero(lobes);
  s.value = [=](long double r) { return jinc(r / blur) * jinc(r / blur * narrow); };
  return s;
}

Shape shape_of(const Spec& spec) {
  if (spec.name == "disk") return {{0, number_of(spec, "radius", 0.5)}, [](long double) { return 1.0L; }};
  if (spec.name == "cone") return turned(with_parameters(spec, "tent"));
  if (spec.name == "radial-gaussian") return turned(with_parameters(spec, "gaussian"));
  if (spec.name == "radial-bc") return radial_bc(spec);
  if (spec.name == "radial-lanczos") return turned(with_parameters(spec, "lanczos"));
  if (spec.name == "radial-blackman-harris") {
    const std::string given = with_parameters(spec, "blackman-harris");
    return turned(given == "blackman-harris" ? "blackman-harris:width=3" : given);
  }
  if (spec.name == "jinc") return windowed_jinc(spec);
  throw std::invalid_argument("no radial filter " + spec.name);
}

const RulePair kRules{Rule(16), Rule(24)};

// Integral of f(r) over [a, b]; f may have square roots at both ends, which r = mid - half cos t takes away.
template <class F>
Value between(const F& f, long double a, long double b) {
  const long double half = (b - a) / 2;
  const auto turned_f = [&](long double t) {
    const long double s = std::sin(t / 2), c = std::cos(t / 2);
    // Counted from the nearer end, so that no point leaves the interval.
    const long double r = t < kPi / 2 ? a + 2 * half * s * s : b - 2 * half * c * c;
    return f(r) * half * 2 * s * c;
  };
  return integrate(kRules, turned_f, 0.0L, kPi);
}

// A bend just outside an interval hides between nodes from both rules. Where two bends are close, what lies beyond them
// is cut at 4, 16, ... times their distance.
std::vector<long double> graded(std::vector<long double> bends) {
  std::sort(bends.begin(), bends.end());
  std::vector<long double> all = bends;
  for (std::size_t i = 0; i + 1 < bends.size(); ++i) {
    const long double gap = bends[i + 1] - bends[i];
    if (gap == 0) continue;
    if (i + 2 < bends.size())
      for (long double d = 4 * gap; bends[i + 1] + d < bends[i + 2]; d *= 4) all.push_back(bends[i + 1] + d);
    if (i > 0)
      for (long double d = 4 * gap; bends[i] - d > bends[i - 1]; d *= 4) all.push_back(bends[i] - d);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Integral of k(r) r times `angle`(r), the scene's share of the ring in radians, which may bend at `bends`.
template <class F>
Value over_rings(const RingKernel& k, std::vector<long double> bends, const F& angle) {
  bends.insert(bends.end(), k.breaks().begin(), k.breaks().end());
  bends = graded(std::move(bends));
  Value v;
  long double area = 0;  // of the rings that are met
  for (std::size_t i = 0; i + 1 < bends.size(); ++i) {
    const long double a = std::max(bends[i], 0.0L), b = std::min(bends[i + 1], k.radius());
    if (!(a < b)) continue;
    if (angle((a + b) / 2) == 0) continue;  // no scene in these rings: `angle` is 0 between two bends, or nowhere
    area += kPi * (b - a) * (b + a);
    v += between([&](long double r) { return k(r) * r * angle(r); }, a, b);
  }
  // Rounding of the kernel, which integrate() does not see: of all of it, or of its largest values in those rings.
  v.error += 0x1p-58L * std::min(k.gain(), 1.5L * std::fabs(k(0)) * area);
  return v;
}

// 2 acos of (above - below) / (above + below), both at least 0: half the angle has the tangent sqrt(below / above).
long double twice_arc(Quad above, Quad below) {
  if (below <= 0) return 0;
  if (above <= 0) return 2 * kPi;
  return 4 * std::atan2(std::sqrt(narrow(below)), std::sqrt(narrow(above)));
}

Circle circle_around(const Disk& disk, Pixel pixel, Quad& distance) {
  const Circle c = around(disk, pixel);
  distance = sqrt(c.center.x * c.center.x + c.center.y * c.center.y);
  return c;
}

// Angles of a ring inside a convex polygon, from its crossings with the sides.
long double inside(const Polygon& p, long double r) {
  std::vector<long double> at;
  const auto point = [&](std::size_t i) {
    const Point& v = p[i % p.size()];
    return std::pair<long double, long double>{narrow(v.x), narrow(v.y)};
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto [ax, ay] = point(i);
    const auto [bx, by] = point(i + 1);
    const long double dx = bx - ax, dy = by - ay, length = std::hypot(dx, dy);
    if (length == 0) continue;
    const long double s0 = (ax * dx + ay * dy) / length, s1 = (bx * dx + by * dy) / length;
    const long double h = (ax * dy - ay * dx) / length;
    if (std::fabs(h) >= r) continue;
    const long double reach = std::sqrt((r - std::fabs(h)) * (r + std::fabs(h)));
    for (const long double s : {-reach, reach})
      if (s >= s0 && s <= s1) at.push_back(std::atan2((s * dy - h * dx) / length, (s * dx + h * dy) / length));
  }
  std::sort(at.begin(), at.end());
  const auto holds = [&](long double angle) {
    const long double x = r * std::cos(angle), y = r * std::sin(angle);
    bool left = false, right = false;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto [ax, ay] = point(i);
      const auto [bx, by] = point(i + 1);
      const long double side = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
      left |= side > 0;
      right |= side < 0;
    }
    return !(left && right);
  };
  if (at.empty()) return holds(0.7L) ? 2 * kPi : 0;
  long double sum = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const long double next = i + 1 < at.size() ? at[i + 1] : at[0] + 2 * kPi;
    if (holds((at[i] + next) / 2)) sum += next - at[i];
  }
  return sum;
}

Value over_polygon(const RingKernel& k, const Polygon& p) {
  std::vector<long double> bends;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point a = p[i], b = p[(i + 1) % p.size()];
    const Quad dx = b.x - a.x, dy = b.y - a.y, length = sqrt(dx * dx + dy * dy);
    bends.push_back(narrow(sqrt(a.x * a.x + a.y * a.y)));
    if (length == 0) continue;
    const Quad s0 = a.x * dx + a.y * dy, s1 = b.x * dx + b.y * dy;
    if (s0 < 0 && s1 > 0) bends.push_back(narrow(abs(a.x * dy - a.y * dx) / length));
  }
  return over_rings(k, bends, [&](long double r) { return inside(p, r); });
}

}  // namespace

RingKernel::RingKernel(std::string_view text) {
  const Spec spec = parse_spec(text, "oracle");
  Shape shape = shape_of(spec);
  breaks_ = std::move(shape.breaks);
  shape_ = std::move(shape.value);
  long double total = 0, absolute = 0;
  for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
    total += between([&](long double r) { return shape_(r) * r; }, breaks_[i], breaks_[i + 1]).value;
    constexpr int kPoints = 200;
    const long double step = (breaks_[i + 1] - breaks_[i]) / kPoints;
    for (int j = 0; j < kPoints; ++j) {
      const long double r = breaks_[i] + (static_cast<long double>(j) + 0.5L) * step;
      absolute += std::fabs(shape_(r)) * r * step;
    }
  }
  scale_ = 1 / (2 * kPi * total);
  gain_ = 1.1L * absolute / std::fabs(total);
}

long double RingKernel::moment(long double r) const {
  long double sum = 0;
  for (std::size_t i = 0; i + 1 < breaks_.size() && breaks_[i] < r; ++i)
    sum += between([&](long double s) { return (*this)(s)*s; }, breaks_[i], std::min(r, breaks_[i + 1])).value;
  return sum;
}

Value filtered(const RingKernel& k, const Edge& edge, Pixel pixel) {
  const HalfPlane h = around(edge, pixel);
  const Quad distance = h.offset / sqrt(h.nx * h.nx + h.ny * h.ny);
  return over_rings(k, {std::fabs(narrow(distance))},
                    [&](long double r) { return twice_arc(widen(r) - distance, widen(r) + distance); });
}

Value filtered(const RingKernel& k, const Disk& disk, Pixel pixel) {
  Quad d = 0;
  const Quad r = circle_around(disk, pixel, d).radius;
  const auto angle = [&](long double ring) {
    const Quad s = widen(ring);
    if (s + d <= r) return 2 * kPi;
    if (d >= s + r || s >= d + r) return 0.0L;
    // cos of the half angle: (s^2 + d^2 - r^2) / (2 s d), one more and one less as products.
    return twice_arc((s + d - r) * (s + d + r), (r - s + d) * (r + s - d));
  };
  return over_rings(k, {narrow(abs(r - d)), narrow(d + r)}, angle);
}

// Rays from the disk's own centre, one side of the axis to the pixel's: places are counted from there, in radii.
Value filtered_per_square(const RingKernel& k, const Disk& disk, Pixel pixel) {
  Quad d = 0;
  const Quad radius = circle_around(disk, pixel, d).radius;
  std::vector<long double> turns{0, kPi};
  // Beyond a knot circle: |centre + s ray|^2 = d^2 + 2 d s cos + s^2. That over d radius, and radius over d.
  std::vector<long double> beyond;
  const auto small = narrow(radius / d);
  for (const long double knot : k.breaks()) {
    if (knot == 0) continue;
    beyond.push_back(narrow((widen(knot) - d) * (widen(knot) + d) / (d * radius)));
    const long double c = (beyond.back() - small) / 2;
    if (std::fabs(c) < 1) turns.push_back(std::acos(c));
    // Rays along the knot circle: c^2 + small m is 0 or next to it, and its root bends.
    const long double touch = std::sqrt(std::fabs(small * beyond.back()));
    if (touch >= 1) continue;
    turns.push_back(std::acos(touch));
    turns.push_back(std::acos(-touch));
  }
  const Rule along(24);
  const auto one_ray = [&](long double angle) {
    const long double c = std::cos(angle);
    std::vector<long double> cut{0, 1};
    for (const long double m : beyond) {
      // small s^2 + 2 c s - m = 0
      const long double root = std::sqrt(std::max(0.0L, c * c + small * m));
      const long double larger = c < 0 ? c - root : c + root;
      for (const long double s : {m / larger, -larger / small})
        if (s > 0 && s < 1) cut.push_back(s);
    }
    std::sort(cut.begin(), cut.end());
    long double sum = 0;
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
      const long double mid = (cut[i] + cut[i + 1]) / 2, half = (cut[i + 1] - cut[i]) / 2;
      // Which side of the knot circles the stretch is on, told by its middle; its points are kept there.
      const long double excess = 2 * c * mid + small * mid * mid;
      std::size_t piece = 0;
      while (piece < beyond.size() && excess >= beyond[piece]) ++piece;
      if (piece == beyond.size()) continue;
      const long double lo = k.breaks()[piece], hi = std::nextafter(k.breaks()[piece + 1], 0.0L);
      for (std::size_t n = 0; n < along.x.size(); ++n) {
        const long double s = mid + half * along.x[n];
        const long double r = narrow(d) * std::sqrt(1 + small * (2 * c * s + small * s * s));
        sum += half * along.w[n] * s * k(std::clamp(r, lo, hi));
      }
    }
    return 2 * sum;
  };
  turns = graded(std::move(turns));
  Value v;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i)
    if (turns[i] < turns[i + 1]) v += integrate(kRules, one_ray, turns[i], turns[i + 1]);
  if (v.error > 0) v.error += 0x1p-56L * k.gain() * std::fabs(k(k.breaks()[1] / 2));  // 0: no node met the support
  return v;
}

Value filtered(const RingKernel& k, const Board& board, Pixel pixel) {
  Value v;
  for (const Polygon& p : clip(board, pixel, widen(k.radius())))
    if (area(p) > widen(1e-24L)) v += over_polygon(k, p);  // less is what touches the window, and nothing
  return v;
}

}  // namespace moire::oracle
