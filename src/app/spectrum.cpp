// moire spectrum: which frequencies a pattern, anybody's points or an image's error contain.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/commands.h"
#include "app/image_spectrum.h"
#include "app/output.h"
#include "app/spectrum_output.h"
#include "measure/point_spectrum.h"
#include "patterns/pattern.h"
#include "reports/file.h"
#include "study/point_sets.h"

namespace moire {
namespace {

// Points times frequencies, over all sets: some three minutes of one core (point_spectrum.h).
constexpr std::int64_t kMaxWork = std::int64_t{1} << 40;
// What a set counts as at least: its sums over points are then no longer what takes the time.
constexpr std::int64_t kMinCounted = 64;
constexpr std::int64_t kUsualTrials = 16;

void check_work(std::int64_t points, int frequencies, const std::string& place) {
  const std::int64_t plane = std::int64_t{frequencies} * frequencies, most = kMaxWork / plane;
  if (points > most) {
    throw Error(place, fmt::format("{} points at {} x {} frequencies are too many; at most {} points in all sets, a "
                                   "set counting as {} or more, or fewer --frequencies, are possible",
                                   points, frequencies, frequencies, most, kMinCounted));
  }
}

// Candidates that dart-throwing may look at, over all sets: again some three minutes of one core.
constexpr double kMaxDarts = 0x1p33;

// Throws where to make the points would take longer than any spectrum of them. Of the patterns dart-throwing alone is
// that slow (dart_throwing.cpp has the number of its candidates).
void check_making(const PatternChoice& choice, std::int64_t n, std::int64_t sets) {
  if (choice.info().name != "dart-throwing") return;
  const double darts = 40 * static_cast<double>(choice.args().integer("k")) + 400 * static_cast<double>(n);
  if (static_cast<double>(sets) * darts > kMaxDarts) {
    throw Error("--n", fmt::format("{} sets of {} points by {} would take longer to make than their spectrum; {:.0f} "
                                   "such sets are possible, or more with fewer points or a smaller k",
                                   sets, n, choice.text(), std::floor(kMaxDarts / darts)));
  }
}

// The expected power of a pattern at F x F frequencies, as PointSpectrum::power() has it; empty where it is not known.
std::vector<double> expected_power(const PatternChoice& choice, std::int64_t n, int frequencies) {
  const std::string_view name = choice.info().name;
  const bool grid = name == "regular" && choice.args().text("instance") != "scramble";
  if (name != "random" && name != "jittered" && !grid) return {};
  const double amount = name == "jittered" ? choice.args().number("amount") : 0.0;
  const int cells = static_cast<int>(std::lround(std::sqrt(static_cast<double>(n)))), half = frequencies / 2;
  std::vector<double> power;
  for (int v = -half; v < half; ++v)
    for (int u = -half; u < half; ++u) power.push_back(name == "random" ? 1.0 : jittered_power(cells, amount, u, v));
  return power;
}

// `band`: whether an interval means something. `expected`: of power(), or empty.
Table radial_table(const PointSpectrum& spectrum, const std::vector<double>& power, bool band,
                   const std::vector<double>& expected) {
  const auto theory = expected.empty() ? std::vector<RadialPower>() : radial_power(expected, spectrum.frequencies(), 1);
  Table table;
  for (const RadialPower& ring : radial_power(power, spectrum.frequencies(), spectrum.sets())) {
    Row row;
    row.set("frequency", std::int64_t{ring.frequency});
    row.set("bins", ring.bins);
    row.set("degrees", ring.degrees);
    row.set("power", ring.power);
    row.set("power_lo", band ? Cell(ring.band.lo) : Cell());
    row.set("power_hi", band ? Cell(ring.band.hi) : Cell());
    row.set("anisotropy_db", finite_cell(ring.anisotropy_db));
    if (!theory.empty()) row.set("expected", theory[table.size()].power);
    table.push_back(std::move(row));
  }
  return table;
}

SpectrumOutput points_output(const PointSpectrum& spectrum, bool band, const std::vector<double>& expected) {
  const int half = spectrum.frequencies() / 2;
  SpectrumOutput out;
  out.grid = {spectrum.frequencies(), spectrum.frequencies()};
  out.power = spectrum.power();
  const double none = kNoPower * out.power[static_cast<std::size_t>(half * spectrum.frequencies() + half)];
  out.radial = radial_table(spectrum, out.power, band, expected);
  out.columns = {{"frequency", "", "ring of this radius, one cycle per side of the unit square wide"},
                 {"bins", "", "integer frequencies in it"},
                 {"power", "{:.4g}",
                  "mean over bins and sets of |sum over points of exp(-2 pi i f.x)|^2 / N; random points: 1", none},
                 {"power_lo", "{:.4g}", "the true mean is above this and", none},
                 {"power_hi", "{:.4g}", "below this with 95%, for sums that are Gaussian numbers (chi-square)", none},
                 {"anisotropy_db", "{:.1f}",
                  fmt::format("variance over mean^2 of the ring's bins (Ulichney 1988); isotropic: about {:.1f} dB",
                              -10 * std::log10(static_cast<double>(spectrum.sets())) + 0.0)}};
  if (!expected.empty()) out.columns.push_back({"expected", "{:.4g}", "mean power by theory", none});
  return out;
}

SpectrumOutput pattern_spectrum(const SpectrumOptions& options) {
  const PatternChoice choice(parse_spec(options.what, "PATTERN"));
  choice.require_count(options.n);
  const std::int64_t sets = choice.varies() ? options.trials.value_or(kUsualTrials) : 1;
  const int frequencies = options.frequencies > 0 ? options.frequencies : usual_frequencies(options.n);
  check_work(std::max(options.n, kMinCounted) * sets, frequencies, "--n");
  check_making(choice, options.n, sets);
  PointSpectrum spectrum(frequencies);
  std::vector<double> x(static_cast<std::size_t>(options.n)), y(x.size());
  for (std::int64_t t = 0; t < sets; ++t) {
    Pattern(choice, static_cast<int>(options.n), Draw{options.seed, static_cast<std::uint32_t>(t)}).fill_set({x, y});
    spectrum.add(x, y);
  }
  SpectrumOutput out = points_output(spectrum, choice.varies(), expected_power(choice, options.n, frequencies));
  out.title = fmt::format("{}, {} points, {} {}: power at {} x {} frequencies", choice.text(), options.n, sets,
                          sets == 1 ? "set" : "sets", frequencies, frequencies);
  out.head.set("what", choice.text());
  out.head.set("n", options.n);
  out.head.set("sets", sets);
  out.head.set("frequencies", std::int64_t{frequencies});
  out.head.set("seed", static_cast<std::int64_t>(options.seed));
  out.attributes = {{"moire:pattern", choice.text()},
                    {"moire:n", options.n},
                    {"moire:sets", sets},
                    {"moire:seed", static_cast<std::int64_t>(options.seed)}};
  return out;
}

SpectrumOutput points_spectrum(const SpectrumOptions& options) {
  const std::vector<PointSet> sets = read_point_sets(options.points);
  const std::string name = options.points == "-" ? "standard input" : options.points;
  std::int64_t points = 0, largest = 0, smallest = std::numeric_limits<std::int64_t>::max();
  for (const PointSet& set : sets) {
    const auto n = static_cast<std::int64_t>(set.x.size());
    points += std::max(n, kMinCounted);
    largest = std::max(largest, n);
    smallest = std::min(smallest, n);
  }
  const int frequencies = options.frequencies > 0 ? options.frequencies : usual_frequencies(largest);
  check_work(points, frequencies, name);
  PointSpectrum spectrum(frequencies);
  for (const PointSet& set : sets) spectrum.add(set.x, set.y);
  SpectrumOutput out = points_output(spectrum, true, {});
  const std::string size = smallest == largest ? std::to_string(smallest) : fmt::format("{} to {}", smallest, largest);
  out.title = fmt::format("{}, {} points, {} {}: power at {} x {} frequencies", name, size, sets.size(),
                          sets.size() == 1 ? "set" : "sets", frequencies, frequencies);
  const Cell n = smallest == largest ? Cell(smallest) : Cell();
  out.head.set("what", name);
  out.head.set("n", n);
  out.head.set("sets", spectrum.sets());
  out.head.set("frequencies", std::int64_t{frequencies});
  out.attributes = {{"moire:sets", spectrum.sets()}};
  if (smallest == largest) out.attributes.emplace_back("moire:n", smallest);
  return out;
}

}  // namespace

Exit execute(const SpectrumOptions& options) {
  if (!options.folder.empty()) make_folder(options.folder);
  const SpectrumOutput output =
      !options.points.empty() ? points_spectrum(options)
      : is_image_name(options.what)
          ? image_spectrum(options.what, options.reference, options.window, options.pixels_per_degree)
          : pattern_spectrum(options);
  if (!options.folder.empty()) write_spectrum(options.folder, output);
  print(options.json ? spectrum_json(output) : spectrum_text(output));
  return Exit::ok;
}

}  // namespace moire
