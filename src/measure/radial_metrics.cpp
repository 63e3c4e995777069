// Metrics of radial filters by Gauss-Legendre quadrature in r and in frequency; nothing is integrated to infinity.
#include "measure/radial_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "core/sum.h"
#include "curve/quadrature.h"
#include "measure/radial_projection.h"
#include "measure/radial_ripple.h"
#include "measure/turning_points.h"
#include "measure/wave_terms.h"

namespace moire {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCorner = std::numbers::sqrt2 / 2;  // cycles per pixel: the Nyquist square's corner

struct Node {
  double r;
  double mass;  // the rule's weight times 2 pi r k(r)
  double k;
};

// Nodes good for r k(r) times k, r^2 or J0(2 pi f r), f up to kCorner. 24 of them are exact to degree 47: above degree
// 20 k is a fit of which 22 terms are left on a quarter of its piece (see filter_metrics.cpp), so that k^2 r has degree
// 45; and a wave that turns by 3/2 to each side, as none does more, has 20 terms.
std::vector<Node> quadrature_nodes(const RadialKernel& kernel) {
  const Rule rule = gauss_legendre(kMaxNodes);
  std::vector<Node> nodes;
  for (int p = 0; p < kernel.pieces(); ++p) {
    const double left = kernel.knots()[static_cast<std::size_t>(p)],
                 right = kernel.knots()[static_cast<std::size_t>(p) + 1];
    const int turns = static_cast<int>(std::ceil(2 * kPi * kCorner * (right - left) / 3));
    const int panels = std::max(turns, kernel.degree() > 20 ? 4 : 1);
    const double half = 0.5 * (right - left) / panels;
    for (int panel = 0; panel < panels; ++panel) {
      for (std::size_t i = 0; i < rule.node.size(); ++i) {
        const double r = left + half * (2 * panel + 1 + rule.node[i]), k = kernel.k_piece(p, r);
        nodes.push_back({r, half * rule.weight[i] * 2 * kPi * r * k, k});
      }
    }
  }
  return nodes;
}

template <class F>
double integrate(const std::vector<Node>& nodes, const F& f) {
  Sum sum;
  for (const Node& n : nodes) sum.add(n.mass * f(n));
  return sum.value();
}

// 1 - H(f), to relative rounding where f is small. 1 - J0(z) is the mean of 1 - cos(z sin angle) over all angles; of
// that, m midpoints of a quarter circle miss 2 J_4m(z) and less.
class Loss {
 public:
  explicit Loss(const RadialKernel& kernel) : nodes_(quadrature_nodes(kernel)) {
    const int points = terms_of_wave(2 * kPi * kCorner * kernel.radius()) / 4 + 1;
    for (int i = 0; i < points; ++i) sine_.push_back(std::sin(0.25 * kPi * (2 * i + 1) / points));
  }
  const std::vector<Node>& nodes() const { return nodes_; }
  // 0 <= f <= kCorner.
  double operator()(double f) const {
    Sum sum;
    for (const Node& n : nodes_) {
      double lost = 0;
      for (const double s : sine_) {
        const double half_wave = std::sin(kPi * f * n.r * s);
        lost += half_wave * half_wave;
      }
      sum.add(n.mass * lost);
    }
    return 2 * sum.value() / static_cast<double>(sine_.size());
  }

 private:
  std::vector<Node> nodes_;
  std::vector<double> sine_;
};

// What H^2 holds below the Nyquist frequency.
struct Band {
  double power = 0;      // integral of H^2 over the Nyquist square
  double lost_edge = 0;  // 2 times the integral of (1 - H^2) / (2 pi f)^2 over [0, 1/2] on an axis
};

// In the plane H^2 is the transform of k's autocorrelation, which ends at 2 radius: along f its waves turn by at most
// 4 pi radius times half a panel to each side, for which 24 nodes are enough up to 15 (see filter_metrics.cpp).
//
// The circle of radius f, 1/2 < f < kCorner, has 2 pi f - 8 f acos(1 / 2f) of its length in the square. There
// f = 1 / (2 cos angle): no root is left, the pole at pi / 2 is 3 half-panels and more away, and the waves, now not
// quite even, turn by pi radius / panels and less.
Band nyquist_band(const Loss& loss, double radius) {
  const Rule rule = gauss_legendre(kMaxNodes);
  Sum power, lost;
  const int panels = std::max(1, static_cast<int>(std::ceil(kPi * radius / 15)));
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double half = 0.25 / panels, f = half * (2 * panel + 1 + rule.node[i]), w = half * rule.weight[i];
      const double c = loss(f);
      power.add(w * 2 * kPi * f * (1 - c) * (1 - c));
      lost.add(2 * w * c * (2 - c) / (4 * kPi * kPi * f * f));
    }
  }
  const int outer = 1 + static_cast<int>(std::ceil(kPi * radius / 8));
  for (int panel = 0; panel < outer; ++panel) {
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double half = kPi / 8 / outer, angle = half * (2 * panel + 1 + rule.node[i]), w = half * rule.weight[i];
      const double f = 0.5 / std::cos(angle), h = 1 - loss(f);
      power.add(w * f * std::tan(angle) * f * (2 * kPi - 8 * angle) * h * h);
    }
  }
  return {power.value(), lost.value()};
}

// 2 pi times the way that G goes up and down between the zeros of k.
double l1_gain(const RadialKernel& kernel) {
  Sum way;
  for (int p = 0; p < kernel.pieces(); ++p) {
    const double left = kernel.knots()[static_cast<std::size_t>(p)],
                 right = kernel.knots()[static_cast<std::size_t>(p) + 1];
    const auto G = [&](double r) { return r * r * kernel.q_piece(p, r); };
    std::vector<double> stops =
        sign_changes([&](double r) { return kernel.k_piece(p, r); }, kernel.degree(), left, right);
    stops.push_back(right);
    double before = G(left);
    for (const double r : stops) {
      const double here = G(r);
      way.add(2 * kPi * std::fabs(here - before));
      before = here;
    }
  }
  return way.value();
}

}  // namespace

FilterMetrics filter_metrics(const RadialKernel& kernel) {
  FilterMetrics m;
  m.radius = kernel.radius();
  m.integral = kernel.integral();
  m.ripple = radial_ripple(kernel);

  const Loss loss(kernel);
  m.variance = integrate(loss.nodes(), [](const Node& n) { return 0.5 * n.r * n.r; });
  m.noise_gain = integrate(loss.nodes(), [](const Node& n) { return n.k; });
  m.noise_gain_1d = std::sqrt(m.noise_gain);
  m.nyquist_response = 1 - loss(0.5);
  m.l1_gain = l1_gain(kernel);

  const RadialProjection projection(kernel);
  m.overshoot_percent = 100 * projection.overshoot();
  const Band band = nyquist_band(loss, m.radius);
  m.smoothing = 1 - band.power;
  m.postaliasing = m.noise_gain - band.power;
  // As for separable filters (filter_metrics.cpp): the ones above f = 1/2 hold 1 / pi^2, all of (1 - H^2) the spread.
  m.edge_alias_energy = 1 / (kPi * kPi) - projection.spread() + band.lost_edge;
  return m;
}

}  // namespace moire
