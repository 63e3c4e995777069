// How radial weights vary along lines: bounds ring by ring against the Taylor coefficients themselves, in 34 digits.
#include "testimages/radial_rings.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "filter_list.h"
#include "testimages/radial_jets.h"

namespace moire {
namespace {

using oracle::Quad;
using test::Jet;
using test::SeenFilter;

// How far bounds of low orders may be above what is found, in so many rings on either side. From order 3 on the K_n of
// different n cancel along most lines (all but the first for a cone), what they may differ by in the ring does not.
constexpr double kFantasy[] = {1.5, 1.5, 1.5, 2.1, 3};
constexpr std::size_t kAround = 3;

// Of k(|p + s d|) in s, |p| = r and p . d = r c: the Taylor coefficients `k` of k at r, composed with the distance.
Jet<Quad> along(const Jet<Quad>& k, double r, Quad c) {
  Jet<Quad> square{};
  square[0] = Quad(r) * Quad(r);
  square[1] = 2 * Quad(r) * c;
  square[2] = 1;
  const Jet<Quad> distance = test::root(square, Quad(r));
  Jet<Quad> out{};
  for (std::size_t m = k.size(); m-- > 0;) {
    // Times the distance less r, which has no constant: coefficients beyond k.size() - 1 - m would be lost later.
    for (std::size_t i = k.size() - m; i-- > 1;) {
      out[i] = 0;
      for (std::size_t l = 0; l < i; ++l) out[i] += out[l] * distance[i - l];
    }
    out[0] = k[m];
  }
  return out;
}

// The largest found at the ring's ends and in its middle, along lines of all directions: coefficients are even or odd
// in c.
std::array<double, test::kJet> sampled(const PieceWeight& piece, const RadialRing& ring) {
  constexpr int kDirections = 12;
  std::array<double, test::kJet> most{};
  for (const double r : {ring.low, 0.5 * (ring.low + ring.high), ring.high}) {
    Jet<Quad> place{};
    place[0] = oracle::widen(r);
    place[1] = 1;
    const Jet<Quad> k = test::piece_of(piece, place);
    for (int q = 0; q <= kDirections; ++q) {
      const Jet<Quad> found = along(k, r, Quad(q) / kDirections);
      for (std::size_t i = 0; i < found.size(); ++i) {
        most[i] = std::max(most[i], std::fabs(static_cast<double>(found[i])));
      }
    }
  }
  return most;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("rings cover every piece of a radial weight from its radius inwards, without gaps") {
    for (const std::string& text : test::radial_texts()) {
      CAPTURE(text);
      const SeenFilter seen(text);
      const std::vector<PieceWeight>& pieces = seen.weight.pieces;
      double low = seen.weight.radius();
      std::size_t piece = pieces.size() - 1;
      for (const RadialRing& ring : seen.weight.rings()) {
        REQUIRE(ring.piece < pieces.size());
        if (ring.piece != piece) {
          // The innermost ring of a piece goes on before its knot, where polygons along the knot's circle are.
          REQUIRE(ring.piece + 1 == piece);
          CHECK(low < pieces[piece].low);
          CHECK(low > pieces[piece].low - 0.01 * (pieces[piece].high - pieces[piece].low));
          low = pieces[piece].low;
          piece = ring.piece;
        }
        CHECK(ring.high == low);
        CHECK(ring.low < ring.high);
        low = ring.low;
      }
      CHECK(piece == 0);
      CHECK(low <= kInnermost * seen.weight.radius());
      CHECK(low > 0);
      // Few enough to sum over in every window.
      CHECK(seen.weight.rings().size() < 500);
    }
  }

  TEST_CASE("no Taylor coefficient of a radial weight along a line is above its ring's bound, nor low ones far below") {
    double tightest = HUGE_VAL, loosest = 0;
    for (const std::string& text : test::radial_texts()) {
      CAPTURE(text);
      const SeenFilter seen(text);
      const std::span<const RadialRing> rings = seen.weight.rings();
      std::vector<std::array<double, test::kJet>> most;
      for (const RadialRing& ring : rings) most.push_back(sampled(seen.weight.pieces[ring.piece], ring));
      for (std::size_t n = 0; n < rings.size(); ++n) {
        CAPTURE(rings[n].low);
        CAPTURE(rings[n].high);
        for (std::size_t i = 0; i < test::kJet; ++i) {
          CAPTURE(i);
          const double bound = rings[n].along[i];
          // What was sampled is rounded to doubles.
          CHECK(most[n][i] <= bound * (1 + 0x1p-50));
          if (most[n][i] > 0) tightest = std::min(tightest, bound / most[n][i]);
          if (i >= std::size(kFantasy)) continue;
          // Where a coefficient passes 0 in a ring, it is as large as in the rings around it that matters.
          double around = 0;
          for (std::size_t m = n < kAround ? 0 : n - kAround; m <= n + kAround && m < rings.size(); ++m) {
            if (rings[m].piece == rings[n].piece) around = std::max(around, most[m][i]);
          }
          // A coefficient of a constant is 0, and its bound what rounding of others comes to.
          const double nothing = 1e-13 * seen.weight.pieces[0].top * std::pow(rings[n].low, -static_cast<double>(i));
          CHECK(bound <= kFantasy[i] * around + nothing);
          if (around > nothing) loosest = std::max(loosest, bound / around);
        }
      }
    }
    MESSAGE("bounds over what was found: " << tightest << " or more, of low orders up to " << loosest);
  }
}

}  // namespace moire
