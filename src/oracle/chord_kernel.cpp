// Antiderivatives along chords, and Boole's summation at their ends; see chord_kernel.h.
#include "oracle/chord_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace moire::oracle {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

// 1 on even squares, -1 on odd ones.
long double sign_of(long double whole) { return whole - 2 * std::floor(whole / 2) < 0.5L ? 1 : -1; }

// k between two breaks as powers of r, from four values; nothing where it is no cubic.
std::optional<std::array<long double, 4>> cubic(const RingKernel& k, long double from, long double to) {
  std::array<long double, 4> x{}, d{}, c{};
  for (std::size_t i = 0; i < 4; ++i) {
    x[i] = from + (to - from) * (2 * static_cast<long double>(i) + 1) / 8;
    d[i] = k(x[i]);
  }
  for (std::size_t order = 1; order < 4; ++order)
    for (std::size_t i = 4; i-- > order;) d[i] = (d[i] - d[i - 1]) / (x[i] - x[i - order]);
  for (std::size_t i = 4; i-- > 0;) {
    for (std::size_t j = 4; j-- > 1;) c[j] = c[j - 1] - x[i] * c[j];
    c[0] = d[i] - x[i] * c[0];
  }
  // What is rounding alone must not be taken for a cusp.
  const long double largest = std::fabs(k(0));
  long double scale = largest;
  for (long double& term : c) {
    if (std::fabs(term) < 1e-16L * scale) term = 0;
    scale /= to;
  }
  for (const long double share : {0.03L, 0.41L, 0.97L}) {
    const long double r = from + share * (to - from);
    if (std::fabs(c[0] + r * (c[1] + r * (c[2] + r * c[3])) - k(r)) > 1e-16L * largest) return {};
  }
  return c;
}

// Derivatives of (r^2)^(p/2) by r^2 over factorials: binomial(p/2, n) r^(p - 2n).
template <std::size_t n>
std::array<long double, n> power_taylor(const std::array<long double, 4>& c, long double r) {
  std::array<long double, n> sum{};
  for (std::size_t p = 0; p < 4; ++p) {
    const long double half = static_cast<long double>(p) / 2;
    long double term = c[p] * std::pow(r, static_cast<long double>(p));
    for (std::size_t i = 0; i < n; ++i) {
      sum[i] += term;
      term *= (half - static_cast<long double>(i)) / (static_cast<long double>(i + 1) * r * r);
    }
  }
  return sum;
}

// Euler polynomials over factorials, E_1 ... E_n, as powers of u - 1/2; E_j' = E_(j-1) and E_j(1) = -E_j(0).
template <std::size_t n>
constexpr std::array<std::array<long double, n + 1>, n + 1> euler_table() {
  std::array<std::array<long double, n + 1>, n + 1> e{};
  e[0][0] = 1;
  for (std::size_t j = 1; j <= n; ++j) {
    long double at_half = 0, power = 0.5L;
    for (std::size_t i = 1; i <= j; ++i, power /= 2) {
      e[j][i] = e[j - 1][i - 1] / static_cast<long double>(i);
      if (i % 2 == 0) at_half += e[j][i] * power;
    }
    if (j % 2 == 0) e[j][0] = -at_half;  // even polynomials vanish at both ends
  }
  return e;
}

// E_1 ... E_orders at u.
template <std::size_t n>
void euler(long double u, std::size_t orders, std::array<long double, n + 1>& out) {
  static constexpr auto kTable = euler_table<n>();
  const long double whole = std::floor(u), x = u - whole - 0.5L, square = x * x, sign = sign_of(whole);
  for (std::size_t j = 1; j <= orders; ++j) {
    long double sum = 0;
    for (std::size_t i = j + 2; i >= 2;) {
      i -= 2;
      sum = sum * square + kTable[j][i];
    }
    out[j] = sign * (j % 2 == 0 ? sum : sum * x);
  }
}

}  // namespace

ChordKernel::ChordKernel(std::string_view text) : rings_(text) {
  const std::vector<long double>& breaks = rings_.breaks();
  cubic_ = true;
  for (std::size_t i = 0; i + 1 < breaks.size() && cubic_; ++i) {
    const auto c = cubic(rings_, breaks[i], breaks[i + 1]);
    if (c) pieces_.push_back(*c);
    cubic_ = c.has_value();
  }
  if (cubic_) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const long double r = breaks[i + 1];
      const Taylor outside = i + 1 < pieces_.size() ? power_taylor<kOrders>(pieces_[i + 1], r) : Taylor{};
      add_circle(r, power_taylor<kOrders>(pieces_[i], r), outside);
    }
  } else {
    pieces_.clear();
    fit_even();
    add_circle(rings_.radius(), even_taylor(), {});
  }
  choose_rates();
}

std::vector<long double> ChordKernel::circles() const {
  std::vector<long double> all;
  for (const Circle& c : circles_) all.push_back(c.radius);
  return all;
}

void ChordKernel::fit_even() {
  constexpr std::size_t kNodes = 64;
  const long double square = rings_.radius() * rings_.radius();
  const auto node = [](std::size_t i) { return kPi * (static_cast<long double>(i) + 0.5L) / kNodes; };
  std::array<long double, kNodes> value{};
  for (std::size_t i = 0; i < kNodes; ++i) value[i] = rings_(std::sqrt(square * (1 + std::cos(node(i))) / 2));
  for (std::size_t k = 0; k < kNodes; ++k) {
    long double sum = 0;
    for (std::size_t i = 0; i < kNodes; ++i) sum += value[i] * std::cos(static_cast<long double>(k) * node(i));
    even_.push_back(sum * (k == 0 ? 1 : 2) / kNodes);
  }
  const long double least = 1e-18L * std::fabs(rings_(0));
  while (even_.size() > 1 && std::fabs(even_.back()) < least) even_.pop_back();
  if (even_.size() > kNodes - 8) throw std::invalid_argument("a kernel that is no function of r^2");
  const std::size_t n = even_.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      cosines_.push_back(std::cos(static_cast<long double>(k * (2 * j + 1)) * kPi / static_cast<long double>(2 * n)));
}

long double ChordKernel::even_at(long double square) const {
  const long double x = 2 * square / (radius() * radius()) - 1;
  long double b0 = 0, b1 = 0;
  for (std::size_t k = even_.size(); k-- > 0;) {
    const long double next = even_[k] + 2 * x * b0 - b1;
    b1 = b0;
    b0 = next;
  }
  return b0 - x * b1;
}

// At the rim, where T_k has the n-th derivative k^2 (k^2 - 1) ... (k^2 - (n-1)^2) / (1 3 ... (2n-1)).
ChordKernel::Taylor ChordKernel::even_taylor() const {
  Taylor sum{};
  const long double scale = 2 / (rings_.radius() * rings_.radius());
  for (std::size_t k = 0; k < even_.size(); ++k) {
    long double term = even_[k];
    for (std::size_t n = 0; n < kOrders; ++n) {
      sum[n] += term;
      const auto order = static_cast<long double>(n), degree = static_cast<long double>(k);
      term *= scale * (degree * degree - order * order) / ((2 * order + 1) * (order + 1));
    }
  }
  return sum;
}

// With r^2 = radius^2 + 2 h eta + eta^2 at x = h + eta.
void ChordKernel::add_circle(long double radius, const Taylor& inside, const Taylor& outside) {
  Circle c{radius, {}};
  long double factorial = 1;
  for (std::size_t j = 0; j < kOrders; ++j) {
    if (j > 0) factorial *= static_cast<long double>(j);
    for (std::size_t n = (j + 1) / 2; n <= j; ++n) {
      long double choose = 1;  // binomial(n, j - n)
      for (std::size_t i = 0; i < j - n; ++i)
        choose *= static_cast<long double>(n - i) / static_cast<long double>(i + 1);
      const std::size_t power = 2 * n - j;
      c.jump[j][power] =
          factorial * choose * std::pow(2.0L, static_cast<long double>(power)) * (inside[n] - outside[n]);
    }
  }
  circles_.push_back(c);
}

// |E_j| <= 4 / pi^(j+1), so that order j is at most 2 times that, times the (j-1)-th derivative, times rate^-j.
void ChordKernel::choose_rates() {
  constexpr long double kBelow = 1e-14L;
  const long double largest = std::fabs(rings_(0));
  for (std::size_t j = 1; j <= kOrders; ++j) {
    long double size = 0;
    for (const Circle& c : circles_)
      for (std::size_t i = 0; i < kOrders; ++i)
        size += std::fabs(c.jump[j - 1][i]) * std::pow(c.radius, static_cast<long double>(i));
    size *= 8 / std::pow(kPi, static_cast<long double>(j + 1));
    rate_for_[j] = std::pow(size / (kBelow * largest), 1 / static_cast<long double>(j));
  }
  for (std::size_t j = kOrders; j-- > 1;) rate_for_[j] = std::max(rate_for_[j], rate_for_[j + 1]);
  // The last orders, down to 10 times that, say what is missing. Branch points of a cusp are left out where they are 12
  // squares away, e^(-12 pi) = 4e-17, and must be so wherever the centre's piece ends.
  least_rate_ = std::max(rate_for_[kOrders], 2 / radius());
  if (has_cusp()) least_rate_ = std::max(least_rate_, 12 / circles_.front().radius);
}

void ChordKernel::integrate_even(long double y, long double half, std::vector<long double>& odd) const {
  const std::size_t n = even_.size();
  std::vector<long double> value(n), even(n);
  for (std::size_t j = 0; j < n; ++j) {
    // T_2 at the node is cosines_[n + j]: x^2 = half^2 (1 + T_2) / 2.
    const long double t2 = n > 1 ? cosines_[n + j] : 0;
    value[j] = even_at(y * y + half * half * (1 + t2) / 2);
  }
  for (std::size_t k = 0; k < n; ++k) {
    long double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += value[j] * cosines_[k * n + j];
    even[k] = sum * (k == 0 ? 1 : 2) / static_cast<long double>(n);
  }
  odd.assign(n, 0);
  odd[0] = half * even[0];
  for (std::size_t k = 1; k < n; ++k) {
    const auto degree = static_cast<long double>(2 * k);
    odd[k] += half * even[k] / (2 * (degree + 1));
    odd[k - 1] -= half * even[k] / (2 * (degree - 1));
  }
}

// Of r^0 ... r^3 by the reduction (n + 1) I_n = x r^n + n y^2 I_(n-2), I_-1 = arsinh(x / |y|).
long double ChordKernel::cubic_integral(long double y, long double x, std::size_t piece) const {
  const std::array<long double, 4>& c = pieces_[piece];
  const long double y2 = y * y, r2 = x * x + y2;
  long double sum = x * (c[0] + c[2] * (x * x / 3 + y2));
  if (c[1] == 0 && c[3] == 0) return sum;
  const long double r = std::sqrt(r2);
  const long double first = (x * r + (y2 > 0 ? y2 * std::asinh(x / std::fabs(y)) : 0)) / 2;
  sum += c[1] * first + c[3] * (x * r * r2 + 3 * y2 * first) / 4;
  return sum;
}

long double ChordKernel::wave_by_wave(long double y, const ChordWave& wave) const {
  const long double half = std::sqrt(std::max(0.0L, (radius() - y) * (radius() + y)));
  if (half == 0) return 0;
  std::vector<long double> odd;
  struct Part {
    std::size_t piece;
    long double end, shift;  // |x| up to there; what makes the antiderivative continuous
  };
  std::vector<Part> parts;
  if (cubic_) {
    long double before = 0, sum = 0;  // |x|, and the antiderivative there
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const long double r = circles_[i].radius;
      if (r <= std::fabs(y)) continue;
      const long double end = std::sqrt((r - y) * (r + y)), shift = sum - cubic_integral(y, before, i);
      parts.push_back({i, end, shift});
      sum = shift + cubic_integral(y, end, i);
      before = end;
    }
    parts.back().end = half;
  } else {
    integrate_even(y, half, odd);
  }
  const auto integral = [&](long double x) {
    if (!cubic_) {
      const long double s = x / half, t2 = 2 * s * s - 1;
      long double b0 = 0, b1 = 0;
      for (std::size_t k = odd.size(); k-- > 0;) {
        const long double next = odd[k] + 2 * t2 * b0 - b1;
        b1 = b0;
        b0 = next;
      }
      return s * (b0 - b1);
    }
    const long double side = std::min(std::fabs(x), half);
    std::size_t i = 0;
    while (side > parts[i].end) ++i;
    const long double sum = parts[i].shift + cubic_integral(y, side, parts[i].piece);
    return x < 0 ? -sum : sum;
  };
  const long double from = wave.at(-half), to = wave.at(half);
  long double line = std::floor(from) + 1, sign = sign_of(line - 1);
  const long double end = integral(half);
  long double sum = sign * end;  // minus the antiderivative at -half, which is odd
  for (; line < to; line += 1, sign = -sign) sum += 2 * sign * integral((line - wave.phase) / wave.rate);
  return sum + sign * end;
}

long double ChordKernel::by_ends(long double y, const ChordWave& wave) const {
  std::size_t orders = 1;
  while (orders < kOrders && wave.rate < rate_for_[orders + 1]) ++orders;
  std::array<long double, kOrders + 1> right{}, left{};
  long double sum = 0;
  for (const Circle& c : circles_) {
    if (c.radius <= std::fabs(y)) continue;
    const long double h = std::sqrt((c.radius - y) * (c.radius + y)), h2 = h * h;
    euler<kOrders>(wave.at(h), orders, right);
    euler<kOrders>(wave.at(-h), orders, left);
    long double power = 1 / wave.rate;
    for (std::size_t j = 0; j < orders; ++j, power /= wave.rate) {
      long double slope = 0;
      for (std::size_t i = j + 2; i >= 2;) {
        i -= 2;
        slope = slope * h2 + c.jump[j][i];
      }
      // By parts the sign of order j is (-1)^j; on the left an odd derivative changes its own, too.
      sum +=
          j % 2 == 0 ? power * slope * (right[j + 1] - left[j + 1]) : -power * slope * h * (right[j + 1] + left[j + 1]);
    }
  }
  if (has_cusp()) sum += cusp(y, wave);
  return sum;
}

// s(u) is the sum over odd m of 4 / (pi m) sin(pi m u); the transforms of r and r^3 over the line at w = pi m rate are
// -2 |y| K_1(w |y|) / w and 6 y^2 K_2(w |y|) / w^2. K_n(z) is the integral of exp(-z cosh s) cosh(n s) over s > 0, by
// the trapezium rule, whose error is exp(-pi^2 / step).
long double ChordKernel::cusp(long double y, const ChordWave& wave) const {
  if (std::fabs(y) >= circles_.front().radius) return 0;
  // Next to y = 0 the value at the limit: what is off is y^2, over 1e-5 squares.
  const long double distance = std::max(std::fabs(y), 1e-5L / wave.rate), z = kPi * wave.rate * distance;
  if (z > 12 * kPi) return 0;
  constexpr long double kStep = 0.3L, kGone = 40;  // exp(-pi^2 / 0.3) = 5e-15, exp(-40) = 4e-18
  struct Term {
    long double power, factor, first, second;
  };
  std::vector<Term> terms;
  for (long double s = 0; z * std::cosh(s) < kGone; s += kStep) {
    const long double c = std::cosh(s), e = std::exp(-z * c), weight = s == 0 ? kStep / 2 : kStep;
    terms.push_back({e, e * e, weight * c, weight * (2 * c * c - 1)});
  }
  // Where z is small the terms fall like m^-3 and what is left out is 1 / (2 kMost^2) of them; there |y| is small, too.
  constexpr long double kMost = 2001;
  const long double sine = std::sin(kPi * wave.phase), turn = 2 * std::cos(2 * kPi * wave.phase);
  long double wave_now = sine, wave_before = -sine, sum = 0;
  for (long double m = 1; m <= kMost && m * z < kGone; m += 2) {
    long double k1 = 0, k2 = 0;
    for (Term& t : terms) {
      k1 += t.power * t.first;
      k2 += t.power * t.second;
      t.power *= t.factor;
    }
    while (!terms.empty() && terms.back().power < 1e-18L) terms.pop_back();
    const long double w = kPi * m * wave.rate, share = distance / w;
    sum += 4 / (kPi * m) * wave_now * (-2 * pieces_[0][1] * share * k1 + 6 * pieces_[0][3] * share * share * k2);
    const long double next = turn * wave_now - wave_before;
    wave_before = wave_now;
    wave_now = next;
  }
  return sum;
}

}  // namespace moire::oracle
