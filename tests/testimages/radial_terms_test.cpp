// The g_j of radial weights and their bounds: against the recursion that defines them, in exact polynomials, and
// against Taylor series along the flow, in 34 digits.
#include "testimages/radial_terms.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/random_scenes.h"
#include "filter_list.h"
#include "oracle/quad.h"
#include "testimages/radial_jets.h"

namespace moire {
namespace {

using oracle::Quad;
using test::Flow;
using test::Jet;
using test::SeenFilter;
using Row = LocalHomography::Row;
using Complex = std::complex<long double>;

// Products of small numbers may lose all their digits.
constexpr double kUnderflow = 1e-300;

// Three rows around a pixel: W as given at the centre, squares of about `size` pixels there, e from none to far above
// 1 / size.
struct View {
  Row u, v, w;
  double deepest;
};
View random_view(Draw& draw) {
  const double size = draw.log_uniform(1e-3, 0.5), w = draw.log_uniform(0.01, 10), angle = draw.uniform(0, 7);
  const auto row = [&](double slope, double c) {
    const double turn = draw.uniform(0, 7);
    return Row{slope * std::cos(turn), slope * std::sin(turn), Dd(c, draw.uniform(-1, 1) * 0x1p-54 * c), 0};
  };
  double tilt = 0;  // slope of W over W
  switch (draw.integer(0, 3)) {
    case 0:
      tilt = 0;
      break;
    case 1:
      tilt = draw.log_uniform(1e-14, 1e-6);
      break;
    case 2:
      tilt = draw.log_uniform(1e-2, 1);
      break;
    default:
      tilt = draw.log_uniform(1, 30);
  }
  View view{row(w / size, draw.uniform(-1, 1) * draw.log_uniform(0.1, 1e3)),
            row(w / size * draw.log_uniform(0.1, 10), draw.uniform(-1, 1) * draw.log_uniform(0.1, 1e3)),
            {w * tilt * std::cos(angle), w * tilt * std::sin(angle), Dd(w), 0},
            w * draw.log_uniform(0.1, 2)};
  // Lines of constant v along those of constant W: then e is 0, and W is no matter.
  if (tilt > 0 && draw.integer(0, 4) == 0) {
    const double along = draw.uniform(-2, 2);
    view.v = {along * view.w.a, along * view.w.b, Dd(draw.uniform(1, 2)), 0};
  }
  return view;
}

bool usable(const View& view) { return BoardFrame(view.u, view.v, view.w).valid(); }

Vec2 at_angle(double r, double angle) { return {r * std::cos(angle), r * std::sin(angle)}; }
Quad distance(Vec2 p) { return oracle::sqrt(Quad(p.x) * Quad(p.x) + Quad(p.y) * Quad(p.y)); }
double size_of(Quad x) { return static_cast<double>(oracle::abs(x)); }

// A piece of which nothing is rounded: on [0, 2], with t = r - 1.
struct WholePiece {
  std::vector<double> even, series;  // coefficients of r^(2 i), of T_i(t)
  PieceWeight piece() const { return {0, 2, series, 1, 0}; }
};
WholePiece random_even(Draw& draw) {
  WholePiece out;
  const auto degree = static_cast<std::size_t>(draw.integer(0, 4));
  for (std::size_t i = 0; i <= degree; ++i) out.even.push_back(static_cast<double>(draw.integer(-8, 8)) / 8);
  // Powers of t, then x t^i in Chebyshev polynomials, by T_1 T_n = (T_(n+1) + T_(n-1)) / 2: all dyadic.
  std::vector<double> power{1};  // (1 + t)^(2 i)
  std::vector<double> of_t(2 * degree + 1);
  for (std::size_t i = 0; i <= degree; ++i) {
    for (std::size_t n = 0; n < power.size(); ++n) of_t[n] += out.even[i] * power[n];
    for (int twice = 0; twice < 2; ++twice) {
      power.push_back(0);
      for (std::size_t n = power.size() - 1; n > 0; --n) power[n] += power[n - 1];
    }
  }
  out.series.assign(of_t.size(), 0);
  std::vector<double> chebyshev{1};
  for (const double c : of_t) {
    for (std::size_t n = 0; n < chebyshev.size(); ++n) out.series[n] += c * chebyshev[n];
    std::vector<double> next(chebyshev.size() + 1);
    for (std::size_t n = 0; n < chebyshev.size(); ++n) {
      next[n + 1] += n == 0 ? chebyshev[n] : chebyshev[n] / 2;
      if (n > 0) next[n - 1] += chebyshev[n] / 2;
    }
    chebyshev = next;
  }
  return out;
}

// Polynomials in x and y: exponents to coefficients.
using Polynomial = std::map<std::pair<int, int>, Quad>;

// (3 + j) e g - ((G - e p) . grad) g.
Polynomial next_term(const Polynomial& g, int j, const Flow& flow) {
  Polynomial out;
  for (const auto& [power, c] : g) {
    const auto [m, n] = power;
    out[power] += (3 + j + m + n) * flow.e * c;
    if (m > 0) out[{m - 1, n}] -= flow.gx * m * c;
    if (n > 0) out[{m, n - 1}] -= flow.gy * n * c;
  }
  return out;
}
Quad value_of(const Polynomial& g, Vec2 p) {
  Quad sum = 0;
  for (const auto& [power, c] : g) {
    Quad term = c;
    for (int i = 0; i < power.first; ++i) term *= Quad(p.x);
    for (int i = 0; i < power.second; ++i) term *= Quad(p.y);
    sum += term;
  }
  return sum;
}

// Every piece of every radial filter.
std::vector<std::pair<std::string, std::size_t>> all_pieces(std::map<std::string, SeenFilter>& seen) {
  std::vector<std::pair<std::string, std::size_t>> out;
  for (const std::string& text : test::radial_texts()) {
    const auto at = seen.try_emplace(text, text).first;
    for (std::size_t i = 0; i < at->second.weight.pieces.size(); ++i) out.emplace_back(text, i);
  }
  return out;
}

// low <= high inside a piece, as rings and sides have them: from well inside to its ends.
std::pair<double, double> random_ring(Draw& draw, const PieceWeight& piece) {
  const double least = std::max(piece.low, piece.high / 64);
  const double low = draw.coin() ? least * std::pow(piece.high / least, draw.uniform(0, 1)) : least;
  return {low, std::min(piece.high, low * (draw.coin() ? 1.0 : draw.uniform(1, 2)))};
}

// The largest |g_j| found in the ring in long double, which is exact to kNoise of what terms of all signs come to.
std::array<double, test::kJet> largest_in(const Flow& flow, const PieceWeight& piece, double low, double high) {
  std::array<double, test::kJet> most{};
  for (const double r : {low, 0.5 * (low + high), high}) {
    for (int turn = 0; turn < 24; ++turn) {
      const Vec2 p = at_angle(r, turn * std::numbers::pi / 12);
      const long double x = static_cast<long double>(p.x), y = static_cast<long double>(p.y);
      const Jet<long double> g = test::flow_terms<long double>(flow, piece, x, y, std::sqrt(x * x + y * y));
      for (std::size_t j = 0; j < g.size(); ++j) most[j] = std::max(most[j], static_cast<double>(std::fabs(g[j])));
    }
  }
  return most;
}
constexpr double kNoise = 1e-15;

// The same at points of the ring displaced by a complex multiple of real directions.
std::array<double, test::kJet> largest_beside(const Flow& flow, const PieceWeight& piece, double low, double high,
                                              Complex by) {
  std::array<double, test::kJet> most{};
  for (const double r : {low, high}) {
    for (int turn = 0; turn < 6; ++turn) {
      const Vec2 p = at_angle(r, turn * std::numbers::pi / 3);
      for (const int way : {0, 1, 3}) {  // radial, oblique, along the circle
        const Vec2 d = at_angle(1, (2 * turn + way) * std::numbers::pi / 6);
        const Complex x = static_cast<long double>(p.x) + by * static_cast<long double>(d.x),
                      y = static_cast<long double>(p.y) + by * static_cast<long double>(d.y);
        const Jet<Complex> g = test::flow_terms<Complex>(flow, piece, x, y, std::sqrt(x * x + y * y));
        for (std::size_t j = 0; j < g.size(); ++j) most[j] = std::max(most[j], static_cast<double>(std::abs(g[j])));
      }
    }
  }
  return most;
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("terms of polynomials in r^2 are those of the recursion in exact polynomials, within their errors") {
    Draw draw(101);
    double worst = 0;
    int cases = 0;
    while (cases < 60) {
      const View view = random_view(draw);
      if (!usable(view)) continue;
      ++cases;
      CAPTURE(cases);
      const WholePiece whole = random_even(draw);
      const BoardFrame frame(view.u, view.v, view.w);
      const RadialTerms terms(frame, whole.piece(), view.deepest);
      const Flow flow(frame, view.deepest);
      Polynomial g;
      for (std::size_t i = 0; i < whole.even.size(); ++i) {
        Quad binomial = 1;
        for (std::size_t n = 0; n <= i; ++n) {  // (x^2 + y^2)^i
          g[{static_cast<int>(2 * n), static_cast<int>(2 * (i - n))}] += Quad(whole.even[i]) * binomial;
          binomial = binomial * static_cast<Quad>(i - n) / static_cast<Quad>(n + 1);
        }
      }
      const double r = draw.log_uniform(1.0 / 32, 1.99);
      const Vec2 p = at_angle(r, draw.uniform(0, 7));
      const TermBounds error = terms.error(r * (1 - 0x1p-40), r * (1 + 0x1p-40));
      double got[kMaxTerms];
      terms.at(p, kMaxTerms, got);
      for (int j = 0; j < kMaxTerms; ++j) {
        CAPTURE(j);
        const double bound = error[static_cast<std::size_t>(j)], miss = size_of(Quad(got[j]) - value_of(g, p));
        CHECK(miss <= bound + kUnderflow);
        worst = std::max(worst, bound > 0 ? miss / bound : 0);
        g = next_term(g, j, flow);
      }
    }
    MESSAGE("largest error over its bound " << worst);
  }

  TEST_CASE("terms of every piece of every radial filter are those of the flow in 34 digits, within their errors") {
    Draw draw(102);
    std::map<std::string, SeenFilter> seen;
    double worst = 0, largest = 0;
    for (const auto& one : all_pieces(seen)) {
      const std::string& text = one.first;
      const std::size_t i = one.second;
      CAPTURE(text);
      CAPTURE(i);
      const PieceWeight& piece = seen.at(text).weight.pieces[i];
      for (int n = 0; n < 12; ++n) {
        View view = random_view(draw);
        while (!usable(view)) view = random_view(draw);
        const BoardFrame frame(view.u, view.v, view.w);
        const RadialTerms terms(frame, piece, view.deepest);
        const std::pair<double, double> ring = random_ring(draw, piece);
        const double low = ring.first, high = ring.second;
        const TermBounds error = terms.error(low * (1 - 0x1p-40), high * (1 + 0x1p-40)), top = terms.top(low, high);
        const Vec2 p = at_angle(draw.uniform(low, high), draw.uniform(0, 7));
        const Jet<Quad> truth =
            test::flow_terms<Quad>(Flow(frame, view.deepest), piece, Quad(p.x), Quad(p.y), distance(p));
        double got[kMaxTerms], first[kMaxTerms];
        terms.at(p, kMaxTerms, got);
        const int count = static_cast<int>(draw.integer(1, kMaxTerms));
        terms.at(p, count, first);
        for (int j = 0; j < kMaxTerms; ++j) {
          CAPTURE(j);
          const auto at = static_cast<std::size_t>(j);
          if (j < count) CHECK(first[j] == got[j]);
          const double miss = size_of(Quad(got[j]) - truth[at]);
          CHECK(miss <= error[at] + kUnderflow);
          worst = std::max(worst, error[at] > 0 ? miss / error[at] : 0);
          largest = std::max(largest, top[at] > 0 ? error[at] / top[at] : 0);
        }
      }
    }
    MESSAGE("largest error over its bound " << worst << ", largest bound over the term's " << largest);
    // Some thousand roundings, and errors of bounds on Taylor coefficients above those themselves.
    CHECK(largest < 1e-4);
  }

  TEST_CASE("no term is above its bounds anywhere in a ring, nor are these far above the largest in it") {
    Draw draw(103);
    std::map<std::string, SeenFilter> seen;
    std::array<double, test::kJet> loosest{};
    for (const auto& one : all_pieces(seen)) {
      const std::string& text = one.first;
      const std::size_t i = one.second;
      CAPTURE(text);
      CAPTURE(i);
      const RadialWeight& weight = seen.at(text).weight;
      for (const RadialRing& ring : weight.rings()) {
        if (ring.piece != i || !(ring.low >= weight.pieces[i].low)) continue;
        View view = random_view(draw);
        while (!usable(view)) view = random_view(draw);
        const BoardFrame frame(view.u, view.v, view.w);
        const RadialTerms terms(frame, weight.pieces[i], view.deepest);
        const bool level = frame.e.value == 0;
        const TermBounds whole = terms.top(ring.low, ring.high), along = terms.top(ring.along, ring.high);
        const std::array<double, test::kJet> most =
            largest_in(Flow(frame, view.deepest), weight.pieces[i], ring.low, ring.high);
        for (std::size_t j = 0; j < most.size(); ++j) {
          CAPTURE(j);
          CHECK(most[j] <= whole[j] * (1 + kNoise) + kUnderflow);
          CHECK(most[j] <= along[j] + whole[j] * kNoise + kUnderflow);
          if (level && most[j] > kUnderflow + kNoise * whole[j]) loosest[j] = std::max(loosest[j], along[j] / most[j]);
        }
      }
    }
    // Of boards that are level (e = 0), where terms are the coefficients along lines and nothing cancels: what rings 5%
    // of r^2 wide lose (radial_rings_test.cpp), a little more in other directions than were sampled.
    constexpr double kFantasy[] = {1.2, 1.3, 1.8, 2.2, 3.5};
    for (std::size_t j = 0; j < std::size(kFantasy); ++j) {
      CAPTURE(j);
      CHECK(loosest[j] > 1);
      CHECK(loosest[j] < kFantasy[j]);
    }
  }

  TEST_CASE("no term is above its bound at complex points within reach of a ring") {
    Draw draw(104);
    std::map<std::string, SeenFilter> seen;
    double tightest = HUGE_VAL;
    for (const auto& one : all_pieces(seen)) {
      const std::string& text = one.first;
      const std::size_t i = one.second;
      CAPTURE(text);
      CAPTURE(i);
      const PieceWeight& piece = seen.at(text).weight.pieces[i];
      for (int n = 0; n < 3; ++n) {
        View view = random_view(draw);
        while (!usable(view)) view = random_view(draw);
        const BoardFrame frame(view.u, view.v, view.w);
        const RadialTerms terms(frame, piece, view.deepest);
        const std::pair<double, double> ring = random_ring(draw, piece);
        const double low = ring.first, high = ring.second;
        const double reach = low * (draw.coin() ? 0.25 : draw.log_uniform(1e-3, 0.25));
        CAPTURE(low);
        CAPTURE(high);
        CAPTURE(reach);
        const TermBounds bound = terms.nearby(low, high, reach);
        const Flow flow(frame, view.deepest);
        std::array<double, test::kJet> most{};
        for (const long double turn : {0.0L, 0.25L, 0.5L, 0.75L, 1.0L}) {
          const Complex by = std::polar(static_cast<long double>(reach), turn * std::numbers::pi_v<long double>);
          const std::array<double, test::kJet> found = largest_beside(flow, piece, low, high, by);
          for (std::size_t j = 0; j < most.size(); ++j) most[j] = std::max(most[j], found[j]);
        }
        for (std::size_t j = 0; j < most.size(); ++j) {
          CAPTURE(j);
          CHECK(most[j] <= bound[j] * (1 + kNoise) + kUnderflow);
          if (most[j] > kUnderflow) tightest = std::min(tightest, bound[j] / most[j]);
        }
      }
    }
    MESSAGE("bounds over what was found: " << tightest << " or more");
    CHECK(tightest < 1.1);
  }

  TEST_CASE("no difference of two pieces' terms is above its bound before the knot between them") {
    Draw draw(105);
    std::map<std::string, SeenFilter> seen;
    double tightest = HUGE_VAL, loosest = 0;
    for (const auto& one : all_pieces(seen)) {
      const std::string& text = one.first;
      const std::size_t i = one.second;
      CAPTURE(text);
      CAPTURE(i);
      const std::vector<PieceWeight>& pieces = seen.at(text).weight.pieces;
      const bool last = i + 1 == pieces.size();
      for (int n = 0; n < 3; ++n) {
        View view = random_view(draw);
        while (!usable(view)) view = random_view(draw);
        const BoardFrame frame(view.u, view.v, view.w);
        const RadialTerms inner(frame, pieces[i], view.deepest), outer(frame, pieces[last ? i : i + 1], view.deepest);
        const double knot = pieces[i].high, half = std::min(inner.half(), outer.half());
        const double within = n == 0 ? 0 : half * draw.log_uniform(1e-12, 1e-3);
        CAPTURE(within);
        const TermBounds bound = RadialTerms::jump(inner, last ? nullptr : &outer, knot, within);
        const Flow flow(frame, view.deepest);
        std::array<double, test::kJet> most{};
        for (const double r : {knot - within, knot - 0.5 * within, knot}) {
          for (int turn = 0; turn < 8; ++turn) {
            const Vec2 p = at_angle(1, turn * std::numbers::pi / 4);
            const Quad x = Quad(p.x) * Quad(r), y = Quad(p.y) * Quad(r), d = distance(p) * Quad(r);
            Jet<Quad> g = test::flow_terms<Quad>(flow, pieces[i], x, y, d);
            if (!last) {
              const Jet<Quad> next = test::flow_terms<Quad>(flow, pieces[i + 1], x, y, d);
              for (std::size_t j = 0; j < g.size(); ++j) g[j] -= next[j];
            }
            for (std::size_t j = 0; j < g.size(); ++j) most[j] = std::max(most[j], size_of(g[j]));
          }
        }
        for (std::size_t j = 0; j < most.size(); ++j) {
          CAPTURE(j);
          CHECK(most[j] <= bound[j] * (1 + 0x1p-50) + kUnderflow);
          if (most[j] > kUnderflow) tightest = std::min(tightest, bound[j] / most[j]);
        }
        if (most[0] > 1e-9) loosest = std::max(loosest, bound[0] / most[0]);
      }
    }
    MESSAGE("bounds over what was found: " << tightest << " or more; of k itself at most " << loosest);
    // Where k jumps nothing else matters so near the knot.
    CHECK(loosest < 1.01);
  }
}

}  // namespace moire
