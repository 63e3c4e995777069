// The windows' closed forms and their bounds over ellipses. Sums of cosines share one form; the others have their own.
#include "filters/window.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

#include "core/dd_math.h"
#include "filters/cosine_sum.h"

namespace moire {
namespace {

Dd welch(Dd t, double) { return Dd(1) - t * t; }
double welch_bound(const Ellipse& e, double) { return 1 + e.reach() * e.reach(); }

Dd bartlett(Dd t, double) { return Dd(1) - dd_abs(t); }
double bartlett_bound(const Ellipse& e, double) { return 1 + e.reach(); }

Dd cosine(Dd t, double) { return dd_cos_pi(Dd(0.5) * t); }
double cosine_bound(const Ellipse& e, double) { return cos_pi_bound(e.imaginary / 2); }

Dd bohman(Dd t, double) {
  const Dd a = dd_abs(t);
  const CosSin r = dd_cos_sin_pi(a);
  return (Dd(1) - a) * r.cos + r.sin / kPi;
}
double bohman_bound(const Ellipse& e, double) {
  return (1 + e.reach() + 1 / std::numbers::pi) * cos_pi_bound(e.imaginary);
}

// The cubic B-spline with knots at 0, +-1/2 and +-1.
Dd parzen(Dd t, double) {
  const Dd a = Dd(2) * dd_abs(t), s = Dd(2) - a;
  return a.hi < 1 ? Dd(2) / Dd(3) - a * a * (Dd(1) - Dd(0.5) * a) : s * s * s / Dd(6);
}
double parzen_bound(const Ellipse& e, double) {
  const double a = 2 * e.reach();
  return std::max(2.0 / 3 + a * a * (1 + a / 2), (2 + a) * (2 + a) * (2 + a) / 6);
}

Dd kaiser(Dd t, double beta) {
  const Dd square = Dd(beta) * Dd(beta);
  return dd_bessel_i0_of_root(square * (Dd(1) - t * t)) / dd_bessel_i0_of_root(square);
}
// |I0(w)| <= exp(|Re w|) and w^2 = beta^2 (p - i q) with p = 1 - u^2 + v^2, q = 2 u v at t = u + i v, so that
// (Re w)^2 = beta^2 (|p - i q| + p) / 2, which grows with p and with |q|.
double kaiser_bound(const Ellipse& e, double beta) {
  const double nearest = std::max(0.0, std::fabs(e.mid) - e.real);
  const double p = 1 - nearest * nearest + e.imaginary * e.imaginary, q = 2 * e.reach() * e.imaginary;
  const double middle = dd_bessel_i0_of_root(Dd(beta) * Dd(beta)).value();
  return std::exp(beta * std::sqrt((std::hypot(p, q) + p) / 2)) / middle;
}

}  // namespace

struct Window::Kind {
  std::string_view name;
  std::span<const double> cosines;  // of a sum of cosines; empty where the window has its own form
  Dd (*form)(Dd t, double beta);
  double (*bound)(const Ellipse& e, double beta);
};

namespace {
constexpr double kHann[] = {0.5, 0.5}, kHamming[] = {0.54, 0.46}, kBlackman[] = {0.42, 0.5, 0.08};
}  // namespace

constexpr Window::Kind Window::kKinds[] = {
    {"hann", kHann, nullptr, nullptr},          {"hamming", kHamming, nullptr, nullptr},
    {"blackman", kBlackman, nullptr, nullptr},  {"kaiser", {}, kaiser, kaiser_bound},
    {"welch", {}, welch, welch_bound},          {"bohman", {}, bohman, bohman_bound},
    {"cosine", {}, cosine, cosine_bound},       {"blackman-harris", kBlackmanHarris, nullptr, nullptr},
    {"bartlett", {}, bartlett, bartlett_bound}, {"parzen", {}, parzen, parzen_bound}};

Window::Window(std::string_view name, double beta)
    : kind_(std::find_if(std::begin(kKinds), std::end(kKinds), [&](const Kind& k) { return k.name == name; })),
      beta_(beta) {
  assert(kind_ != std::end(kKinds));
}

Dd Window::operator()(Dd t) const {
  return kind_->form == nullptr ? cosine_sum(kind_->cosines, t) : kind_->form(t, beta_);
}

double Window::ellipse_bound(const Ellipse& e) const {
  return kind_->bound == nullptr ? cosine_sum_bound(kind_->cosines, e.imaginary) : kind_->bound(e, beta_);
}

bool Window::breaks_halfway() const { return kind_->form == parzen; }

}  // namespace moire
