// Hard kernels: every filter with the extremes of its parameters, at its knots, one ulp beside them, at the ends of the
// support and beyond, against ball arithmetic.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/args.h"
#include "core/error.h"
#include "filters/filter.h"
#include "stress/ball_kernel.h"
#include "stress/chance.h"
#include "stress/family.h"
#include "stress/worst.h"

namespace moire::stress {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The filters that need no file.
std::vector<const FilterInfo*> without_files() {
  std::vector<const FilterInfo*> all;
  for (const FilterInfo* info : filters()) {
    const auto required = [](const Param& p) { return p.required; };
    if (std::none_of(info->params.begin(), info->params.end(), required)) all.push_back(info);
  }
  return all;
}

std::string chosen_word(Chance& chance, std::string_view choices) {
  std::vector<std::string> words(1);
  for (const char c : choices) {
    if (c == '|') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return chance.pick(words);
}

// An end of the range, a number next to it, or any.
std::string chosen_number(Chance& chance, const Param& p) {
  if (p.kind == Param::Kind::integer) {
    const auto count = static_cast<std::uint64_t>(p.max - p.min) + 1;
    return shortest(p.min + static_cast<double>(chance.below(count)));
  }
  switch (chance.below(5)) {
    case 0:
      return shortest(p.min);
    case 1:
      return shortest(p.max);
    case 2:
      return shortest(std::nextafter(chance.coin() ? p.min : p.fallback, p.max));
    case 3:
      return shortest(p.min > 0 ? chance.decades(p.min, p.max) : chance.between(p.min, p.max));
    default:
      return shortest(chance.between(p.min, p.max));
  }
}

// A filter with some parameters given; presets stand alone, but for the window that one applies to.
std::string chosen_text(Chance& chance, const FilterInfo& info) {
  const bool by_preset = chance.below(4) == 0;
  std::string keys;
  const auto give = [&](const Param& p, const std::string& value) {
    keys += fmt::format("{}{}={}", keys.empty() ? ":" : ",", p.name, value);
  };
  for (const Param& p : info.params) {
    if (p.name == "preset") {
      if (by_preset) give(p, chosen_word(chance, p.choices));
    } else if (p.kind == Param::Kind::choice) {
      if (!(by_preset && p.name != "window")) give(p, chosen_word(chance, p.choices));
    } else if (!by_preset && chance.below(4) != 0) {
      give(p, chosen_number(chance, p));
    }
  }
  return std::string(info.name) + keys;
}

// Some parameters together are refused (an integral that is nearly zero): then others are drawn.
Filter chosen_filter(Chance& chance, std::uint64_t index) {
  const std::vector<const FilterInfo*> all = without_files();
  const FilterInfo& info = *all[index % all.size()];
  for (int attempt = 0; attempt < 20; ++attempt) {
    try {
      return Filter(parse_spec(chosen_text(chance, info), "stress"));
    } catch (const Error&) {
      continue;
    }
  }
  return Filter(parse_spec(info.name, "stress"));
}

double beside(double x, std::uint64_t which) {
  return which == 0 ? x : std::nextafter(x, which == 1 ? -kInfinity : kInfinity);
}

std::vector<double> hard_places(Chance& chance, std::span<const double> knots) {
  const double r = knots.back();
  std::vector<double> x{r, std::nextafter(r, 0.0), std::nextafter(r, kInfinity), 0.0};
  for (int i = 0; i < 3; ++i) x.push_back(beside(chance.pick(knots), chance.below(3)));
  x.push_back(r * chance.decades(1e-300, 1));
  x.push_back(r * chance.unit());
  x.push_back(r * (1 + chance.decades(1e-15, 1e15)));
  return x;
}

void see(Worst& worst, std::string_view quantity, double at, double computed, const Enclosed& truth, double bound,
         double naive = std::numeric_limits<double>::quiet_NaN()) {
  const auto error_of = [&](double v) { return static_cast<double>(oracle::abs(oracle::widen(v) - truth.value)); };
  Measured m;
  m.quantity = quantity;
  m.at = at;
  m.computed = computed;
  m.wanted = static_cast<double>(truth.value);
  m.error = error_of(computed);
  m.bound = bound;
  m.oracle_error = truth.error;
  m.naive_error = error_of(naive);
  worst.see(m);
}

void check_separable(const Kernel& kernel, const BallKernel& truth, std::vector<double> places, Worst& worst) {
  for (std::size_t i = places.size(); i-- > 0;) places.push_back(-places[i]);
  std::vector<double> weights(places.size());
  kernel.weights(places, weights);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double x = places[i];
    const Kernel::PieceBounds& bounds = kernel.bounds(kernel.piece_of(x));
    see(worst, "k", x, kernel.k(x), truth.k(x), bounds.k_error_at_x, truth.naive_k(x));
    see(worst, "K", x, kernel.K(x), truth.K(x), bounds.K_error_at_x);
    if (weights[i] != kernel.k(x)) worst.fault(fmt::format("weights() and k() differ at {:.17g}", x));
  }
}

void check_radial(const RadialKernel& kernel, const BallKernel& truth, const std::vector<double>& places,
                  Worst& worst) {
  const std::vector<double> zeros(places.size(), 0.0);
  std::vector<double> weights(places.size());
  // r must be its own root of the square.
  std::vector<double> plain = places;
  for (double& r : plain) r = r < 1e-100 || r > 1e100 ? 1 : r;
  kernel.weights(plain, zeros, weights);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double r = places[i];
    const int piece = kernel.piece_of(r);
    const bool within = piece < kernel.pieces();
    see(worst, "k", r, kernel.k(r), truth.radial_k(r), within ? kernel.bounds(piece).k_error : 0, truth.naive_k(r));
    see(worst, "q", r, kernel.q(r), truth.q(r), within ? kernel.bounds(piece).q_error : kernel.q_error());
    see(worst, "G", r, kernel.G(r), truth.G(r), kernel.G_error());
    if (weights[i] != kernel.k(plain[i])) worst.fault(fmt::format("weights() and k() differ at {:.17g}", plain[i]));
  }
}

using Case = ManyValues;

Case run_case_of(CaseKey key) {
  Chance chance("kernels", key);
  const Filter filter = chosen_filter(chance, key.index);
  Case c;
  c.text = filter.text();
  const BallKernel truth(filter);
  if (truth.radius() != filter.radius()) c.worst.fault("another radius than the formula's");
  if (filter.is_radial()) {
    const RadialKernel& kernel = filter.radial_kernel();
    std::vector<double> places = hard_places(chance, kernel.knots());
    for (double& r : places) r = std::fabs(r);
    check_radial(kernel, truth, places, c.worst);
    c.severity = kernel.k_max() * kernel.radius() * kernel.radius();
  } else {
    const Kernel& kernel = filter.kernel();
    check_separable(kernel, truth, hard_places(chance, kernel.knots()), c.worst);
    c.severity = kernel.k_max() * kernel.radius();
  }
  return c;
}

Outcome run(CaseKey key) { return run_case_of(key).outcome(); }

std::string describe(CaseKey key) {
  const Case c = run_case_of(key);
  return fmt::format("filter {}: {}({:.17g})", c.text, c.worst.worst().quantity, c.worst.worst().at);
}

}  // namespace

extern const Family kernels;
constinit const Family kernels = {
    .name = "kernels",
    .title = "every filter and its extremes at knots, an ulp beside them, at the ends and beyond",
    .quantity = "k and K (radial: k, q, G), per pixel",
    .severity = "peak times radius (radial: its square)",
    .claim = "bounds of the piece (filters/kernel.h, radial_kernel.h)",
    .share = 0.15,
    .run = run,
    .describe = describe};

}  // namespace moire::stress
