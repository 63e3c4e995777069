// Hard point sets: every pattern and its variants, up to 2^24 points. No coordinate is 1, negative or NaN;
// deterministic points equal exact rational numbers, rounded once; random ones keep to their strata, shifted ones to
// the torus.
//
// Nothing is allowed for: the bound is 0, but for sets shifted on the torus, whose every coordinate is rounded once
// where it may be up to 2: 2^-53 for a point and for the one that it is compared with.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/args.h"
#include "oracle/quad.h"
#include "patterns/pattern.h"
#include "stress/chance.h"
#include "stress/family.h"
#include "stress/worst.h"

namespace moire::stress {
namespace {

using oracle::Quad;

constexpr std::uint64_t kLargeEvery = 8192;  // among so many the first ones have 2^24 points, a pattern each
constexpr std::string_view kLarge[] = {"zaremba", "hammersley", "n-rooks", "random", "jittered"};
constexpr std::int64_t kMostArea = 1 << 12;

using Case = ManyValues;

// What a digital set is made of: digits of i in base 2 or 3, digit k with k added where folded, mirrored at the point.
template <unsigned kBase>
struct Inverse {
  bool folded = false;

  // Whole numbers in 128 bits and one division in 113: nothing but the last conversion rounds. 48 and 36 digits, the
  // leading zeros of i among them; folded ones go on for ever as 0101... and 012012..., 1/3 and 5/26 of the last digit.
  double operator()(std::uint64_t i) const {
    __extension__ using Wide = unsigned __int128;
    constexpr int kDigits = kBase == 2 ? 48 : 36;
    std::uint64_t digits = 0, cells = 1;
    for (int k = 0; k < kDigits; ++k, i /= kBase) {
      const auto digit = static_cast<unsigned>(i % kBase) + (folded ? static_cast<unsigned>(k) : 0u);
      digits = digits * kBase + digit % kBase;
      cells *= kBase;
    }
    Wide numerator = digits, denominator = cells;
    if (folded) {
      constexpr unsigned kOver = kBase == 2 ? 3 : 26, kTail = kBase == 2 ? 1 : 5;
      numerator = numerator * kOver + kTail;
      denominator *= kOver;
    }
    return static_cast<double>(static_cast<Quad>(numerator) / static_cast<Quad>(denominator));
  }
};

double ratio(double above, double below) { return static_cast<double>(oracle::widen(above) / oracle::widen(below)); }

struct Set {
  std::vector<double> x, y, t;
  Set(std::size_t n, bool with_time) : x(n, -1), y(n, -1), t(with_time ? n : 0, -1) {}
  Points points() { return {x, y, t}; }
};

// In [0, side), a number and no fault; and how far float would move it, in units of the side.
void check_range(std::string_view axis, const std::vector<double>& values, double side, Worst& worst) {
  Measured m;
  m.quantity = axis;
  m.naive_error = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double v = values[i];
    if (!(v >= 0 && v < side)) return worst.fault(fmt::format("{} = {:.17g} is not in [0, {})", axis, v, side));
    m.naive_error = std::max(m.naive_error, std::fabs(static_cast<double>(static_cast<float>(v)) - v) / side);
    if (v < m.computed) continue;
    m.computed = m.wanted = v;
    m.at = static_cast<double>(i);
  }
  worst.see(m);
}

// The points are what the definition says, `fixed`.
void check_equal(std::string_view axis, const std::vector<double>& got, const std::vector<double>& fixed,
                 Worst& worst) {
  Measured m;
  m.quantity = axis;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const double error = std::fabs(got[i] - fixed[i]);
    if (i > 0 && !(error > m.error)) continue;
    m.at = static_cast<double>(i);
    m.computed = got[i];
    m.wanted = fixed[i];
    m.error = error;
  }
  worst.see(m);
}

// The set moved by one shift on the torus: got - fixed is the same for all points, up to whole numbers.
void check_shifted(std::string_view axis, const std::vector<double>& got, const std::vector<double>& fixed,
                   Worst& worst) {
  const Quad shift = oracle::widen(got[0]) - oracle::widen(fixed[0]);
  Measured m;
  m.quantity = axis;
  m.bound = 0x1p-52;
  for (std::size_t i = 0; i < got.size(); ++i) {
    Quad off = oracle::widen(got[i]) - oracle::widen(fixed[i]) - shift;
    for (const double whole : {-1.0, 1.0}) {
      if (oracle::abs(off + oracle::widen(whole)) < oracle::abs(off)) off += oracle::widen(whole);
    }
    const double error = static_cast<double>(oracle::abs(off));
    if (i > 0 && !(error > m.error)) continue;
    m.at = static_cast<double>(i);
    m.computed = got[i];
    m.wanted = static_cast<double>(oracle::widen(got[i]) - off);
    m.error = error;
  }
  worst.see(m);
}

// 52 binary digits exclusive-or'ed with the same ones in every point.
void check_scrambled(std::string_view axis, const std::vector<double>& got, const std::vector<double>& fixed,
                     Worst& worst) {
  const auto digits = [](double v) { return static_cast<std::uint64_t>(v * 0x1p52); };
  const std::uint64_t mask = digits(got[0]) ^ digits(fixed[0]);
  for (std::size_t i = 0; i < got.size(); ++i) {
    if ((digits(got[i]) ^ digits(fixed[i])) != mask || got[i] * 0x1p52 != static_cast<double>(digits(got[i]))) {
      return worst.fault(fmt::format("{} of point {} is not scrambled as that of point 0", axis, i));
    }
  }
}

// The ternary digits of times shifted, each by its own number modulo 3, at one place inside the last intervals.
void check_scrambled_times(const std::vector<double>& got, Worst& worst) {
  const auto cell = [](double t) { return static_cast<std::int64_t>(oracle::widen(t) * 387420489); };  // 3^18
  for (std::size_t i = 0; i < got.size(); ++i) {
    std::int64_t a = cell(got[i]), b = cell(got[0]), index = static_cast<std::int64_t>(i);
    std::vector<int> from_last;
    for (int k = 0; k < 18; ++k, a /= 3, b /= 3) from_last.push_back(static_cast<int>((a % 3 - b % 3 + 3) % 3));
    for (int k = 17; k >= 0; --k, index /= 3) {
      if (from_last[static_cast<std::size_t>(k)] != index % 3) {
        return worst.fault(fmt::format("t of point {} has not the digits of its number", i));
      }
    }
  }
}

// Of very many points definitions are asked of every 7th or 61st alone: the last digits of their numbers in bases 2
// and 3 take all values, and so do the first.
constexpr std::size_t kMany = 1 << 20;
std::size_t stride_of(std::size_t n, std::size_t of_many) { return n > kMany ? of_many : 1; }

// Value i strictly inside stratum stratum(i) of `count`, no farther than amount / 2 strata from its middle.
template <class Stratum>
void check_strata(std::string_view axis, const std::vector<double>& values, std::uint64_t count, double amount,
                  const Stratum& stratum, Worst& worst) {
  // Rounded in strata, where the jitter is added to 1/2 and to the stratum's number, and once more as a place.
  const Quad reach = oracle::widen(0.5 * amount) + oracle::widen(static_cast<double>(count) * 0x1p-52 + 0x1p-53);
  for (std::size_t i = 0; i < values.size(); i += stride_of(values.size(), 61)) {
    const Quad offset =
        oracle::widen(values[i]) * static_cast<Quad>(count) - static_cast<Quad>(stratum(i)) - oracle::widen(0.5);
    if (!(oracle::abs(offset) < oracle::widen(0.5) || (count == 1 && values[i] == 0)) || oracle::abs(offset) > reach) {
      return worst.fault(fmt::format("{} = {:.17g} of point {} leaves its stratum", axis, values[i], i));
    }
  }
}

void check_jittered(const Set& set, double amount, Worst& worst) {
  const std::uint64_t n = set.x.size();
  auto rows = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n)));
  while (n % rows != 0) --rows;  // the cells nearest to squares, not higher than wide
  const std::uint64_t columns = n / rows;
  check_strata(
      "x", set.x, columns, amount, [&](std::size_t i) { return i % columns; }, worst);
  check_strata(
      "y", set.y, rows, amount, [&](std::size_t i) { return i / columns; }, worst);
}

// One point in each column, in their order, and one in each row.
void check_rooks(const Set& set, Worst& worst) {
  const std::uint64_t n = set.x.size();
  check_strata(
      "x", set.x, n, 1, [](std::size_t i) { return i; }, worst);
  if (n > kMany && (n & (n - 1)) == 0) {
    // Rows of a power of two are told without rounding, and without sorting.
    std::vector<bool> taken(n);
    for (const double y : set.y) {
      const auto row = static_cast<std::size_t>(y * static_cast<double>(n));
      if (!(y >= 0 && y < 1) || taken[row]) return worst.fault(fmt::format("row {} has two points", row));
      taken[row] = true;
    }
    return;
  }
  std::vector<double> y = set.y;
  std::sort(y.begin(), y.end());
  check_strata(
      "y", y, n, 1, [](std::size_t i) { return i; }, worst);
}

// Points of hammersley, zaremba and regular as they are without an instance, those of n with these numbers.
Set fixed_set(std::string_view name, std::size_t n, const std::vector<std::size_t>& numbers, bool with_time) {
  Set set(numbers.size(), with_time);
  const bool folded = name == "zaremba";
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(n))));
  for (std::size_t at = 0; at < numbers.size(); ++at) {
    const std::size_t i = numbers[at];
    if (name == "regular") {
      set.x[at] = ratio(2 * static_cast<double>(i % side) + 1, 2 * static_cast<double>(side));
      set.y[at] = ratio(2 * static_cast<double>(i / side) + 1, 2 * static_cast<double>(side));
      continue;
    }
    set.x[at] = ratio(static_cast<double>(i), static_cast<double>(n));
    set.y[at] = Inverse<2>{folded}(i);
    if (with_time) set.t[at] = Inverse<3>{folded}(i);
  }
  return set;
}

void check_instance(const Set& all, std::string_view name, std::string_view instance, Worst& worst) {
  std::vector<std::size_t> numbers;
  const std::size_t n = all.x.size(), stride = stride_of(n, name == "zaremba" ? 7 : 61);
  for (std::size_t i = 0; i < n; i += stride) numbers.push_back(i);
  Set got(numbers.size(), !all.t.empty());
  for (std::size_t at = 0; at < numbers.size(); ++at) {
    got.x[at] = all.x[numbers[at]];
    got.y[at] = all.y[numbers[at]];
    if (!all.t.empty()) got.t[at] = all.t[numbers[at]];
  }
  const Set fixed = fixed_set(name, n, numbers, !all.t.empty());
  const auto check = instance == "shift" ? check_shifted : instance == "scramble" ? check_scrambled : check_equal;
  check("x", got.x, fixed.x, worst);
  check("y", got.y, fixed.y, worst);
  if (got.t.empty()) return;
  if (instance == "scramble") return check_scrambled_times(all.t, worst);
  check("t", got.t, fixed.t, worst);
}

// --- Which pattern, which parameters, how many points ---

std::string chosen_parameters(Chance& chance, const PatternInfo& info, bool quick) {
  std::string keys;
  for (const Param& p : info.params) {
    std::string value;
    if (p.kind == Param::Kind::choice) {
      const auto words = static_cast<std::uint64_t>(std::count(p.choices.begin(), p.choices.end(), '|')) + 1;
      std::string_view rest = p.choices;
      for (std::uint64_t skip = chance.below(words); skip > 0; --skip) rest.remove_prefix(rest.find('|') + 1);
      value = rest.substr(0, rest.find('|'));
    } else if (p.kind == Param::Kind::integer) {
      // Misses, candidates and banks cost time, and small ones are as hard.
      value = shortest(p.min + static_cast<double>(chance.below(quick ? 4 : 20)));
    } else {
      const double any = chance.decades(1e-17, 1);
      value = shortest(chance.below(3) == 0 ? p.min : chance.below(2) == 0 ? p.max : p.min + (p.max - p.min) * any);
    }
    keys += fmt::format("{}{}={}", keys.empty() ? ":" : ",", p.name, value);
  }
  return keys;
}

int chosen_count(Chance& chance, const PatternChoice& choice, bool costly) {
  const double most = costly ? 100 : chance.below(64) == 0 ? 0x1p17 : 2000;
  const int n = static_cast<int>(chance.decades(1, most));
  return chance.coin() ? choice.info().counts(choice.args(), n).above : choice.info().counts(choice.args(), n).below;
}

bool is_costly(std::string_view name) { return name == "dart-throwing" || name == "scan-time"; }

void check_pixel(const PatternChoice& choice, int n, Draw draw, Pixel pixel, Case& c) {
  const Pattern pattern(choice, n, draw);
  Set set(static_cast<std::size_t>(n), pattern.has_time());
  pattern.fill({&pixel, 1}, set.points());
  check_range("x", set.x, 1, c.worst);
  check_range("y", set.y, 1, c.worst);
  if (pattern.has_time()) check_range("t", set.t, 1, c.worst);
  const std::string_view name = choice.info().name;
  if (name == "jittered") check_jittered(set, choice.args().number("amount"), c.worst);
  if (name == "jittered-random-time" || name == "scan-time") check_jittered(set, 1, c.worst);
  if (name == "n-rooks") check_rooks(set, c.worst);
  if (choice.args().find("instance") != nullptr) {
    check_instance(set, name, choice.args().text("instance"), c.worst);
  }
}

// One set over an image of extreme size.
void check_area(Chance& chance, const PatternChoice& choice, Draw draw, Case& c) {
  const auto side = [&] { return static_cast<int>(chance.decades(1, 0x1p20)); };
  const Grid area{side(), side()};
  const auto asked = static_cast<std::int64_t>(chance.decades(1, kMostArea));
  const std::int64_t n = choice.info().area_count(choice.args(), area, asked);
  c.text += fmt::format(", {} points over {} x {} pixels", n, area.width, area.height);
  c.severity = static_cast<double>(n);
  if (n > 4 * kMostArea) return;  // grids of cells that are far longer than wide
  Set set(static_cast<std::size_t>(n), choice.has_time());
  choice.info().fill_area(choice.args(), area, draw, set.points());
  check_range("x", set.x, area.width, c.worst);
  check_range("y", set.y, area.height, c.worst);
  if (choice.has_time()) check_range("t", set.t, 1, c.worst);
}

bool is_large(CaseKey key) { return key.index % kLargeEvery < std::size(kLarge); }

Case run_case_of(CaseKey key) {
  Chance chance("patterns", key);
  Case c;
  const Draw draw{chance.bits(), static_cast<std::uint32_t>(chance.below(1 << 20))};
  const auto coordinate = [&] { return static_cast<std::int64_t>(chance.bits()); };
  const Pixel pixel{coordinate(), coordinate()};
  if (is_large(key)) {
    c.text = std::string(kLarge[key.index % kLargeEvery]);
    c.severity = kMaxSamples;
    check_pixel(PatternChoice(parse_spec(c.text, "stress")), kMaxSamples, draw, pixel, c);
  } else {
    const auto all = moire::patterns();
    const PatternInfo& info = *all[key.index % all.size()];
    const bool costly = is_costly(info.name);
    c.text = std::string(info.name) + chosen_parameters(chance, info, costly);
    const PatternChoice choice(parse_spec(c.text, "stress"));
    if (info.area_count != nullptr && chance.below(4) == 0) {
      check_area(chance, choice, draw, c);
    } else {
      const int n = chosen_count(chance, choice, costly);
      c.severity = n;
      check_pixel(choice, n, draw, pixel, c);
    }
  }
  c.text = fmt::format("pattern {}; n = {}; seed = {}; trial = {}; pixel = ({}, {})", c.text, c.severity, draw.seed,
                       draw.trial, pixel.x, pixel.y);
  return c;
}

Outcome run(CaseKey key) { return run_case_of(key).outcome(); }

std::string describe(CaseKey key) {
  const Case c = run_case_of(key);
  return fmt::format("{}: {} of point {}", c.text, c.worst.worst().quantity, c.worst.worst().at);
}

}  // namespace

extern const Family patterns;
constinit const Family patterns = {
    .name = "patterns",
    .title = "every pattern and its variants, to 2^24 points, anywhere in 2^64 x 2^64 pixels",
    .quantity = "coordinates, of the unit square; naive: stored as float",
    .severity = "points",
    .claim = "exact: correctly rounded rationals, in [0, 1), in their strata; shifted: 2^-52, two roundings below 2",
    .share = 1,
    .run = run,
    .describe = describe};

}  // namespace moire::stress
