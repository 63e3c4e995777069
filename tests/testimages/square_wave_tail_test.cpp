// Tails at the horizon against pieces between the board's lines, integrated one by one in extended precision.
#include "testimages/square_wave_tail.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "curve/quadrature.h"
#include "testimages/oscillating_tail.h"

namespace moire {
namespace {

using Long = long double;

// E_q on [0, 1), written out (Digital Library of Mathematical Functions, table 24.2.2, over q!).
Long polynomial(int q, Long x) {
  switch (q) {
    case 0:
      return 1;
    case 1:
      return x - 0.5L;
    case 2:
      return (x * x - x) / 2;
    case 3:
      return (x * x * x - 1.5L * x * x + 0.25L) / 6;
    case 4:
      return (x * x * x * x - 2 * x * x * x + x) / 24;
    default:
      return (x * x * x * x * x - 2.5L * x * x * x * x + 2.5L * x * x - 0.5L) / 120;
  }
}
// Its largest absolute value: at 1/2 or at 0.
Long sup(int q) { return std::max(std::fabs(polynomial(q, 0.5L)), std::fabs(polynomial(q, 0))); }

double simple_bound(int q, int p, const TailLine& line) {
  return static_cast<double>(sup(q)) * std::pow(line.T, 1 - p) / (p - 1);
}

Long parity(Long square) { return std::fmod(square, 2.0L) == 0 ? 1 : -1; }

// The integral from T to `end`. Pieces end at lines and where t has grown by a fifth, so that 8 nodes are exact to
// 1e-17.
Long by_pieces(int q, int p, const TailLine& line, Long end) {
  const Rule rule = gauss_legendre(8);
  const Long u = line.u, v = line.v, du = line.du, dv = line.dv, T = line.T;
  const auto first = [](Long x, Long slope) { return slope > 0 ? std::floor(x) + 1 : std::ceil(x) - 1; };
  const auto place = [&](Long k, Long x, Long slope) { return slope == 0 ? HUGE_VALL : T + (k - x) / slope; };
  Long ku = first(u, du), kv = first(v, dv), sum = 0, rest = 0;
  for (Long t = T; t < end;) {
    const Long next_u = place(ku, u, du), next_v = place(kv, v, dv);
    const Long to = std::max(t, std::min({next_u, next_v, end, 1.2L * t}));
    const Long half = (to - t) / 2, mid = (to + t) / 2;
    const Long square_u = std::floor(u + du * (mid - T)), square_v = std::floor(v + dv * (mid - T));
    Long piece = 0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const Long at = mid + half * static_cast<Long>(rule.node[i]);
      Long power = 1;
      for (int j = 0; j < p; ++j) power *= at;
      piece += static_cast<Long>(rule.weight[i]) * polynomial(q, u + du * (at - T) - square_u) / power;
    }
    const Long x = parity(square_u) * parity(square_v) * half * piece - rest, next = sum + x;
    rest = (next - sum) - x;
    sum = next;
    if (to == next_u) ku += du > 0 ? 1 : -1;
    if (to == next_v) kv += dv > 0 ? 1 : -1;
    t = to;
  }
  return sum;
}

// The same line from t = n T on. Its phases are rounded to doubles, 2^-53 of numbers below 2; the extended precision
// that they come from is right to 2^-62 of the lines passed, below 2^17.
TailLine later(const TailLine& line, double n) {
  TailLine out = line;
  out.T = n * line.T;
  const Long by = static_cast<Long>(out.T) - line.T;
  out.u = static_cast<double>(std::fmod(line.u + line.du * by, 2.0L));
  out.v = static_cast<double>(std::fmod(line.v + line.dv * by, 2.0L));
  out.u_error = out.v_error = 0x1.1p-52;
  return out;
}

// Rounding of the sums by pieces, as a share of the simple bound: nodes and weights are doubles.
constexpr double kPieces = 4e-16;

// The tail at T, less that at n T, against the pieces in between. The far one is bounded 100 times better, so that an
// error of the near one cannot hide there; that they do not err together is for the next function.
void check_between(int q, int p, const TailLine& line, double share, double n) {
  const double simple = simple_bound(q, p, line);
  const Tail near = square_wave_tail(q, p, line, share * simple),
             far = square_wave_tail(q, p, later(line, n), 0.01 * share * simple);
  const Long truth = by_pieces(q, p, line, n * line.T);
  CAPTURE(q);
  CAPTURE(p);
  CAPTURE(line.T);
  CAPTURE(line.u);
  CAPTURE(line.v);
  CAPTURE(line.du);
  CAPTURE(line.dv);
  CHECK(std::fabs(static_cast<double>(near.value - far.value - truth)) <= near.bound + far.bound + kPieces * simple);
  CHECK(near.bound <= simple * (1 + 1e-12));
}

void check_absolute(int q, int p, const TailLine& line, double n) {
  const double simple = simple_bound(q, p, line);
  const Tail tail = square_wave_tail(q, p, line, 1e-9 * simple);
  const Long truth = by_pieces(q, p, line, n * line.T);
  CHECK(std::fabs(static_cast<double>(tail.value - truth)) <=
        tail.bound + simple * (std::pow(n, 1 - p) * (1 + 1e-12) + kPieces));
}

// Slopes whose larger one passes `lines` lines while t doubles; ratio = dv / du.
TailLine line_of(double lines, double ratio, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit;
  TailLine out{};
  out.T = 0.01 + 10 * unit(random);
  const double slope = lines / out.T * (unit(random) < 0.5 ? 1 : -1);
  out.du = std::fabs(ratio) > 1 ? slope / ratio : slope;
  out.dv = out.du * ratio;
  out.u = 2 * unit(random);
  out.v = 2 * unit(random);
  return out;
}

// Every kind of ratio that a pixel column may have.
double some_ratio(int kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit;
  constexpr double kOdd[] = {1, 3, 5, 7, 9, 15};
  const auto odd = [&] { return kOdd[random() % std::size(kOdd)]; };
  const double sign = unit(random) < 0.5 ? 1 : -1;
  switch (kind % 6) {
    case 0:
      return sign * odd() / odd();  // resonant
    case 1:
      return sign * odd() / odd() * (1 + std::pow(10.0, -12 + 9 * unit(random)));  // nearly
    case 2:
      return sign * odd() / (1 + odd());  // an even number and an odd one
    case 3:
      return sign * std::pow(10.0, -12 + 24 * unit(random));  // very unequal
    case 4:
      return sign * (1 + 1e-15 * static_cast<double>(random() % 8));
    default:
      return sign * std::exp(4 * unit(random) - 2);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("oscillating tails are means of 1 / (s - i omega)") {
    // The mean over s of weight s^(p-1) e^-s / (p-1)!, by Gauss-Legendre on short pieces; beyond s = 90 there is less
    // than 1e-25 of it. Near s = 0 pieces shrink towards the pole at i omega.
    const Rule rule = gauss_legendre(16);
    for (const int p : {2, 3, 4, 7}) {
      for (double omega = 0.02; omega < 400; omega *= 1.37) {
        Long re = 0, im = 0, factorial = 1;
        for (int j = 2; j < p; ++j) factorial *= j;
        for (Long from = 0, to = 0; from < 90; from = to) {
          to = from + std::min(1.0L, 0.5L * (omega + from));
          const Long half = (to - from) / 2, mid = (to + from) / 2;
          for (std::size_t i = 0; i < rule.node.size(); ++i) {
            const Long s = mid + half * static_cast<Long>(rule.node[i]);
            const Long weight = static_cast<Long>(rule.weight[i]) * half * std::pow(s, static_cast<Long>(p - 1)) *
                                std::exp(-s) / factorial / (s * s + static_cast<Long>(omega) * omega);
            re += weight * s;
            im += weight * omega;
          }
        }
        for (const double sign : {1.0, -1.0}) {
          const OscillatingTail tail = oscillating_tail(p, sign * omega);
          CAPTURE(p);
          CAPTURE(omega);
          // 1e-16 of the result for the nodes and weights.
          CHECK(std::hypot(static_cast<double>(tail.re - re), static_cast<double>(tail.im - sign * im)) <=
                tail.error + 1e-16 * std::min(1.0 / (p - 1), 1 / omega));
          CHECK(tail.error <= 1e-12 / omega);
        }
      }
    }
  }

  TEST_CASE("tails at the horizon are right within their bound for every kind of ratio of slopes") {
    std::mt19937_64 random(4711);
    std::uniform_real_distribution<double> unit;
    for (int n = 0; n < 2000; ++n) {
      const double lines = std::exp(std::log(2500.0) * unit(random));
      const int q = 1 + static_cast<int>(random() % 5), p = 2 + static_cast<int>(random() % 4);
      check_between(q, p, line_of(lines, some_ratio(n, random), random), std::pow(10.0, -4 - 10 * unit(random)), 3);
    }
  }

  TEST_CASE("tails of tens of thousands of lines are right within their bound") {
    std::mt19937_64 random(4712);
    for (int n = 0; n < 24; ++n) {
      check_between(1 + n / 6 % 2, 3, line_of(30000, some_ratio(n, random), random), n < 12 ? 1e-9 : 1e-12, 2);
    }
  }

  TEST_CASE("a coordinate that stands still is no trouble") {
    std::mt19937_64 random(4714);
    for (const double lines : {0.01, 1.0, 40.0, 1000.0}) {
      for (int q = 1; q <= 4; ++q) {
        TailLine line = line_of(lines, 1, random);
        line.dv = 0;
        check_between(q, 3, line, 1e-9, 5);
        std::swap(line.du, line.dv);
        check_between(q, 3, line, 1e-9, 5);
      }
    }
    // Both: a constant times the integral of t^-p. At integers the squares are half-open.
    for (const double v : {0.0, 0.3, 1.0, 1.7}) {
      const Tail tail = square_wave_tail(1, 3, {.T = 2, .u = 0.25, .v = v, .du = 0, .dv = 0}, 0);
      CHECK(std::fabs(tail.value - (v < 1 ? -0.25 : 0.25) / 8) <= tail.bound);
      CHECK(tail.bound <= 1e-14);
    }
  }

  TEST_CASE("the bound of a tail reaches any sensible goal, whatever the slopes") {
    std::mt19937_64 random(4715);
    std::uniform_real_distribution<double> unit;
    for (int n = 0; n < 600; ++n) {
      const TailLine line = line_of(std::exp(std::log(50000.0) * unit(random)), some_ratio(n, random), random);
      for (const double share : {1e-5, 1e-8}) {
        const double goal = share * simple_bound(1, 3, line);
        CHECK(square_wave_tail(1, 3, line, goal).bound <= goal);
      }
    }
  }

  TEST_CASE("no bound of a tail is above the simple one") {
    const TailLine line{.T = 3, .u = 0.3, .v = 0.9, .du = 400, .dv = 123.4};
    CHECK(square_wave_tail(1, 3, line, 1).bound == doctest::Approx(simple_bound(1, 3, line)));
    TailLine vague = line;
    vague.v_error = 0.6;
    CHECK(square_wave_tail(1, 3, vague, 0).bound <= simple_bound(1, 3, line) * (1 + 1e-12));
    CHECK(square_wave_tail(40, 3, line, 0).bound > 0);
    CHECK(square_wave_tail(40, 3, line, 0).bound < 1e-18);
    TailLine infinite = line;
    infinite.du = HUGE_VAL;
    CHECK(square_wave_tail(1, 3, infinite, 0).bound <= simple_bound(1, 3, line) * (1 + 1e-12));
  }

  TEST_CASE("lines within the errors of a tail's line stay within its bound") {
    std::mt19937_64 random(4716);
    std::uniform_real_distribution<double> unit;
    const auto either = [&] { return 2 * unit(random) - 1; };
    for (int n = 0; n < 500; ++n) {
      const int q = 1 + n % 3, p = 2 + n % 4;
      TailLine line = line_of(std::exp(std::log(3000.0) * unit(random)), some_ratio(n, random), random);
      if (n % 50 == 0) line.v = 1;  // on a line
      line.u_error = std::pow(10.0, -3 - 10 * unit(random));
      line.v_error = std::pow(10.0, -3 - 10 * unit(random));
      line.du_error = std::fabs(line.du) * std::pow(10.0, -6 - 10 * unit(random));
      line.dv_error = std::fabs(line.dv) * std::pow(10.0, -6 - 10 * unit(random));
      const double simple = simple_bound(q, p, line);
      const Tail vague = square_wave_tail(q, p, line, 1e-7 * simple);
      for (const double far : {1.0, 0.0}) {  // at the ends of what is allowed, and anywhere
        const auto by = [&] { return far > 0 ? (either() < 0 ? -1.0 : 1.0) : either(); };
        TailLine other{line.T, line.u + by() * line.u_error, line.v + by() * line.v_error,
                       line.du + by() * line.du_error, line.dv + by() * line.dv_error};
        const Tail sharp = square_wave_tail(q, p, other, 1e-7 * simple);
        CHECK(std::fabs(vague.value - sharp.value) <= vague.bound + sharp.bound);
      }
    }
  }

  TEST_CASE("tails are antiperiodic in both coordinates and know mirror images") {
    std::mt19937_64 random(4717);
    for (int n = 0; n < 60; ++n) {
      const int q = 1 + n % 4;
      const TailLine line = line_of(1000, some_ratio(n, random), random);
      const double simple = simple_bound(q, 3, line), goal = 1e-9 * simple;
      const Tail tail = square_wave_tail(q, 3, line, goal);
      const auto agrees = [&](const TailLine& other, double sign) {
        const Tail image = square_wave_tail(q, 3, other, goal);
        // Rounding of the phases given: 2^-52 each, to which v's jumps answer by twice as much.
        return std::fabs(image.value - sign * tail.value) <= tail.bound + image.bound + 1e-14 * simple;
      };
      TailLine other = line;
      other.u += 1;
      CHECK(agrees(other, -1));
      other.v -= 3;
      CHECK(agrees(other, 1));
      other = line;
      other.v = -other.v, other.dv = -other.dv;
      CHECK(agrees(other, -1));
      other.u = -other.u, other.du = -other.du;
      CHECK(agrees(other, q % 2 == 0 ? 1 : -1));
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("tails and pieces agree up to what is left beyond the last piece") {
    std::mt19937_64 random(4713);
    for (int n = 0; n < 48; ++n) check_absolute(1 + n % 3, 3, line_of(100, some_ratio(n, random), random), 1000);
    for (int n = 0; n < 12; ++n) check_absolute(1, 3, line_of(3000, some_ratio(n, random), random), 100);
  }
}

}  // namespace
}  // namespace moire
