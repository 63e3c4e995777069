// Gauss-Legendre rules in long double, and adaptive integration by comparing two of them.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "oracle/quad.h"

namespace moire::oracle {

// Nodes and weights on [-1, 1]; exact for polynomials of degree 2n - 1.
struct Rule {
  std::vector<long double> x, w;

  explicit Rule(int n) : x(static_cast<std::size_t>(n)), w(x.size()) {
    for (int i = 0; i < n; ++i) {
      // Newton's method on the Legendre polynomial from Tricomi's first guess; five steps are twice what is needed.
      long double z = std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(i) + 0.75L) /
                               (static_cast<long double>(n) + 0.5L));
      long double slope = 1;
      for (int step = 0; step < 6; ++step) {
        long double p = 1, before = 0;
        for (int j = 1; j <= n; ++j) {
          const auto m = static_cast<long double>(j);
          const long double older = before;
          before = p;
          p = ((2 * m - 1) * z * before - (m - 1) * older) / m;
        }
        slope = static_cast<long double>(n) * (before - z * p) / (1 - z * z);
        if (step < 5) z -= p / slope;
      }
      x[static_cast<std::size_t>(i)] = z;
      w[static_cast<std::size_t>(i)] = 2 / ((1 - z * z) * slope * slope);
    }
  }
};

// Two rules whose difference judges the coarser one, so that the finer one is better than the error it states.
struct RulePair {
  Rule coarse, fine;
};

// Integral of f, a function of T (Quad or long double), over [a, b]; halves the interval until the rules agree.
template <class T, class F>
Value integrate(const RulePair& rules, const F& f, T a, T b, int depth = 0) {
  const T mid = (a + b) / 2, half = (b - a) / 2;
  const auto scale = static_cast<long double>(half);
  long double sum[2] = {0, 0}, size = 0;
  const Rule* rule[2] = {&rules.coarse, &rules.fine};
  for (int r = 0; r < 2; ++r)
    for (std::size_t i = 0; i < rule[r]->x.size(); ++i) {
      const long double term = rule[r]->w[i] * f(mid + half * static_cast<T>(rule[r]->x[i]));
      sum[r] += term;
      if (r == 1) size += std::fabs(term);
    }
  const long double rounding = 0x1p-59L * size * scale;  // 32 long double ulps: sums of 8-40 terms, each good to a few
  const long double gap = std::fabs(sum[1] - sum[0]) * scale;
  constexpr long double kGoal = 1e-18L;
  constexpr int kDeepest = 24;  // where a kink was missed the interval left is 1e-7 of the first: seen in the error
  if (gap <= kGoal + rounding || depth == kDeepest) return {sum[1] * scale, gap + rounding};
  Value v = integrate(rules, f, a, mid, depth + 1);
  v += integrate(rules, f, mid, b, depth + 1);
  return v;
}

}  // namespace moire::oracle
