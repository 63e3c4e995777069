// Filter metrics by Gauss-Legendre quadrature of the kernel's pieces; nothing is integrated to infinity.
#include "measure/filter_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "core/sum.h"
#include "curve/quadrature.h"
#include "measure/turning_points.h"
#include "measure/wave_terms.h"

namespace moire {
namespace {

constexpr double kPi = std::numbers::pi;

// Where k is evaluated for all integrals over x.
struct Node {
  double x;       // pixels from the kernel's mean
  double length;  // the rule's weight
  double k, K;
};

// Nodes good for k(x) times x^2 or a wave of frequency up to 1/2, for k^2 and for K (1 - K), degree 2n + 2 where k has
// degree n. Above n = 20 a series is the fit of a smooth function and of degree 40 at most (kernel.h). Such a fit,
// whose terms fall below 2^-53 after 40, is bounded on an ellipse of parameter 2.5 around its piece; on a quarter of
// the piece that is one of parameter 5 or more, and the terms fall below rounding after 23.
std::vector<Node> quadrature_nodes(const Kernel& kernel) {
  std::vector<Node> nodes;
  const std::span<const double> knots = kernel.knots();
  for (int p = 0; p < kernel.pieces(); ++p) {
    const double left = knots[static_cast<std::size_t>(p)], right = knots[static_cast<std::size_t>(p) + 1];
    // A wave turns by pi * length / 2 to each side of the middle: at most 3/2.
    const double turns = std::ceil(kPi * (right - left) / 3);
    const int panels = static_cast<int>(turns) * (kernel.degree() > 20 ? 4 : 1);
    const double half = 0.5 * (right - left) / panels;
    const int degree = std::min(kernel.degree(), 22);
    const int exact_to = std::max({2 * degree + 2, degree + 2, degree + terms_of_wave(kPi * half)});
    const Rule rule = gauss_legendre(std::min(exact_to / 2 + 1, kMaxNodes));
    for (int panel = 0; panel < panels; ++panel) {
      const double mid = left + half * (2 * panel + 1);
      for (std::size_t i = 0; i < rule.node.size(); ++i) {
        const double x = mid + half * rule.node[i];
        nodes.push_back({x, half * rule.weight[i], kernel.k_piece(p, x), kernel.K_piece(p, x)});
      }
    }
  }
  return nodes;
}

// Integral over the support of a function of a node.
template <class F>
double integrate(const std::vector<Node>& nodes, const F& f) {
  Sum sum;
  for (const Node& n : nodes) sum.add(n.length * f(n));
  return sum.value();
}

// 1 - H(f) = c + i s, both exact to relative rounding where f is small: what a low frequency loses is never the
// difference of two numbers near 1. Of the kernel moved to its mean, which |H| does not see.
struct Loss {
  double c, s;
  double power() const { return (1 - c) * (1 - c) + s * s; }   // |H|^2
  double lost_power() const { return 2 * c - c * c - s * s; }  // 1 - |H|^2
};

Loss loss(const std::vector<Node>& nodes, double f) {
  Sum c, s;
  for (const Node& n : nodes) {
    const double sine = std::sin(kPi * f * n.x), cosine = std::cos(kPi * f * n.x), w = 2 * n.length * n.k * sine;
    c.add(w * sine);
    s.add(w * cosine);
  }
  return {c.value(), s.value()};
}

// What |H|^2 holds below the Nyquist frequency.
struct Band {
  double power = 0;      // integral of |H|^2 over [-1/2, 1/2]
  double lost_edge = 0;  // 2 times the integral of (1 - |H|^2) / (2 pi f)^2 over [0, 1/2]
};

// |H|^2 is the transform of k's autocorrelation, which ends at 2 radius: over a panel of half length h its waves turn
// by at most 4 pi radius h to each side. 24 Gauss nodes integrate exp(i c t) with an error below 1e-18 for c <= 15: it
// is at most 2^49 (24!)^4 / (49 (48!)^3) c^48.
Band nyquist_band(const std::vector<Node>& nodes, double radius) {
  const int panels = std::max(1, static_cast<int>(std::ceil(kPi * radius / 15)));
  const double half = 0.25 / panels;
  const Rule rule = gauss_legendre(24);
  Sum power, lost;
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double f = half * (2 * panel + 1 + rule.node[i]), w = 2 * half * rule.weight[i];
      const Loss at = loss(nodes, f);
      power.add(w * at.power());
      lost.add(w * at.lost_power() / (4 * kPi * kPi * f * f));
    }
  }
  return {power.value(), lost.value()};
}

// Ours: the distance |x - y| is 4 times the integral over f > 0 of (1 - cos(2 pi f (x - y))) / (2 pi f)^2. Weighted
// with k(x) k(y) the left side becomes 2 times the integral of K (1 - K) and the cosine |H|^2 (by symmetry of x and y),
// so
//   2 * integral over f > 0 of (1 - |H|^2) / (2 pi f)^2 = integral of K (1 - K) dx.
// The ones above f = 1/2 have the integral 1 / pi^2; what is left there is minus the alias energy.
double edge_alias_energy(const std::vector<Node>& nodes, const Band& band) {
  const double spread = integrate(nodes, [](const Node& n) { return n.K * (1 - n.K); });
  return 1 / (kPi * kPi) - spread + band.lost_edge;
}

// The sum over all pixels is a polynomial between the places where any of them meets a knot.
double ripple(const Kernel& kernel) {
  constexpr double kNothing = 0x1p-40;  // pixels: knots this close, modulo 1, differ by rounding alone
  std::vector<double> phases;
  for (const double knot : kernel.knots()) phases.push_back(knot - std::floor(knot));
  std::sort(phases.begin(), phases.end());
  phases.push_back(phases.front() + 1);
  const int reach = static_cast<int>(std::ceil(kernel.radius())) + 1;
  double worst = 0;
  for (std::size_t i = 0; i + 1 < phases.size(); ++i) {
    const double from = phases[i], to = phases[i + 1];
    if (to - from < kNothing) continue;
    struct Shifted {
      int piece;
      double by;
    };
    std::vector<Shifted> met;
    for (int j = -reach - 1; j <= reach; ++j) {
      const int piece = kernel.piece_of(0.5 * (from + to) + j);
      if (piece >= 0 && piece < kernel.pieces()) met.push_back({piece, static_cast<double>(j)});
    }
    const auto sum = [&](double phase) {
      Sum s;
      for (const Shifted& m : met) s.add(kernel.k_piece(m.piece, phase + m.by));
      return s.value();
    };
    std::vector<double> stops = turning_points(sum, kernel.degree(), from, to);
    stops.insert(stops.end(), {from, to});
    for (const double phase : stops) worst = std::max(worst, std::fabs(sum(phase) - 1));
  }
  return worst;
}

// K goes up and down between the zeros and jumps of k: its turns are the overshoot, its way up and down the L1 gain.
struct Step {
  double l1_gain = 0, overshoot = 0;
};

Step step_response(const Kernel& kernel) {
  const std::span<const double> knots = kernel.knots();
  Step step;
  Sum way;
  for (int p = 0; p < kernel.pieces(); ++p) {
    const double left = knots[static_cast<std::size_t>(p)], right = knots[static_cast<std::size_t>(p) + 1];
    std::vector<double> stops =
        sign_changes([&](double x) { return kernel.k_piece(p, x); }, kernel.degree(), left, right);
    stops.push_back(right);
    double before = kernel.K_piece(p, left);
    for (const double x : stops) {
      const double here = kernel.K_piece(p, x);
      way.add(std::fabs(here - before));
      step.overshoot = std::max({step.overshoot, here - 1, -here});
      before = here;
    }
  }
  step.l1_gain = way.value();
  return step;
}

// One eighth of the circle is enough: |H| is even, and x and y may be swapped.
double anisotropy(const std::vector<Node>& nodes, double radius) {
  const auto product = [&](double angle) {
    return loss(nodes, std::cos(angle) / 2).power() * loss(nodes, std::sin(angle) / 2).power();
  };
  // In the angle the two factors' waves turn by up to 2 pi radius (1 + sqrt 1/2) per radian; that f is no straight line
  // in it costs a few terms more.
  const double turn = 2 * kPi * radius * (1 + std::numbers::sqrt2 / 2) * kPi / 8;
  std::vector<double> angles = turning_points(product, terms_of_wave(turn) + 12, 0, kPi / 4);
  angles.insert(angles.end(), {0.0, kPi / 4});
  double low = HUGE_VAL, high = 0;
  for (const double angle : angles) {
    const double magnitude = std::sqrt(product(angle));
    low = std::min(low, magnitude);
    high = std::max(high, magnitude);
  }
  return high - low;
}

}  // namespace

FilterMetrics filter_metrics(const Kernel& kernel) {
  FilterMetrics m;
  m.radius = kernel.radius();
  m.integral = kernel.integral();
  m.ripple = ripple(kernel);

  std::vector<Node> nodes = quadrature_nodes(kernel);
  m.mean = integrate(nodes, [](const Node& n) { return n.k * n.x; });
  for (Node& n : nodes) n.x -= m.mean;
  m.variance = integrate(nodes, [](const Node& n) { return n.k * n.x * n.x; });
  m.noise_gain_1d = integrate(nodes, [](const Node& n) { return n.k * n.k; });
  m.noise_gain = m.noise_gain_1d * m.noise_gain_1d;
  m.nyquist_response = 1 - loss(nodes, 0.5).c;

  const Step step = step_response(kernel);
  m.l1_gain = step.l1_gain;
  m.overshoot_percent = 100 * step.overshoot;

  const Band band = nyquist_band(nodes, m.radius);
  m.smoothing = 1 - band.power * band.power;
  m.postaliasing = m.noise_gain - band.power * band.power;
  m.edge_alias_energy = edge_alias_energy(nodes, band);
  m.anisotropy = anisotropy(nodes, m.radius);
  return m;
}

}  // namespace moire
