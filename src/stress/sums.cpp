// Hard sums: compensated sums, signs of expansions, double-double arithmetic, the means of an image's errors and the
// moments over trials, against arithmetic without error.
//
// Limits where the program claims none: of the means (ErrorTally) the roundings counted in error_means(), of the
// moments (TrialMoments) Wilkinson's running error analysis of Welford's updates; Higham, "Accuracy and Stability of
// Numerical Algorithms", 2002, section 3.3.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/double_double.h"
#include "core/expansion.h"
#include "core/rounding.h"
#include "core/sum.h"
#include "measure/error.h"
#include "measure/statistics.h"
#include "stress/chance.h"
#include "stress/exact_sum.h"
#include "stress/family.h"
#include "stress/hard_sequence.h"
#include "stress/long_sum.h"
#include "stress/worst.h"

namespace moire::stress {
namespace {

using oracle::Quad;

constexpr std::uint64_t kLongTerms = 10'000'000;
constexpr double kNothingLeft = 1e45;    // severity where a sum is zero
constexpr double kQuadError = 0x1p-110;  // of a value and a few operations more, relative

double to_double(Quad q) { return static_cast<double>(q); }

double absolute_sum(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += std::fabs(v);
  return sum * (1 + static_cast<double>(x.size()) * 0x1p-50);  // never below the true one
}

// A value whose error is known without error.
Measured measured(std::string_view quantity, double at, double computed, Quad wanted, double bound) {
  Measured m;
  m.quantity = quantity;
  m.at = at;
  m.computed = computed;
  m.wanted = to_double(wanted);
  m.error = to_double(oracle::abs(oracle::widen(computed) - wanted));
  m.bound = bound;
  m.oracle_error = kQuadError * std::fabs(m.wanted);
  return m;
}

// In units of the power of two next to `size`, so that cases of all sizes stand in one table; nothing is rounded.
Measured in_units_of(double size, Measured m) {
  int exponent = 0;
  std::frexp(size, &exponent);
  for (double* v : {&m.computed, &m.wanted, &m.error, &m.bound, &m.oracle_error, &m.naive_error}) {
    *v = std::ldexp(*v, -exponent);
  }
  return m;
}

using Case = ManyValues;

std::vector<double> sequence(Chance& chance, Case& c) {
  const auto n = 6 + chance.below(chance.below(8) == 0 ? 5000 : 300);
  const int bits = static_cast<int>(chance.below(136));  // condition numbers to 1e40
  c.text = fmt::format("{} terms, condition about 2^{}", n, bits);
  return hard_sequence(chance, n, bits);
}

void compensated_sum(Chance& chance, Case& c) {
  const std::vector<double> x = sequence(chance, c);
  ExactSum exact;
  Sum sum;
  double naive = 0;
  for (const double v : x) {
    exact.add(v);
    sum.add(v);
    naive += v;
  }
  const Quad truth = exact.value();
  const double n = static_cast<double>(x.size()), absolute = absolute_sum(x);
  Measured m = measured("sum", 0, sum.value(), truth, kUnit * std::fabs(sum.value()) + n * n * 0x1p-106 * absolute);
  m.error = to_double(exact.distance_to(sum.value()));
  m.naive_error = to_double(exact.distance_to(naive));
  c.worst.see(in_units_of(absolute, m));
  c.severity = truth == 0 ? kNothingLeft : absolute / std::fabs(to_double(truth));
}

// Terms and products that cancel, the last of them to nothing or to one digit of the smallest.
void expansion_sign(Chance& chance, Case& c) {
  std::vector<double> x = sequence(chance, c);
  std::vector<std::pair<double, double>> products;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const double a = chance.sign() * chance.decades(1e-30, 1e30), b = chance.between(-1, 1);
    products.emplace_back(a, b);
    products.emplace_back(-b, a);
  }
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) x.push_back(-x[i]);
  const double left = static_cast<double>(static_cast<int>(chance.below(3)) - 1) * 0x1p-900;
  x.push_back(left);
  for (std::size_t i = x.size() - 1; i > 0; --i) std::swap(x[i], x[chance.below(i + 1)]);
  Expansion expansion;
  double naive = 0;
  for (const double v : x) {
    expansion.add(v);
    naive += v;
  }
  for (const auto& [a, b] : products) {
    expansion.add_product(a, b);
    naive += a * b;
  }
  const auto sign = [](double v) { return static_cast<double>((v > 0) - (v < 0)); };
  Measured m = measured("sign", 0, expansion.sign(), oracle::widen(sign(left)), 0);
  m.oracle_error = 0;
  m.naive_error = std::fabs(sign(naive) - sign(left));
  c.worst.see(m);
  c.severity = left == 0 ? kNothingLeft : std::min(kNothingLeft, absolute_sum(x) / std::fabs(left));
  c.text += fmt::format(", twice with opposite signs, and {:.17g}", left);
}

Dd pair(double hi, double lo) { return quick_two_sum(hi, lo); }

// Relative errors in units of 1; the claims of double_double.h.
void double_double(Chance& chance, Case& c) {
  const double hi = chance.sign() * chance.decades(1e-60, 1e60);
  const auto low_part = [&](double high) {
    return chance.below(4) == 0 ? 0 : high * kUnit * chance.between(-1, 1) * chance.decades(1e-12, 1);
  };
  const Dd a = pair(hi, low_part(hi));
  double other = chance.sign() * chance.decades(1e-60, 1e60);
  const auto kind = chance.below(3);
  if (kind == 0) other = -hi;                                                   // only the low parts are left
  if (kind == 1) other = -hi * (1 + chance.sign() * chance.decades(1e-16, 1));  // some digits cancel
  const Dd b = pair(other, low_part(other));
  c.text = fmt::format("a = {:.17g} + {:.17g}, b = {:.17g} + {:.17g}", a.hi, a.lo, b.hi, b.lo);

  const auto see = [&](std::string_view what, Dd got, ExactSum exact, Quad scale, double claim, double naive_error) {
    // exact - got, in units of `scale`, the true value but for division.
    ExactSum rest = exact;
    rest.add(-got.hi);
    rest.add(-got.lo);
    const Quad size = oracle::abs(scale);
    Measured m;
    m.quantity = what;
    if (size == 0) {
      m.error = got.hi == 0 && got.lo == 0 ? 0 : 1;
    } else {
      m.error = to_double(oracle::abs(rest.value()) / size);
      m.naive_error = naive_error;
    }
    m.bound = claim * (1 + 0x1p-40);
    m.wanted = 1;  // so that a relative error is told as one
    m.computed = 1 + m.error;
    c.worst.see(m);
  };
  ExactSum sum, product;
  for (const double v : {a.hi, a.lo, b.hi, b.lo}) sum.add(v);
  for (const double v : {a.hi, a.lo})
    for (const double w : {b.hi, b.lo}) product.add_product(v, w);
  const auto missed = [](const ExactSum& exact, double naive, Quad scale) {
    return scale == 0 ? std::numeric_limits<double>::quiet_NaN()
                      : to_double(exact.distance_to(naive) / oracle::abs(scale));
  };
  see("a + b", a + b, sum, sum.value(), 3 * 0x1p-106, missed(sum, a.hi + b.hi, sum.value()));
  see("a * b", a * b, product, product.value(), 5 * 0x1p-106, missed(product, a.hi * b.hi, product.value()));
  // (a / b) b - a, exactly; over a it is the relative error of the quotient.
  const Dd q = a / b;
  ExactSum back;
  for (const double v : {q.hi, q.lo})
    for (const double w : {b.hi, b.lo}) back.add_product(v, w);
  see("a / b", a, back, oracle::widen(a.hi) + oracle::widen(a.lo), 10 * 0x1p-106,
      std::numeric_limits<double>::quiet_NaN());
  const Quad total = oracle::abs(sum.value());
  c.severity = total == 0 ? kNothingLeft : std::max(1.0, std::fabs(a.hi) / to_double(total));
}

// Bias, mean |error| and mean square of an image. Each row is a sum of its own, rounded once, and these are added.
void error_means(Chance& chance, Case& c) {
  const auto width = 1 + chance.below(60), height = 1 + chance.below(20);
  const double offset = chance.decades(1e-3, 1e15), spread = chance.decades(1e-12, 1e3);
  const bool alternate = chance.coin();
  c.text = fmt::format("errors of {} x {} pixels, {:.17g} and a spread of {:.17g}{}", width, height, offset, spread,
                       alternate ? ", of either sign" : "");
  ErrorTally tally;
  ExactSum error, size, squared;
  double naive = 0, naive_square = 0, rows = 0, all = 0;
  for (std::uint64_t y = 0; y < height; ++y) {
    double row = 0;
    for (std::uint64_t x = 0; x < width; ++x) {
      const double base = alternate && (x + y) % 2 != 0 ? -offset : offset;
      const double e = base + spread * chance.between(-1, 1);
      tally.add(static_cast<std::int64_t>(x), static_cast<std::int64_t>(y), e, 0);
      error.add(e);
      size.add(std::fabs(e));
      squared.add_product(e, e);
      naive += e;
      naive_square += e * e;
      row += e;
      all += std::fabs(e);
    }
    rows += std::fabs(row);
  }
  const Errors got = tally.finish();
  const double n = static_cast<double>(width * height);
  const auto count = static_cast<Quad>(n);
  all *= 1 + n * 0x1p-50;
  rows += all * n * 0x1p-52;
  // Half an ulp for each row's sum, one for the total and one for the quotient; n^2 2^-106 of all terms for the rest,
  // in rows and over them.
  const double rest = 2 * n * n * 0x1p-106;
  const double bias = (kUnit * rows + rest * all) / n + 2.01 * kUnit * std::fabs(got.bias);
  Measured m = measured("bias", 0, got.bias, error.value() / count, bias);
  m.oracle_error = kQuadError * all / n;
  m.naive_error = to_double(oracle::abs(oracle::widen(naive / n) - error.value() / count));
  c.worst.see(in_units_of(all / n, m));
  // Of positive terms: row, total, quotient; the squares are rounded, too.
  c.worst.see(in_units_of(all / n, measured("mae", 0, got.mae, size.value() / count, (3.01 * kUnit + rest) * got.mae)));
  m = measured("mse", 0, got.mse, squared.value() / count, (4.01 * kUnit + rest) * got.mse);
  m.naive_error = to_double(oracle::abs(oracle::widen(naive_square / n) - squared.value() / count));
  c.worst.see(in_units_of(got.mse, m));
  const double sum = std::fabs(to_double(error.value()));
  c.severity = sum == 0 ? kNothingLeft : std::max(1.0, all / sum);
}

// What rounding does to Welford's updates of one pixel, followed step by step.
class WelfordBound {
 public:
  void add(double x) {
    const double t = ++trials_;
    const double from_old = x - mean_, before = mean_error_ + kUnit * std::fabs(from_old);
    mean_ += from_old / t;
    mean_error_ = mean_error_ * (1 - 1 / t) + 2 * kUnit * std::fabs(from_old) / t + kUnit * std::fabs(mean_);
    const double from_new = x - mean_, after = mean_error_ + kUnit * std::fabs(from_new);
    m2_ += from_old * from_new;
    m2_error_ += std::fabs(from_old) * after + std::fabs(from_new) * before + before * after +
                 kUnit * (std::fabs(from_old * from_new) + m2_);
  }
  // First order, so a little is added for the rest, and for the rounding of this itself.
  double mean_error() const { return 1.001 * mean_error_; }
  double m2_error() const { return 1.001 * m2_error_; }

 private:
  double trials_ = 0, mean_ = 0, m2_ = 0, mean_error_ = 0, m2_error_ = 0;
};

void trial_moments(Chance& chance, Case& c) {
  const auto pixels = 1 + chance.below(4), trials = 2 + chance.below(chance.below(8) == 0 ? 400 : 40);
  const double offset = chance.sign() * chance.decades(1e-3, 1e12), ratio = chance.decades(1e-15, 10);
  c.text = fmt::format("{} trials of {} pixels at {:.17g}, spread {:.17g}", trials, pixels, offset,
                       std::fabs(offset) * ratio);
  std::vector<std::vector<double>> x(trials, std::vector<double>(pixels));
  TrialMoments moments(pixels);
  for (auto& trial : x) {
    for (double& v : trial) v = offset * (1 + ratio * chance.between(-1, 1));
    moments.add(trial);
  }
  const Split got = moments.split();

  const auto n = static_cast<double>(pixels), t = static_cast<double>(trials);
  Quad square = 0, deviations = 0;
  double mean_bound = 0, m2_bound = 0, oracle_mean = 0, oracle_m2 = 0, naive_deviations = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    ExactSum sum;
    WelfordBound bound;
    double s1 = 0, s2 = 0;
    for (const auto& trial : x) {
      sum.add(trial[p]);
      bound.add(trial[p]);
      s1 += trial[p];
      s2 += trial[p] * trial[p];
    }
    const Quad mean = sum.value() / static_cast<Quad>(t);
    const double size = std::fabs(to_double(mean)), missed = kQuadError * size;
    for (const auto& trial : x) {
      const Quad d = oracle::widen(trial[p]) - mean;
      deviations += d * d;
      oracle_m2 += 2 * std::fabs(to_double(d)) * missed + missed * missed;
    }
    square += mean * mean;
    mean_bound += 2 * size * bound.mean_error() + bound.mean_error() * bound.mean_error() + kUnit * size * size;
    m2_bound += bound.m2_error();
    oracle_mean += 2 * size * missed;
    naive_deviations += s2 - s1 * s1 / t;
  }
  const Quad quad_n = static_cast<Quad>(n), quad_t = static_cast<Quad>(t);
  const Quad variance = deviations / (quad_t - 1) / quad_n;
  const auto see = [&](std::string_view what, double computed, Quad wanted, double bound, double naive,
                       double oracle_error) {
    Measured m = measured(what, 0, computed, wanted, bound);
    m.oracle_error += oracle_error;
    m.naive_error = to_double(oracle::abs(oracle::widen(naive) - wanted));
    c.worst.see(in_units_of(offset * offset, m));
  };
  const double mean_square = to_double(square / quad_n), v = to_double(variance);
  // Sums of pixels are rounded once, each quotient and the last operation once more.
  const double variance_bound = m2_bound / (t - 1) / n + 3.01 * kUnit * v;
  const double square_bound = mean_bound / n + 2.01 * kUnit * mean_square;
  const double naive = naive_deviations / (t - 1) / n;
  see("variance", got.variance, variance, variance_bound, naive, oracle_m2 / (t - 1) / n);
  see("mse", got.mse, (square + deviations / quad_t) / quad_n,
      square_bound + m2_bound / t / n + 2.01 * kUnit * to_double(deviations / quad_t / quad_n) + 2.01 * kUnit * got.mse,
      got.mse, oracle_mean / n + oracle_m2 / t / n);
  see("bias_sq", got.bias_sq, square / quad_n - variance / quad_t,
      square_bound + variance_bound / t + 1.01 * kUnit * v / t + 1.01 * kUnit * std::fabs(got.bias_sq),
      mean_square - naive / t, oracle_mean / n + oracle_m2 / (t - 1) / n / t);
  c.severity = std::max(1.0, 1 / ratio);
}

Case run_kind(CaseKey key) {
  constexpr void (*kKinds[])(Chance&, Case&) = {compensated_sum, expansion_sign, double_double, error_means,
                                                trial_moments};
  Case c;
  Chance chance("sums", key);
  kKinds[key.index % std::size(kKinds)](chance, c);
  return c;
}

bool is_long(CaseKey key) { return key.index == 0; }

Outcome run(CaseKey key) {
  if (is_long(key)) return long_sum(kLongTerms, key);
  return run_kind(key).outcome();
}

std::string describe(CaseKey key) {
  if (is_long(key)) return fmt::format("sum of {} terms, condition about 2^44 (long_sum.h)", kLongTerms);
  const Case c = run_kind(key);
  return fmt::format("{} of {}", c.worst.worst().quantity, c.text);
}

}  // namespace

extern const Family sums;
constinit const Family sums = {
    .name = "sums",
    .title = "ill-conditioned sums, cancelling products, moments at huge offsets, 10^7 terms",
    .quantity = "value in units of the terms' size (double-double: relative; expansions: the sign)",
    .severity = "condition number",
    .claim = "core/sum.h, expansion.h, double_double.h; means: roundings counted; moments: running error analysis",
    .share = 1,
    .run = run,
    .describe = describe};

}  // namespace moire::stress
