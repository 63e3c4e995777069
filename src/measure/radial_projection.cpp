// Projections of radial kernels by Gauss-Legendre quadrature in variables in which nothing is singular.
#include "measure/radial_projection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/sum.h"
#include "curve/quadrature.h"
#include "measure/turning_points.h"

namespace moire {
namespace {

// A series of more terms is the fit of a smooth function: on a quarter of its piece 22 of them are left (see
// filter_metrics.cpp).
constexpr int kPolynomial = 20;

// Whether k is negative anywhere: without that no step overshoots.
bool has_lobes(const RadialKernel& kernel) {
  for (int p = 0; p < kernel.pieces(); ++p) {
    const double left = kernel.knots()[static_cast<std::size_t>(p)],
                 right = kernel.knots()[static_cast<std::size_t>(p) + 1];
    const auto k = [&](double r) { return kernel.k_piece(p, r); };
    std::vector<double> stops = sign_changes(k, kernel.degree(), left, right);
    stops.push_back(right);
    double before = left;
    for (const double stop : stops) {
      if (k(0.5 * (before + stop)) < 0) return true;
      before = stop;
    }
  }
  return false;
}

}  // namespace

// Twice the integral of f(piece, r, q(r)) dt over the part of the line at distance x inside the support, where
// y = x sinh t and r = x cosh t: dy = r dt, and the angle at the centre grows by x / r dt. Near y = 0, where r turns,
// and far away, where y / x is large, f is equally smooth in t; panels are half a unit or shorter, so that no
// singularity (the nearest is 1 / cosh at i pi / 2) is nearer than 6 half-lengths.
template <class F>
double RadialProjection::over_rays(double x, const F& f) const {
  constexpr double kPanel = 0.5;
  const Rule rule = gauss_legendre(kMaxNodes);
  double t[kMaxNodes], r[kMaxNodes], q[kMaxNodes];
  Sum sum;
  const int parts = kernel_.degree() > kPolynomial ? 4 : 1;
  // Where the line meets the circle of radius b; b - x is exact where that matters.
  const auto parameter = [x](double b) { return b <= x ? 0 : std::asinh(std::sqrt((b - x) * (b + x)) / x); };
  for (int p = 0; p < kernel_.pieces(); ++p) {
    const double left = kernel_.knots()[static_cast<std::size_t>(p)],
                 right = kernel_.knots()[static_cast<std::size_t>(p) + 1];
    if (right <= x) continue;
    for (int part = 0; part < parts; ++part) {
      const auto cut = [&](int i) { return i == parts ? right : left + (right - left) * i / parts; };
      if (cut(part + 1) <= x) continue;
      const double from = parameter(cut(part)), to = parameter(cut(part + 1));
      const int panels = std::max(1, static_cast<int>(std::ceil((to - from) / kPanel)));
      const double half = 0.5 * (to - from) / panels;
      for (int panel = 0; panel < panels; ++panel) {
        for (std::size_t i = 0; i < kMaxNodes; ++i) {
          t[i] = from + half * (2 * panel + 1 + rule.node[i]);
          r[i] = std::min(x * std::cosh(t[i]), right);
        }
        kernel_.q_pieces(p, r, q);
        for (std::size_t i = 0; i < kMaxNodes; ++i) sum.add(2 * half * rule.weight[i] * f(p, r[i], q[i]));
      }
    }
  }
  return sum.value();
}

double RadialProjection::P(double x) const {
  return over_rays(x, [this](int piece, double r, double) { return kernel_.k_piece(piece, r) * r; });
}

// What lies outside radius r on the ray to the edge's point at distance r.
double RadialProjection::beyond(double x) const {
  return over_rays(x, [x](int, double r, double q) { return (RadialKernel::kWhole - r * r * q) * x / r; });
}

// Half-odd powers of the distance to a piece's outer end become whole ones in its root. On the first piece there is
// x^3 log x and more of the kind at 0, too: in the fourth root of x 24 nodes leave nothing of it. Four panels in each
// root, because the knot beyond the end is near for short next pieces: a seventh of the piece in the catalogue.
double RadialProjection::spread() const {
  constexpr int kPanels = 4;
  const Rule rule = gauss_legendre(kMaxNodes);
  Sum sum;
  const auto add = [&](double x, double weight) {
    const double outside = beyond(x);
    sum.add(2 * weight * outside * (1 - outside));
  };
  for (int p = 0; p < kernel_.pieces(); ++p) {
    const double right = kernel_.knots()[static_cast<std::size_t>(p) + 1];
    const double left = p == 0 ? 0.5 * right : kernel_.knots()[static_cast<std::size_t>(p)];
    for (int panel = 0; panel < kPanels; ++panel) {
      for (std::size_t i = 0; i < kMaxNodes; ++i) {
        const double root = (2 * panel + 1 + rule.node[i]) / (2 * kPanels), weight = rule.weight[i] / (2 * kPanels);
        add(right - (right - left) * root * root, weight * (right - left) * 2 * root);
        if (p == 0) add(left * root * root * root * root, weight * left * 4 * root * root * root);
      }
    }
  }
  return sum.value();
}

double RadialProjection::overshoot() const {
  constexpr int kSamples = 32;
  if (!has_lobes(kernel_)) return 0;
  double best = 0, before = kernel_.knots()[1] / (2 * kSamples), value_before = P(before);
  for (int p = 0; p < kernel_.pieces(); ++p) {
    const double left = kernel_.knots()[static_cast<std::size_t>(p)],
                 right = kernel_.knots()[static_cast<std::size_t>(p) + 1];
    for (int i = 1; i <= kSamples; ++i) {
      const double x = i == kSamples ? right : left + (right - left) * i / kSamples, value = P(x);
      // beyond() is flat where P is 0: half the digits of the place are enough.
      if (value != 0 && value_before != 0 && (value < 0) != (value_before < 0)) {
        double low = before, high = x;
        while (high - low > 0x1p-34 * right) {
          const double middle = 0.5 * (low + high);
          ((P(middle) < 0) == (value_before < 0) ? low : high) = middle;
        }
        best = std::max(best, -beyond(0.5 * (low + high)));
      }
      if (value != 0) before = x, value_before = value;
    }
  }
  return best;
}

}  // namespace moire
