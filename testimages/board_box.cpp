// u = 2^-53, h the window's half width. For a line a x + b y + c = 0, N = |a| + |b| and |n| = sqrt(a^2 + b^2); one that
// crosses the window has |c| <= N h. Errors are counted in values of the line's function, distances times |n|.
//
// 1. The coefficients, a = u.a - k w.a and so on, are right to u h (|k| (|w.a| + |w.b|) + N) in the window, and c,
// which comes from double-double, to u N h and what that has lost.
// 2. A value at a point of the window adds 4 u N h. The end of a line on a side of constant x or y, a quotient, adds no
// more, and an end that is put back on its side by rounding even less than the doubtful value.
// 3. So each line's ends are within e1 = 1. + 2. of it. The window's part beyond the chord between them and its true
// part then differ only where the line's value is within e1, by an area of at most e1 / |n| times the window's extent
// along the line, 2 h N / |n|. (A chord shorter than rounding has no direction; it counts twice.)
// 4. The area of the even squares is an integral of a product of signs, one for each line. So these differences add up,
// whatever they do to the order of ends and crossings; from here on the chords are the lines, and chords cross where
// their ends alternate along the outline.
// 5. Chord i is cut where the values of line j at its ends, interpolated from the end that is nearer to 0, are 0. The
// place is within 3 u h of chord i in value, and of chord j: 8 u N h for it (4 for each value, 2 for the quotient, 2
// for the point) and 4 for chord j's own ends. The area of the squares around changes by no more than these distances
// times the chords' lengths and by second order: the angle between chords that cross is above 2^-22, so that places
// move along them by less than 2^-24 h.
// 6. Beside the board's rim the outline has sides that are chords themselves: ends there are interpolated, 8 u N h in
// place of 4, and off the side by 3 u h. kRim has these and, for the rim's lines, what their own ends are off by.
// 7. Lines of one family do not meet. Where u goes over at most 18 squares and W is at least 2^-8 of the deepest W,
// line k + 1 has the value -W on line k and at most 18 times the deepest anywhere, so that they are 2^-13 h apart.
//
// What is of second order goes into a factor 1 + 2^-10 at the end.
#include "testimages/board_box.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/rounding.h"
#include "core/sum.h"
#include "testimages/board_outline.h"

namespace moire {
namespace {

constexpr double kShallowest = 0x1p-8;       // of the deepest W
constexpr double kMaxSquareNumber = 0x1p40;  // beyond, rounding of u and v would take squares for each other
constexpr double kLost = 0x1p-100;           // of double-double sums, of their terms
// Shares of u N h: 3., and what 5. and 6. add.
constexpr double kEnds = 4, kCutting = 3, kCut = 12, kRim = 20;

// a x + b y + hi + lo around the window's centre; the constant is right to `lost`.
struct CentredRow {
  double a, b, hi, lo, lost;
  double extreme(double h) const { return (std::fabs(a) + std::fabs(b)) * h; }
};

CentredRow centred_row(const double* row, double x, double y) {
  const Dd p = two_prod(row[0], x), q = two_prod(row[1], y), first = two_sum(p.hi, q.hi),
           second = two_sum(first.hi, row[2]);
  return {row[0], row[1], second.hi, second.lo + (first.lo + (p.lo + q.lo)),
          kLost * (std::fabs(p.hi) + std::fabs(q.hi) + std::fabs(row[2]))};
}

// The range of u or v in the window, wider than its rounding.
struct Interval {
  double low, high;
};

// U - k W of two rows in a window.
PlainLine line_of(const CentredRow& r, const CentredRow& w, double k, double h) {
  const Dd kw = two_prod(k, w.hi), first = two_sum(r.hi, -kw.hi);
  PlainLine line{r.a - k * w.a, r.b - k * w.b, first.hi + (first.lo + (r.lo - kw.lo - k * w.lo)), 0, 0, {-1, -1}, 0};
  line.norm = std::fabs(line.a) + std::fabs(line.b);
  line.coefficients = kUnit * (std::fabs(k) * w.extreme(h) + line.norm * h + std::fabs(line.c)) + r.lost +
                      std::fabs(k) * w.lost + kLost * (std::fabs(r.hi) + std::fabs(kw.hi));
  return line;
}

// One window. Lines of the first family are u = k, of the second v = l.
class Cutting {
 public:
  explicit Cutting(double h) : h_(h), outline_(h) {}

  // Keeps what is on the inner side of a line of the rim. False: no answer.
  bool cut_rim(PlainLine line, double sign) {
    if (sign < 0) line.a = -line.a, line.b = -line.b, line.c = -line.c;
    const std::optional<double> length = outline_.cut(line);
    if (!length) return false;
    rim_ = true;
    add_error(line, kEnds + kRim, *length);
    return true;
  }

  bool empty() const { return outline_.size() == 0; }
  BoxIntegral nothing() const { return {0, error_ * (1 + 0x1p-10)}; }

  // Lines of one family in order of k. False: no answer.
  bool add_line(int family, PlainLine line) {
    double value[16];
    const std::size_t n = outline_.size();
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < n; ++i) {
      value[i] = line.at(outline_[i]);
      least = std::min(least, std::fabs(value[i]));
    }
    value[n] = value[0];
    const int number = count_[0] + count_[1];
    int changes = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if ((value[i] >= 0) == (value[i + 1] >= 0)) continue;
      if (++changes > 2) return false;
      LineEnd end = outline_.meet(i, line, value[i], value[i + 1]);
      end.line = number;
      insert(end);
    }
    // The first vertex lies in this square or in one beyond.
    passed_ += value[0] >= 0;
    if (changes == 0) {
      if (least <= 2 * (line.coefficients + 4 * kUnit * line.norm * h_)) add_error(line, kEnds, h_);
      return true;
    }
    lines_[static_cast<std::size_t>(number)] = line;
    ++count_[static_cast<std::size_t>(family)];
    return true;
  }

  // `first` is the sum of the numbers of the first vertex's square, had no line been passed.
  std::optional<BoxIntegral> integrate(std::int64_t first) {
    walk_outline(((first + passed_) & 1) == 0);
    if (!cross()) return std::nullopt;
    const auto all = static_cast<std::size_t>(count_[0] + count_[1]);
    for (std::size_t i = 0; i < all; ++i) {
      const PlainLine& line = lines_[i];
      const double cut = rim_                                      ? kRim
                         : line.crossed == 0                       ? 0
                         : i < static_cast<std::size_t>(count_[0]) ? kCutting
                                                                   : kCut;
      const Vec2 p = end_[static_cast<std::size_t>(line.end[0])].at, q = end_[static_cast<std::size_t>(line.end[1])].at;
      add_error(line, kEnds + cut, std::fabs(p.x - q.x) + std::fabs(p.y - q.y));
    }
    const double area = std::clamp(sum_.value(), 0.0, 4 * h_ * h_);
    // Three roundings of each trapezoid, and the sum's.
    const double bound = (error_ + kUnit * (3 * terms_ + 2 * std::fabs(area))) * (1 + 0x1p-10);
    if (!(bound <= kPlainBound * 4 * h_ * h_)) return std::nullopt;
    return BoxIntegral{area, bound};
  }

 private:
  void insert(const LineEnd& end) {
    int i = ends_++;
    for (; i > 0; --i) {
      const LineEnd& before = end_[static_cast<std::size_t>(i - 1)];
      if (before.side < end.side || (before.side == end.side && before.along <= end.along)) break;
      end_[static_cast<std::size_t>(i)] = before;
    }
    end_[static_cast<std::size_t>(i)] = end;
  }

  // `length` of the chord, or of another line that has no direction to lose.
  void add_error(const PlainLine& line, double share, double length) {
    const double value = line.coefficients + share * kUnit * line.norm * h_;
    const double area = 2 * h_ * value * line.norm / (line.a * line.a + line.b * line.b);
    error_ += length < 0x1p-30 * h_ ? 2 * area : area;
  }

  void add_piece(Vec2 p, Vec2 q, bool plus) {
    const double area = 0.5 * (p.x + q.x) * (q.y - p.y);
    sum_.add(plus ? area : -area);
    terms_ += std::fabs(area);
  }

  void walk_outline(bool even) {
    int next = 0;
    Vec2 at = outline_[0];
    for (std::size_t side = 0; side < outline_.size(); ++side) {
      for (; next < ends_ && end_[static_cast<std::size_t>(next)].side == static_cast<int>(side); ++next) {
        const LineEnd& end = end_[static_cast<std::size_t>(next)];
        if (even) add_piece(at, end.at, true);
        at = end.at;
        even = !even;
        even_after_ |= std::uint64_t{even} << next;
        PlainLine& line = lines_[static_cast<std::size_t>(end.line)];
        line.end[line.end[0] < 0 ? 0 : 1] = next;
      }
      const Vec2 corner = outline_[side + 1];
      if (even) add_piece(at, corner, true);
      at = corner;
    }
  }

  // Cuts chords where they cross and adds their pieces. False: two chords cross at next to no angle.
  bool cross() {
    const int m = count_[0], n = count_[1];
    for (int i = 0; i < m; ++i) {
      PlainLine& one = lines_[static_cast<std::size_t>(i)];
      const Vec2 p = end_[static_cast<std::size_t>(one.end[0])].at, q = end_[static_cast<std::size_t>(one.end[1])].at;
      const auto within = [&one](int end) { return end > one.end[0] && end < one.end[1]; };
      for (int j = 0; j < n; ++j) {
        PlainLine& other = lines_[static_cast<std::size_t>(m + j)];
        if (within(other.end[0]) == within(other.end[1])) continue;
        const double at_p = other.at(p), at_q = other.at(q);
        if (!(std::fabs(at_p - at_q) >= 0x1p-20 * other.norm * h_)) return false;
        one.crossed |= 1u << j;
        other.crossed |= 1u << i;
        crossing_[i][j] = Outline::between(p, q, at_p, at_q);
      }
    }
    for (int i = 0; i < m; ++i) {
      add_chord(lines_[static_cast<std::size_t>(i)], [this, i](int j) -> Vec2 { return crossing_[i][j]; });
    }
    for (int j = 0; j < n; ++j) {
      add_chord(lines_[static_cast<std::size_t>(m + j)], [this, j](int i) -> Vec2 { return crossing_[i][j]; });
    }
    return true;
  }

  // The pieces of a chord; `place` gives its crossing with a line of the other family.
  template <class Place>
  void add_chord(const PlainLine& line, const Place& place) {
    const Vec2 from = end_[static_cast<std::size_t>(line.end[0])].at;
    const Vec2 to = end_[static_cast<std::size_t>(line.end[1])].at;
    // The outline goes from the chord's first end to the second around one side of it. If that is even, it walks the
    // chord backwards, and else the other side is even and walks it forwards.
    bool plus = (even_after_ >> line.end[0] & 1) == 0;
    Vec2 at = from;
    if (line.crossed != 0) {
      int first = std::countr_zero(line.crossed), last = static_cast<int>(std::bit_width(line.crossed)) - 1, step = 1;
      const Vec2 a = place(first), b = place(last);
      if ((b.x - a.x) * (to.x - at.x) + (b.y - a.y) * (to.y - at.y) < 0) std::swap(first, last), step = -1;
      for (int i = first; i != last + step; i += step) {
        if ((line.crossed >> i & 1) == 0) continue;
        const Vec2 p = place(i);
        add_piece(at, p, plus);
        at = p;
        plus = !plus;
      }
    }
    add_piece(at, to, plus);
  }

  double h_;
  Outline outline_;
  bool rim_ = false;
  std::array<PlainLine, 2 * kMostLines> lines_;
  std::array<LineEnd, 4 * kMostLines> end_;  // in order along the outline
  int ends_ = 0, passed_ = 0;
  std::uint64_t even_after_ = 0;  // bit i: the outline is in an even square behind end i
  std::array<int, 2> count_{};
  PlainPoint crossing_[kMostLines][kMostLines];
  Sum sum_;
  double terms_ = 0, error_ = 0;
};

// floor and ceil of |x| < 2^50, without the calls that baseline x86-64 makes of them.
double floor_of(double x) {
  const auto towards_zero = static_cast<double>(static_cast<std::int64_t>(x));
  return towards_zero > x ? towards_zero - 1 : towards_zero;
}
double ceil_of(double x) { return -floor_of(-x); }

}  // namespace

std::optional<BoxIntegral> board_box(const Matrix3& m, const Extent& extent, Pixel origin, double h) {
  // Also the largest integers that are doubles with a half added.
  constexpr std::int64_t kFarthest = std::int64_t{1} << 51;
  if (origin.x > kFarthest || origin.x < -kFarthest || origin.y > kFarthest || origin.y < -kFarthest) {
    return std::nullopt;
  }
  const double x = static_cast<double>(origin.x) + 0.5, y = static_cast<double>(origin.y) + 0.5;
  const CentredRow rows[] = {centred_row(&m[0], x, y), centred_row(&m[3], x, y)}, w = centred_row(&m[6], x, y);
  const double depth = w.hi + w.lo, fall = w.extreme(h), shallowest = depth - fall;
  if (!(shallowest > kShallowest * (depth + fall) && w.lost < 0x1p-40 * shallowest)) return std::nullopt;

  // Corners in the order of the outline, the first one (-h, -h).
  const double wx = w.a * h, wy = w.b * h;
  const double per_w[] = {1 / (depth - wx - wy), 1 / (depth + wx - wy), 1 / (depth + wx + wy), 1 / (depth - wx + wy)};
  Interval span[2];
  for (std::size_t f = 0; f < 2; ++f) {
    const CentredRow& r = rows[f];
    const double c = r.hi + r.lo, rx = r.a * h, ry = r.b * h;
    const double q0 = (c - rx - ry) * per_w[0], q1 = (c + rx - ry) * per_w[1], q2 = (c + rx + ry) * per_w[2],
                 q3 = (c - rx + ry) * per_w[3];
    const double low = std::min(std::min(q0, q1), std::min(q2, q3)),
                 high = std::max(std::max(q0, q1), std::max(q2, q3));
    const double largest = std::max(-low, high);
    if (!(largest < kMaxSquareNumber)) return std::nullopt;
    // A numerator is right to 18 u of the largest, whatever cancels in it, and that at most 2^8 largest times W.
    const double doubt = 0x1p-36 * largest + 2 * r.lost / shallowest;
    span[f] = {low - doubt, high + doubt};
  }

  Cutting cutting(h);
  const double sides[2][2] = {{extent.u0, extent.u1}, {extent.v0, extent.v1}};
  for (std::size_t f = 0; f < 2; ++f) {
    const auto [low, high] = sides[f];
    if (span[f].high < low || span[f].low > high) return BoxIntegral{0, 0};
    if (span[f].low <= low && !cutting.cut_rim(line_of(rows[f], w, low, h), 1)) return std::nullopt;
    if (span[f].high >= high && !cutting.cut_rim(line_of(rows[f], w, high, h), -1)) return std::nullopt;
  }
  if (cutting.empty()) return cutting.nothing();
  std::int64_t first = 0;
  for (std::size_t f = 0; f < 2; ++f) {
    const auto [low, high] = sides[f];
    double from = ceil_of(span[f].low), to = floor_of(span[f].high);
    // The rim is no line of the board.
    if (from <= low) from = floor_of(low) + 1;
    if (to >= high) to = ceil_of(high) - 1;
    if (!(to - from < kMostLines)) return std::nullopt;
    first += static_cast<std::int64_t>(from) - 1;
    for (double k = from; k <= to; ++k) {
      if (!cutting.add_line(static_cast<int>(f), line_of(rows[f], w, k, h))) return std::nullopt;
    }
  }
  return cutting.integrate(first);
}

}  // namespace moire
