// Definitions: box, tent; Mitchell and Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988, eq. 8;
// Catmull-Rom as its b = 0, c = 1/2; the Gaussian cut at its radius, lowered to zero there or not.
#include "oracle/kernel.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/args.h"

namespace moire::oracle {
namespace {

long double given(const Spec& spec, std::string_view key, long double fallback) {
  for (const auto& [name, value] : spec.given)
    if (name == key) {
      double number = 0;  // the parameter is the double that the program reads, not the decimal
      if (!parse_number(value.text, number)) throw std::invalid_argument("number");
      return static_cast<long double>(number);
    }
  return fallback;
}

std::string_view given_text(const Spec& spec, std::string_view key, std::string_view fallback) {
  for (const auto& [name, value] : spec.given)
    if (name == key) return value.text;
  return fallback;
}

std::function<long double(long double)> cubic(long double b, long double c) {
  return [b, c](long double x) {
    if (x < 1) return (((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b)) / 6;
    return ((((-b - 6 * c) * x + (6 * b + 30 * c)) * x + (-12 * b - 48 * c)) * x + (8 * b + 24 * c)) / 6;
  };
}

}  // namespace

Kernel::Kernel(std::string_view text) : inner_(6), line_rules_{Rule(6), Rule(9)} {
  const Spec spec = parse_spec(text, "oracle");
  if (spec.name == "box") {
    const long double half = given(spec, "width", 1) / 2;
    knots_ = {-half, half};
    shape_ = [](long double) { return 1.0L; };
  } else if (spec.name == "tent") {
    const long double r = given(spec, "radius", 1);
    knots_ = {-r, 0, r};
    shape_ = [r](long double x) { return r - x; };
  } else if (spec.name == "mitchell" || spec.name == "catmull-rom") {
    const bool rom = spec.name == "catmull-rom";
    knots_ = {-2, -1, 0, 1, 2};
    shape_ = cubic(rom ? 0 : given(spec, "b", 1.0L / 3), rom ? 0.5L : given(spec, "c", 1.0L / 3));
  } else if (spec.name == "gaussian") {
    long double sigma = given(spec, "sigma", 0.5L), r = given(spec, "radius", 1.5L);
    bool lowered = given_text(spec, "cut", "offset") == "offset";
    struct Preset {
      std::string_view name;
      long double sigma, radius;
      bool lowered;
    };
    // The table of presets in the filter's documentation, as w / 4 and such where a system gives it so.
    for (const Preset& p : {Preset{"mitsuba", 0.5L, 2, true},
                            {"imagemagick", 0.5L, 2, false},
                            {"ospray", 0.5L, 1.5L, false},
                            {"renderman", 0.5L, 1, false},
                            {"arnold", 0.5L, 1, false},
                            {"cycles", 0.375L, 2.25L, false},
                            {"oiio", 0.75L, 1.5L, false},
                            {"oiio-sharp", static_cast<long double>(std::sqrt(0.125)), 1, false}})
      if (given_text(spec, "preset", "none") == p.name) {
        sigma = p.sigma;
        r = p.radius;
        lowered = p.lowered;
      }
    const auto bell = [sigma](long double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    const long double foot = lowered ? bell(r) : 0;
    shape_ = [bell, foot](long double x) { return bell(x) - foot; };
    // Pieces of at most 1.5 sigma: there 16 nodes leave less than 1e-20 of the integral (oracle_test checks).
    const int half_pieces = static_cast<int>(std::ceil(r / (1.5L * sigma)));
    for (int i = -half_pieces; i <= half_pieces; ++i)
      knots_.push_back(r * static_cast<long double>(i) / static_cast<long double>(half_pieces));
    polynomial_ = false;
    inner_ = Rule(16);
    line_rules_ = {Rule(14), Rule(20)};
  } else if (spec.name == "bspline") {
    // By the recurrence of de Boor and Cox on integer knots, degree by degree: no truncated powers.
    const int order = static_cast<int>(given(spec, "order", 3));
    const long double r = (static_cast<long double>(order) + 1) / 2;
    for (int i = 0; i <= order + 1; ++i) knots_.push_back(static_cast<long double>(i) - r);
    shape_ = [order, r](long double x) {
      const long double s = r - x;  // from the right end, by symmetry
      const int cell = std::min(static_cast<int>(std::floor(s)), order);
      std::vector<long double> b(static_cast<std::size_t>(order) + 2, 0);
      if (cell >= 0) b[static_cast<std::size_t>(cell)] = 1;
      for (int d = 1; d <= order; ++d)
        for (int i = 0; i <= order - d; ++i) {
          const auto at = static_cast<std::size_t>(i);
          const long double left = s - static_cast<long double>(i), right = static_cast<long double>(i + d + 1) - s;
          b[at] = (left * b[at] + right * b[at + 1]) / static_cast<long double>(d);
        }
      return b[0];
    };
  } else if (spec.name == "lanczos" || spec.name == "blackman-harris") {
    const long double pi = 3.14159265358979323846264338327950288L;
    if (spec.name == "lanczos") {
      const long double a = given(spec, "a", 3);
      for (long double i = -2 * a; i <= 2 * a; ++i) knots_.push_back(i / 2);
      shape_ = [a, pi](long double x) {
        const auto sinc = [pi](long double t) { return t == 0 ? 1 : std::sin(pi * t) / (pi * t); };
        return sinc(x) * sinc(x / a);
      };
    } else {
      const long double r = given(spec, "width", 4) / 2;
      for (int i = -4; i <= 4; ++i) knots_.push_back(r * static_cast<long double>(i) / 4);
      // The published coefficients, as the doubles nearest to them.
      shape_ = [r, pi](long double x) {
        const long double t = pi * x / r;
        return static_cast<long double>(0.35875) + static_cast<long double>(0.48829) * std::cos(t) +
               static_cast<long double>(0.14128) * std::cos(2 * t) +
               static_cast<long double>(0.01168) * std::cos(3 * t);
      };
    }
    polynomial_ = false;
    inner_ = Rule(16);
    line_rules_ = {Rule(14), Rule(20)};
  } else {
    throw std::invalid_argument("the oracle has no kernel " + spec.name);
  }
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    mass_.push_back(0);
    const long double mid = (knots_[i] + knots_[i + 1]) / 2, half = (knots_[i + 1] - knots_[i]) / 2;
    for (std::size_t n = 0; n < inner_.x.size(); ++n)
      mass_[i] += half * inner_.w[n] * (*this)(mid + half * inner_.x[n]);
  }
  long double total = 0;
  for (const long double m : mass_) total += m;
  scale_ = 1 / total;
  gain_ = 0;
  for (long double& m : mass_) {
    m *= scale_;
    gain_ += std::fabs(m);  // every kernel here keeps its sign between knots
  }
}

long double Kernel::over(long double a, long double b) const {
  long double sum = 0;
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const long double lo = std::max(a, knots_[i]), hi = std::min(b, knots_[i + 1]);
    if (lo >= hi) continue;
    if (lo == knots_[i] && hi == knots_[i + 1]) {
      sum += mass_[i];
      continue;
    }
    const long double mid = (lo + hi) / 2, half = (hi - lo) / 2;
    long double part = 0;
    for (std::size_t n = 0; n < inner_.x.size(); ++n) part += inner_.w[n] * (*this)(mid + half * inner_.x[n]);
    sum += part * half;
  }
  return sum;
}

long double Kernel::ripple() const {
  long double worst = 0;
  const int reach = static_cast<int>(std::ceil(radius())) + 1;
  for (int phase = 0; phase < 64; ++phase) {
    const long double x0 = (static_cast<long double>(phase) + 0.5L) / 64;
    long double sum = 0;
    for (int j = -reach; j <= reach; ++j) {
      const long double x = x0 + static_cast<long double>(j);
      if (x >= -radius() && x < radius()) sum += (*this)(x);
    }
    worst = std::max(worst, std::fabs(sum - 1));
  }
  return worst;
}

}  // namespace moire::oracle
