// Kernels and their integrals in ball arithmetic.
#include "stress/ball_kernel.h"

#include <acb.h>
#include <acb_calc.h>
#include <acb_hypgeom.h>
#include <arb.h>
#include <arb_hypgeom.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "stress/form_of_filter.h"

namespace moire::stress {
namespace {

using oracle::Quad;

constexpr slong kBits = 192;  // of midpoints: radii stay far below what is to be judged, whatever cancels
constexpr slong kGoal = 128;  // bits of integrals
constexpr double kQuadRounding = 0x1p-111;

// A complex number and how far off it may be. Complex because the rules bound integrands over ellipses.
class Ball {
 public:
  Ball() { acb_init(v_); }
  explicit Ball(double x) : Ball() { acb_set_d(v_, x); }
  Ball(const Ball& o) : Ball() { acb_set(v_, o.v_); }
  Ball(Ball&& o) noexcept : Ball() { acb_swap(v_, o.v_); }
  Ball& operator=(Ball o) noexcept {
    acb_swap(v_, o.v_);
    return *this;
  }
  ~Ball() { acb_clear(v_); }

  acb_struct* get() { return v_; }
  const acb_struct* get() const { return v_; }

 private:
  acb_t v_;
};

// The results of functions f(out, in..., bits).
template <class F, class... In>
Ball ball(const F& f, const In&... in) {
  Ball out;
  f(out.get(), in.get()..., kBits);
  return out;
}

Ball operator+(const Ball& a, const Ball& b) { return ball(acb_add, a, b); }
Ball operator-(const Ball& a, const Ball& b) { return ball(acb_sub, a, b); }
Ball operator*(const Ball& a, const Ball& b) { return ball(acb_mul, a, b); }
Ball operator/(const Ball& a, const Ball& b) { return ball(acb_div, a, b); }

// What filter_forms.h asks of a number.
Ball sin_pi(const Ball& x) { return ball(acb_sin_pi, x); }
Ball cos_pi(const Ball& x) { return ball(acb_cos_pi, x); }
Ball exp_of(const Ball& x) { return ball(acb_exp, x); }
Ball sinc_of(const Ball& x) { return ball(acb_sinc, x); }
Ball sinc_pi(const Ball& x) { return ball(acb_sinc_pi, x); }
Ball pi_of(const Ball&) {
  Ball out;
  acb_const_pi(out.get(), kBits);
  return out;
}
// 0F1(order + 1; z) over gamma(order + 1), entire: I0(sqrt(s)) with z = s / 4, J1(y) / (y / 2) with z = -y^2 / 4.
Ball confluent(double parameter, const Ball& z) {
  Ball out;
  acb_hypgeom_0f1(out.get(), Ball(parameter).get(), z.get(), 0, kBits);
  return out;
}
Ball bessel_i0_of_root(const Ball& s) { return confluent(1, s / Ball(4.0)); }
Ball jinc(const Ball& x) {
  const Ball half = pi_of(x) * x / Ball(2.0);
  return confluent(2, Ball(0.0) - half * half);
}

// The zero of J1 of this number over pi, to the nearest double: by bisection, signs of balls far smaller than the jinc.
double zero_of_jinc(int number) {
  const auto is_negative = [](double x) { return arf_sgn(arb_midref(acb_realref(jinc(Ball(x)).get()))) < 0; };
  double lo = number + 0.1, hi = number + 0.3;  // McMahon: number + 1/4 less 0.038 / number and smaller terms
  const bool before = is_negative(lo);
  while (std::nextafter(lo, hi) < hi) {
    const double middle = 0.5 * (lo + hi);
    (is_negative(middle) == before ? lo : hi) = middle;
  }
  // Of the two neighbours, the sign half way between them says which is nearer.
  const Ball middle = (Ball(lo) + Ball(hi)) / Ball(2.0);
  const bool beyond = (arf_sgn(arb_midref(acb_realref(jinc(middle).get()))) < 0) == before;
  return beyond ? hi : lo;
}

Enclosed enclosed(const Ball& b) {
  const arb_struct* real = acb_realref(b.get());
  // The midpoint in three doubles, 113 bits and more.
  Quad value = 0;
  arf_t rest, part;
  arf_init(rest);
  arf_init(part);
  arf_set(rest, arb_midref(real));
  for (int i = 0; i < 3; ++i) {
    const double digits = arf_get_d(rest, ARF_RND_NEAR);
    value += oracle::widen(digits);
    arf_set_d(part, digits);
    arf_sub(rest, rest, part, kBits, ARF_RND_NEAR);
  }
  arf_clear(rest);
  arf_clear(part);
  const double size = std::fabs(static_cast<double>(value));
  return {value, mag_get_d(arb_radref(real)) + kQuadRounding * size + std::numeric_limits<double>::denorm_min()};
}

struct Integrand {
  const Form<Ball>* form;
  int piece;
  bool moment;                  // times x
  std::optional<Ball> stretch;  // of f(r u) u over u; none: of f(x)
};

int integrand(acb_ptr out, const acb_t at, void* parameter, slong, slong) {
  const auto& f = *static_cast<const Integrand*>(parameter);
  Ball x;
  acb_set(x.get(), at);
  Ball value = f.form->shape(f.piece, f.stretch ? *f.stretch * x : x);
  if (f.moment) value = value * x;
  acb_set(out, value.get());
  return 0;
}

Ball integral(Integrand f, const Ball& a, const Ball& b) {
  Ball out;
  mag_t tolerance;
  mag_init(tolerance);
  mag_set_ui_2exp_si(tolerance, 1, -kGoal - 40);
  acb_calc_integrate(out.get(), integrand, &f, a.get(), b.get(), kGoal, tolerance, nullptr, kBits);
  mag_clear(tolerance);
  return out;
}

}  // namespace

struct BallKernel::Data {
  Form<Ball> form;
  Form<double> naive;
  bool radial;
  std::vector<Ball> before;  // integral of the shape, times x if radial, up to each break
  Ball whole;                // over the line or the plane

  int pieces() const { return static_cast<int>(form.breaks.size()) - 1; }
  Ball up_to(int piece, double x) const {
    const auto i = static_cast<std::size_t>(piece);
    return before[i] + integral({&form, piece, radial, {}}, Ball(form.breaks[i]), Ball(x));
  }
  // The piece that x >= 0 lies in, that on the right at a break; on the left if `mirrored`.
  int piece_of(double x, bool mirrored) const {
    int piece = 0;
    while (piece + 1 < pieces()) {
      const double next = form.breaks[static_cast<std::size_t>(piece) + 1];
      if (mirrored ? x <= next : x < next) break;
      ++piece;
    }
    return piece;
  }
};

BallKernel::BallKernel(const Filter& filter) : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.form = form_of<Ball>(filter, zero_of_jinc);
  d.naive = form_of<double>(filter, zero_of_jinc);
  d.radial = filter.is_radial();
  d.before.emplace_back(0.0);
  for (int piece = 0; piece < d.pieces(); ++piece) {
    d.before.push_back(d.up_to(piece, d.form.breaks[static_cast<std::size_t>(piece) + 1]));
  }
  d.whole = Ball(2.0) * d.before.back();
  if (d.radial) d.whole = d.whole * pi_of(d.whole);
}

BallKernel::~BallKernel() = default;

double BallKernel::radius() const { return data_->form.breaks.back(); }

Enclosed BallKernel::k(double x) const {
  if (!(x >= -radius() && x < radius())) return {};
  const double size = std::fabs(x);
  return enclosed(data_->form.shape(data_->piece_of(size, x < 0), Ball(size)) / data_->whole);
}

double BallKernel::naive_k(double x) const {
  if (!(x >= -radius() && x < radius())) return 0;
  const double size = std::fabs(x), whole = static_cast<double>(enclosed(data_->whole).value);
  return data_->naive.shape(data_->piece_of(size, x < 0), size) / whole;
}

Enclosed BallKernel::K(double x) const {
  if (x <= -radius()) return {};
  if (x >= radius()) return {1, 0};
  const double size = std::fabs(x);
  const Ball half = data_->up_to(data_->piece_of(size, false), size) / data_->whole;
  return enclosed(x < 0 ? Ball(0.5) - half : Ball(0.5) + half);
}

Enclosed BallKernel::G(double r) const {
  if (r >= radius()) return enclosed(Ball(0.5) / pi_of(Ball()));
  return enclosed(data_->up_to(data_->piece_of(r, false), r) / data_->whole);
}

Enclosed BallKernel::q(double r) const {
  if (r >= radius()) return enclosed(Ball(0.5) / pi_of(Ball()) / (Ball(r) * Ball(r)));
  const int piece = data_->piece_of(r, false);
  // From 0 on as the integral of k(r u) u over u: nothing is divided by r.
  if (piece == 0) {
    return enclosed(integral({&data_->form, 0, true, Ball(r)}, Ball(0.0), Ball(1.0)) / data_->whole);
  }
  return enclosed(data_->up_to(piece, r) / data_->whole / (Ball(r) * Ball(r)));
}

}  // namespace moire::stress
