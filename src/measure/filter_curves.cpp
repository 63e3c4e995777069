// A filter drawn.
#include "measure/filter_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "curve/quadrature.h"
#include "measure/radial_projection.h"

namespace moire {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kFrequencies = 193;   // to 3 cycles per pixel
constexpr double kStep = 1.0 / 64;  // between them
constexpr int kPointsAcross = 256;  // of a curve over the support
constexpr int kEdgePoints = 257;
constexpr double kMargin = 0.25;  // pixels of nothing beside a kernel
constexpr double kEdgeMargin = 0.5;

void add(Curve& curve, double x, double y) {
  curve.x.push_back(x);
  curve.y.push_back(y);
}

// Steps in which a piece is drawn.
int steps_of(double length, double support, int degree) {
  if (degree <= 1) return 1;
  return std::max(4, static_cast<int>(std::ceil(kPointsAcross * length / support)));
}

struct Piece {
  double left, right;
};

std::vector<Piece> pieces_of(std::span<const double> knots) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) pieces.push_back({knots[i], knots[i + 1]});
  return pieces;
}

Curve kernel_curve(const Kernel& kernel) {
  Curve curve;
  const double radius = kernel.radius();
  add(curve, -radius - kMargin, 0);
  add(curve, -radius, 0);
  int p = 0;
  for (const Piece& piece : pieces_of(kernel.knots())) {
    const int steps = steps_of(piece.right - piece.left, 2 * radius, kernel.degree());
    for (int i = 0; i <= steps; ++i) {
      const double x = i == steps ? piece.right : piece.left + (piece.right - piece.left) * i / steps;
      add(curve, x, kernel.k_piece(p, x));
    }
    ++p;
  }
  add(curve, radius, 0);
  add(curve, radius + kMargin, 0);
  return curve;
}

Curve kernel_curve(const RadialKernel& kernel) {
  Curve right;
  int p = 0;
  for (const Piece& piece : pieces_of(kernel.knots())) {
    const int steps = steps_of(piece.right - piece.left, 2 * kernel.radius(), kernel.degree());
    for (int i = 0; i <= steps; ++i) {
      const double r = i == steps ? piece.right : piece.left + (piece.right - piece.left) * i / steps;
      add(right, r, kernel.k_piece(p, r));
    }
    ++p;
  }
  add(right, kernel.radius(), 0);
  add(right, kernel.radius() + kMargin, 0);
  Curve curve;
  for (std::size_t i = right.x.size(); i-- > 1;) add(curve, -right.x[i], right.y[i]);
  curve.x.insert(curve.x.end(), right.x.begin(), right.x.end());
  curve.y.insert(curve.y.end(), right.y.begin(), right.y.end());
  return curve;
}

// Where k is known for its integrals: a place and k there times the rule's weight.
struct Node {
  double x, mass;
};

// On panels of a quarter pixel and less a wave of 3 cycles per pixel turns by 3/4 pi to each side, and a smooth kernel
// is a polynomial of few terms: 24 nodes leave rounding.
template <class K>
std::vector<Node> nodes_of(const K& kernel) {
  const Rule rule = gauss_legendre(kMaxNodes);
  std::vector<Node> nodes;
  int p = 0;
  for (const Piece& piece : pieces_of(kernel.knots())) {
    const int panels = static_cast<int>(std::ceil(4 * (piece.right - piece.left)));
    const double half = 0.5 * (piece.right - piece.left) / panels;
    for (int panel = 0; panel < panels; ++panel) {
      for (std::size_t i = 0; i < rule.node.size(); ++i) {
        const double x = piece.left + half * (2 * panel + 1 + rule.node[i]);
        nodes.push_back({x, half * rule.weight[i] * kernel.k_piece(p, x)});
      }
    }
    ++p;
  }
  return nodes;
}

Curve response_curve(const Kernel& kernel) {
  const std::vector<Node> nodes = nodes_of(kernel);
  double mean = 0;
  for (const Node& n : nodes) mean += n.mass * n.x;
  Curve curve;
  for (int i = 0; i < kFrequencies; ++i) {
    double gain = 0;
    for (const Node& n : nodes) gain += n.mass * std::cos(2 * kPi * kStep * i * (n.x - mean));
    add(curve, kStep * i, gain);
  }
  return curve;
}

Curve response_curve(const RadialKernel& kernel) {
  const std::vector<Node> nodes = nodes_of(kernel);
  Curve curve;
  for (int i = 0; i < kFrequencies; ++i) {
    double gain = 0;
    for (const Node& n : nodes) gain += 2 * kPi * n.x * n.mass * std::cyl_bessel_j(0.0, 2 * kPi * kStep * i * n.x);
    add(curve, kStep * i, gain);
  }
  return curve;
}

template <class F>
Curve edge_curve(double radius, const F& value) {
  Curve curve;
  const double end = radius + kEdgeMargin;
  for (int i = 0; i < kEdgePoints; ++i) {
    const double x = end * (2 * i - (kEdgePoints - 1)) / (kEdgePoints - 1);
    add(curve, x, value(x));
  }
  return curve;
}

}  // namespace

FilterCurves filter_curves(const Filter& filter) {
  if (!filter.is_radial()) {
    const Kernel& kernel = filter.kernel();
    return {kernel_curve(kernel), response_curve(kernel),
            edge_curve(kernel.radius(), [&](double x) { return 1 - kernel.K(-x); })};
  }
  const RadialKernel& kernel = filter.radial_kernel();
  const RadialProjection projection(kernel);
  const auto edge = [&](double x) {
    if (std::fabs(x) >= kernel.radius()) return x < 0 ? 0.0 : 1.0;
    if (x == 0) return 0.5;
    return x < 0 ? projection.beyond(-x) : 1 - projection.beyond(x);
  };
  return {kernel_curve(kernel), response_curve(kernel), edge_curve(kernel.radius(), edge)};
}

}  // namespace moire
