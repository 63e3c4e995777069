// Exact values against the oracle; see exact_case.h.
#include "stress/exact_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "oracle/coverage.h"
#include "oracle/filtered.h"
#include "oracle/motion.h"
#include "oracle/tiny_disk.h"

namespace moire::stress {
namespace {

// What is promised (README.md, "Exact values", and the aims that WeightAim has for all who ask for none).
constexpr double kPromised = 1e-12, kPromisedAtHorizon = 1e-9;
// A still edge crosses no more than some twenty knots of a kernel, each part with a few ten roundings.
constexpr double kPromisedOfEdges = 1e-13;
// Disks up to this radius, in pixels, have bounds in proportion to their area times the kernel's largest value.
constexpr double kTinyRadius = 1e-2;
// Planes without end have no promise but an aim, steered by estimates of what a series will cost: a bound of ten times
// that says that the steering failed.
constexpr double kOfAim = 10;
// Planes without end are promised for homographies of no worse condition (ExactCase::severity): pinhole cameras of
// ordinary focal lengths.
constexpr double kOrdinary = 1e3;
// Kernels of polynomials have no higher degree, and series of others no lower one.
constexpr int kPolynomial = 7;

// Below this share of the kernel's radius a disk's value is asked for in units of the disk: sections in pixels state
// their error in units of the kernel.
constexpr double kTiny = 1.0 / 8;

const std::vector<FilterPtr>& catalogue(Symmetry symmetry) {
  const auto all = [](Symmetry of) {
    std::vector<FilterPtr> filters;
    for (const std::string& text : filter_variants(of)) filters.push_back(std::make_shared<CheckedFilter>(text));
    return filters;
  };
  static const std::vector<FilterPtr> separable = all(Symmetry::separable), radial = all(Symmetry::radial);
  return symmetry == Symmetry::radial ? radial : separable;
}

oracle::Value times(const oracle::Value& v, long double factor) { return {v.value * factor, v.error * factor}; }

oracle::Value moving_value(const TestImage& image, const CheckedFilter& f, Pixel pixel) {
  if (image.info().name == "disk")
    return oracle::moving(oracle::disk_of(image), image.motion(), pixel, 2 * f.filter.radius());
  return oracle::moving(*f.kernel, oracle::edge_of(image), image.motion(), pixel);
}

oracle::Value disk_value(const oracle::Disk& disk, const CheckedFilter& f, Pixel pixel) {
  if (f.is_box) return oracle::coverage(disk, pixel, 2 * f.filter.radius());
  const auto square = static_cast<long double>(disk.radius) * static_cast<long double>(disk.radius);
  const bool tiny = disk.radius < kTiny * f.filter.radius();
  if (f.kernel) {
    return tiny ? times(oracle::filtered_per_square(*f.kernel, disk, pixel), square)
                : oracle::filtered(*f.kernel, disk, pixel);
  }
  // From the disk's own centre only where the pixel's is outside of it.
  const oracle::Circle c = oracle::around(disk, pixel);
  const bool apart = c.center.x * c.center.x + c.center.y * c.center.y > 4 * c.radius * c.radius;
  return tiny && apart ? times(oracle::filtered_per_square(*f.rings, disk, pixel), square)
                       : oracle::filtered(*f.rings, disk, pixel);
}

template <class Shape>
oracle::Value value_of(const Shape& shape, const CheckedFilter& f, Pixel pixel) {
  if (f.is_box) return oracle::coverage(shape, pixel, 2 * f.filter.radius());
  return f.kernel ? oracle::filtered(*f.kernel, shape, pixel) : oracle::filtered(*f.rings, shape, pixel);
}

std::string list(std::span<const double> numbers) { return fmt::format("[{:.17g}]", fmt::join(numbers, ", ")); }

}  // namespace

CheckedFilter::CheckedFilter(const std::string& text)
    : filter(parse_spec(text, "a filter")), is_box(filter.info().name == "box") {
  if (filter.is_radial()) {
    rings.emplace(text);
  } else {
    kernel.emplace(text);
  }
}

std::vector<double> CheckedFilter::knots() const {
  if (!filter.is_radial()) return {filter.kernel().knots().begin(), filter.kernel().knots().end()};
  std::vector<double> all;
  for (const double r : filter.radial_kernel().knots()) {
    all.push_back(r);
    if (r > 0) all.push_back(-r);
  }
  std::sort(all.begin(), all.end());
  return all;
}

FilterPtr checked_filter(const std::string& text) {
  for (const FilterPtr& f : catalogue(Symmetry::separable))
    if (f->filter.text() == text) return f;
  return std::make_shared<CheckedFilter>(text);
}

FilterPtr pick_filter(Chance& chance, bool radial) {
  const std::uint64_t way = chance.below(20);
  if (way < 10) return checked_filter("box");
  if (way < 12) return checked_filter(fmt::format("box:width={:.17g}", chance.decades(0.25, 4)));
  const std::vector<FilterPtr>& separable = catalogue(Symmetry::separable);
  if (!radial) return chance.pick(separable);
  const std::vector<FilterPtr>& others = catalogue(Symmetry::radial);
  const std::uint64_t number = chance.below(separable.size() + others.size());
  return number < separable.size() ? separable[number] : others[number - separable.size()];
}

oracle::Value true_value(const TestImage& image, const CheckedFilter& filter, Pixel pixel) {
  if (image.moves()) return moving_value(image, filter, pixel);
  if (image.info().name == "edge") return value_of(oracle::edge_of(image), filter, pixel);
  if (image.info().name == "disk") return disk_value(oracle::disk_of(image), filter, pixel);
  return value_of(oracle::board_of(image), filter, pixel);
}

double promised_bound(const ExactCase& c) {
  const CheckedFilter& filter = *c.filter;
  if (c.image.info().name == "edge") return c.image.moves() ? kPromised : kPromisedOfEdges;
  if (c.image.info().name == "disk") {
    const double r = oracle::disk_of(c.image).radius;
    if (c.image.moves() || r > kTinyRadius) return kPromised;
    const double k = filter.kernel ? filter.filter.kernel().k_max() : 0;
    return kPromised * r * r * (filter.kernel ? k * k : filter.filter.radial_kernel().k_max());
  }
  const bool polynomial = filter.kernel && filter.filter.kernel().degree() <= kPolynomial;
  // A horizon that passes within a pixel of the window leaves as many squares in it as one that meets it.
  const double low = -0.5 - filter.filter.radius(), high = 1.5 + filter.filter.radius();
  const bool to_horizon = c.image.meets_horizon(c.pixel, {{low, low}, {high, high}});
  // Boards with rims are of few squares, as the families have them, but next to the horizon the square's place may
  // cost.
  if (std::isfinite(oracle::board_of(c.image).extent[0])) return to_horizon ? kPromisedAtHorizon : kPromised;
  if (!polynomial || c.severity > kOrdinary) return HUGE_VAL;
  return kOfAim * (to_horizon ? kPromisedAtHorizon : kPromised);
}

Outcome judged(const ExactCase& c, const Exact& got, const oracle::Value& truth) {
  Outcome outcome;
  outcome.severity = c.severity;
  outcome.computed = got.value;
  outcome.wanted = static_cast<double>(truth.value);
  outcome.error = static_cast<double>(std::fabs(static_cast<long double>(got.value) - truth.value));
  outcome.bound = got.bound;
  outcome.oracle_error = static_cast<double>(truth.error) + c.oracle_doubt;
  outcome.naive_error = static_cast<double>(std::fabs(static_cast<long double>(c.naive) - truth.value));
  outcome.fault = c.fault;
  const double promised = promised_bound(c);
  if (!(got.bound <= promised) && c.fault.empty())
    outcome.fault = fmt::format("bound {:.2g} where {:.2g} is promised", got.bound, promised);
  return outcome;
}

Outcome run(const ExactCase& c) {
  const oracle::Value truth = c.truth ? c.truth() : true_value(c.image, *c.filter, c.pixel);
  return judged(c, exact_pixel(c.image, c.filter->filter, c.pixel), truth);
}

std::string describe(const ExactCase& c) {
  std::string text = fmt::format("kind = \"{}\"; width = {}; height = {}", c.image.info().name, c.image.grid().width,
                                 c.image.grid().height);
  for (const auto& [name, numbers] : c.image.stored()) {
    const std::span<const double> all(numbers);
    if (name == "homography") {
      text +=
          fmt::format("; homography = [{}, {}, {}]", list(all.first(3)), list(all.subspan(3, 3)), list(all.last(3)));
    } else if (numbers.size() == 1) {
      text += fmt::format("; {} = {:.17g}", name, numbers[0]);
    } else {
      text += fmt::format("; {} = {}", name, list(all));
    }
  }
  return text + fmt::format("; pixel {},{}; --filter {}; moire exact SCENE --filter FILTER --pixels FILE", c.pixel.x,
                            c.pixel.y, c.filter->filter.text());
}

}  // namespace moire::stress
