// Sums over periods of t = 1/W; see one_point.h.
#include "oracle/one_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "oracle/quadrature.h"

namespace moire::oracle {
namespace {

constexpr long double kPeriod = 2;
constexpr std::size_t kTerms = 4;  // of polynomials of degree 3

// alpha + beta t, seen by waves of period 2.
struct Phase {
  Quad alpha, beta;
  Quad at(Quad t) const { return alpha + beta * t; }
};

Quad floor(Quad a) {
  const Quad whole = static_cast<Quad>(static_cast<std::int64_t>(a));  // values are below 2^60
  return whole > a ? whole - 1 : whole;
}

// 1 on even squares, -1 on odd ones.
long double sign_of(Quad whole) { return whole - 2 * floor(whole / 2) < 1 ? 1 : -1; }

// F_1 ... F_4 on [0, 1); F(u + 1) = -F(u). Their largest values.
std::array<long double, kTerms> antiderivatives(long double u) {
  const long double p = u * (1 - u);
  return {u - 0.5L, -p / 2, (u - 0.5L) * (2 * u * u - 2 * u - 1) / 12, p * (1 + p) / 24};
}
constexpr std::array<long double, kTerms> kLargest{0.5L, 0.125L, 1.0L / 24, 5.0L / 384};

// Sums over n >= 0 of (t + 2 n)^-q for q = 3 ... 9, t > 0: 24 terms and Euler and Maclaurin's formula. The terms are
// completely monotone, so that its remainder is below the next term, which is below 1e-22 of the sum: x >= t + 48.
constexpr std::size_t kOrders = 2 * kTerms - 1;
// Only the first `orders` are made, the others left at 0.
std::array<long double, kOrders> zetas(long double t, std::size_t orders) {
  std::array<long double, kOrders> sum{};
  long double x = t;
  for (int n = 0; n < 24; ++n, x += kPeriod) {
    const long double inverse = 1 / x;
    long double power = inverse * inverse * inverse;
    for (std::size_t i = 0; i < orders; ++i, power *= inverse) sum[i] += power;
  }
  const long double ratio2 = kPeriod * kPeriod / (x * x);
  long double power = 1 / (x * x);  // x^(1-q)
  for (std::size_t i = 0; i < orders; ++i, power /= x) {
    const auto q = static_cast<long double>(i + 3);
    // P^(2k-1) B_2k / (2k)! q (q+1) ... (q+2k-2) x^(-q-2k+1), by its ratio to the one before.
    constexpr long double kBernoulli[] = {1.0L / 6,  -1.0L / 30,     1.0L / 42, -1.0L / 30,
                                          5.0L / 66, -691.0L / 2730, 7.0L / 6};
    long double factor = kPeriod * q / (x * x) / 2, ends = 0, k2 = 2;
    for (const long double bernoulli : kBernoulli) {
      ends += factor * bernoulli;
      factor *= ratio2 * (q + k2 - 1) * (q + k2) / ((k2 + 1) * (k2 + 2));
      k2 += 2;
    }
    sum[i] += power * (1 / (kPeriod * (q - 1)) + 0.5L / x + ends);
  }
  return sum;
}

// The polynomial of k between two knots, in powers of the distance from `from`: its values at four points inside.
std::array<long double, kTerms> polynomial(const Kernel& k, long double from, long double to) {
  std::array<long double, kTerms> x{}, d{}, c{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    x[i] = (to - from) * (2 * static_cast<long double>(i) + 1) / (2 * kTerms);
    d[i] = k(from + x[i]);
  }
  const long double largest = std::fabs(k(0));
  for (std::size_t order = 1; order < kTerms; ++order)
    for (std::size_t i = kTerms; i-- > order;) d[i] = (d[i] - d[i - 1]) / (x[i] - x[i - order]);
  for (std::size_t i = kTerms; i-- > 0;) {
    // c = c (s - x_i) + d_i
    for (std::size_t j = kTerms; j-- > 1;) c[j] = c[j - 1] - x[i] * c[j];
    c[0] = d[i] - x[i] * c[0];
  }
  // Terms that are rounding alone.
  long double scale = largest;
  for (long double& term : c) {
    if (std::fabs(term) < 0x1p-52L * scale) term = 0;
    scale /= to - from;
  }
  const long double probe = (to - from) * 0.41L, square = probe * probe;
  const long double there = c[0] + c[1] * probe + c[2] * square + c[3] * square * probe;
  if (std::fabs(there - k(from + probe)) > 1e-15L * largest) throw std::invalid_argument("a kernel of degree above 3");
  return c;
}

// Of order j at a knot: (-1)^j times the jump, left minus right, of the j-th derivative.
struct Knot {
  long double x;
  Phase u;
  std::array<long double, kTerms> jump{};
};

class Rows {
 public:
  Rows(const Kernel& k, Phase down, Quad a, Quad beta, Quad alpha) : down_(down), a_(narrow(a)) {
    const auto knots = k.knots();
    for (const long double x : knots) knots_.push_back({x, {alpha, beta + a * widen(x)}, {}});
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      const std::array<long double, kTerms> c = polynomial(k, knots[i], knots[i + 1]);
      const long double h = knots[i + 1] - knots[i];
      const bool constant = c[1] == 0 && c[2] == 0 && c[3] == 0;
      for (std::size_t j = 0; j < kTerms; ++j)
        if (!constant && c[j] != 0) jump_error_[j] = k(0) * std::pow(h, -static_cast<long double>(j));
      long double left[kTerms] = {c[0], -c[1], 2 * c[2], -6 * c[3]};
      long double right[kTerms] = {c[0] + h * (c[1] + h * (c[2] + h * c[3])), -(c[1] + h * (2 * c[2] + 3 * h * c[3])),
                                   2 * c[2] + 6 * h * c[3], -6 * c[3]};
      for (std::size_t j = 0; j < kTerms; ++j) {
        knots_[i].jump[j] -= left[j];
        knots_[i + 1].jump[j] += right[j];
      }
    }
    // The oracle's kernels have a knot at 0 also where they are smooth.
    std::erase_if(knots_, [&](const Knot& knot) {
      return std::all_of(knot.jump.begin(), knot.jump.end(),
                         [&](long double j) { return std::fabs(j) < 1e-15L * k(0); });
    });
    for (const Knot& knot : knots_) require_integer(knot.u.beta);
    require_integer(down.beta);
  }

  // Where the kernel or a derivative jumps: between two of them it is one polynomial.
  std::vector<long double> knots() const {
    std::vector<long double> all;
    for (const Knot& knot : knots_) all.push_back(knot.x);
    return all;
  }

  // Integral over [from, infinity) of s(v) times the row's integral times weight(1/t) t^-2, the weight's powers of 1/t.
  Value beyond(Quad from, const std::array<long double, kTerms>& weight) const {
    std::vector<Quad> cut{from, from + widen(kPeriod)};
    const auto cut_at_lines = [&](const Phase& phase) {
      if (phase.beta == 0) return;
      const Quad begin = phase.at(from), end = phase.at(from + widen(kPeriod));
      for (Quad n = floor(min(begin, end)); n <= max(begin, end); n += 1) cut.push_back((n - phase.alpha) / phase.beta);
    };
    cut_at_lines(down_);
    for (const Knot& knot : knots_) cut_at_lines(knot.u);
    std::sort(cut.begin(), cut.end());
    const RulePair rules{Rule(8), Rule(12)};
    std::size_t orders = 1;
    for (std::size_t j = 0; j < kTerms; ++j)
      for (std::size_t m = 0; m < kTerms; ++m)
        if (weight[m] != 0 && std::any_of(knots_.begin(), knots_.end(), [&](const Knot& k) { return k.jump[j] != 0; }))
          orders = std::max(orders, j + m + 1);
    Value v;
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
      const Quad lo = max(cut[i], from), hi = min(cut[i + 1], from + widen(kPeriod));
      if (!(lo < hi)) continue;
      // Which squares the stretch is in, told by its middle, which is on no line.
      const Quad mid = (lo + hi) / 2;
      const long double v_sign = sign_of(floor(down_.at(mid)));
      std::vector<Quad> square;
      for (const Knot& knot : knots_) square.push_back(floor(knot.u.at(mid)));
      v += integrate(
          rules,
          [&](Quad t) {
            const std::array<long double, kTerms> along = row(t, square);
            const std::array<long double, kOrders> zeta = zetas(narrow(t), orders);
            return v_sign * weighed(along, weight, zeta);
          },
          lo, hi);
      // What the terms may be off by, the largest at the near end: some ten roundings each, and their factors' own.
      std::array<long double, kTerms> size{}, weight_size{};
      for (std::size_t j = 0; j < kTerms; ++j) {
        for (const Knot& knot : knots_)
          size[j] += (std::fabs(knot.jump[j]) + 64 * jump_error_[j]) * kLargest[j] *
                     std::pow(a_, -1.0L - static_cast<long double>(j));
        weight_size[j] = std::fabs(weight[j]) * (jump_error_[0] > 0 ? 64 : 1);
      }
      v.error += 0x1p-60L * narrow(hi - lo) * weighed(size, weight_size, zetas(narrow(lo), orders));
    }
    return v;
  }

 private:
  static void require_integer(Quad beta) {
    if (floor(beta) != beta) throw std::invalid_argument("no whole number of squares per period");
  }

  // The row's integral as coefficients of t^-1 ... t^-4.
  std::array<long double, kTerms> row(Quad t, const std::vector<Quad>& square) const {
    std::array<long double, kTerms> along{};
    for (std::size_t i = 0; i < knots_.size(); ++i) {
      const std::array<long double, kTerms> f = antiderivatives(narrow(knots_[i].u.at(t) - square[i]));
      long double scale = sign_of(square[i]) / a_;
      for (std::size_t j = 0; j < kTerms; ++j, scale /= a_) along[j] += knots_[i].jump[j] * f[j] * scale;
    }
    return along;
  }

  static long double weighed(const std::array<long double, kTerms>& along,
                             const std::array<long double, kTerms>& weight,
                             const std::array<long double, kOrders>& zeta) {
    long double sum = 0;
    for (std::size_t j = 0; j < kTerms; ++j)
      for (std::size_t m = 0; m < kTerms; ++m) sum += along[j] * weight[m] * zeta[j + m];
    return sum;
  }

  Phase down_;
  long double a_;
  // Jumps are found from four values to a few 2^-64 of them times up to 8 3! 4^3 / 6 for the third derivative, 2^-54 in
  // all; those of a constant exactly. In units of 2^-60.
  std::array<long double, kTerms> jump_error_{};
  std::vector<Knot> knots_;
};

// c in powers of y - from, y = (W - z) / w: the same in powers of W.
std::array<long double, kTerms> in_powers_of_w(const std::array<long double, kTerms>& c, Quad from, Quad w, Quad z) {
  std::array<Quad, kTerms> sum{};
  for (std::size_t i = kTerms; i-- > 0;) {
    for (std::size_t j = kTerms; j-- > 0;) sum[j] = (j > 0 ? sum[j - 1] / w : Quad(0)) - (z / w + from) * sum[j];
    sum[0] += widen(c[i]);
  }
  std::array<long double, kTerms> out{};
  for (std::size_t j = 0; j < kTerms; ++j) out[j] = narrow(sum[j]);
  return out;
}

}  // namespace

Value one_point(const Kernel& k, const Board& board, Pixel pixel) {
  const Quad cx = static_cast<Quad>(pixel.x) + Quad(1) / 2, cy = static_cast<Quad>(pixel.y) + Quad(1) / 2;
  const auto entry = [&](std::size_t i) { return widen(board.homography[i]); };
  if (entry(3) != 0 || entry(6) != 0 || !(entry(0) > 0) || !(entry(7) > 0) || std::isfinite(board.extent[0]))
    throw std::invalid_argument("a board without end in one-point perspective");
  // Around the pixel's centre: U = a x + b y + c, V = e y + d, W = w y + z.
  const Quad a = entry(0), b = entry(1), c = entry(2) + a * cx + b * cy, e = entry(4), d = entry(5) + e * cy;
  const Quad w = entry(7), z = entry(8) + w * cy;
  const Rows rows(k, {e / w, d - e * z / w}, a, c - b * z / w, b / w);
  Value v;
  const Quad horizon = -z / w;
  const std::vector<long double> knots = rows.knots();
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const Quad top = max(widen(knots[i]), horizon), bottom = widen(knots[i + 1]);
    if (!(top < bottom)) continue;
    const std::array<long double, kTerms> weight =
        in_powers_of_w(polynomial(k, knots[i], knots[i + 1]), widen(knots[i]), w, z);
    v += rows.beyond(1 / (w * bottom + z), weight);
    if (top > horizon) {
      const Value behind = rows.beyond(1 / (w * top + z), weight);
      v.value -= behind.value;
      v.error += behind.error;
    }
  }
  const long double radius = k.radius(), from = std::clamp(narrow(horizon), -radius, radius);
  const long double ground = k.over(from, radius), scale = narrow(1 / w);
  return {(ground + v.value * scale) / 2, (v.error * scale + 0x1p-60L * k.gain()) / 2};
}

}  // namespace moire::oracle
