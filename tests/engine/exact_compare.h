// Compares exact_pixel() with the oracle, pixel by pixel, and keeps what a report needs: bounds and worst error.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "engine/exact.h"
#include "filter_list.h"
#include "oracle/coverage.h"
#include "oracle/filtered.h"

namespace moire {

// All but the plain box, which has a test and a tolerance of its own.
inline std::vector<std::string> wide_filters() {
  std::vector<std::string> texts = test::separable_texts();
  texts.erase(std::remove(texts.begin(), texts.end(), "box"), texts.end());
  return texts;
}

// What a message needs to make the case again, and both values.
inline std::string describe_pixel(const TestImage& image, Pixel pixel, const std::string& filter, Exact got,
                                  oracle::Value truth) {
  std::ostringstream text;
  text << std::setprecision(17) << image.info().name;
  for (const auto& [name, numbers] : image.stored()) {
    text << ' ' << name;
    for (const double v : numbers) text << ' ' << v;
  }
  text << ", pixel " << pixel.x << ' ' << pixel.y << ", " << filter << ": " << got.value << " +- " << got.bound
       << ", oracle " << static_cast<double>(truth.value) << " +- " << static_cast<double>(truth.error);
  return text.str();
}

class ExactComparison {
 public:
  // `tolerance`: the largest |product - oracle| that passes.
  ExactComparison(const std::string& filter, double tolerance)
      : text_(filter), filter_(parse_spec(filter, "test")), kernel_(filter), tolerance_(tolerance) {}

  double radius() const { return filter_.radius(); }

  // Checks |product - oracle| <= tolerance, and <= product's bound + oracle's error.
  void operator()(const TestImage& image, Pixel pixel) {
    const Exact got = exact_pixel(image, filter_, pixel);
    const oracle::Value truth = oracle_value(image, pixel);
    const long double error = std::fabs(static_cast<long double>(got.value) - truth.value);
    INFO(describe_pixel(image, pixel, text_, got, truth));  // made only when a check fails
    CHECK(error <= static_cast<long double>(tolerance_));
    CHECK(error <= static_cast<long double>(got.bound) + truth.error);
    bounds_.push_back(got.bound);
    worst_ = std::max(worst_, static_cast<double>(error));
    if (truth.value > 0 && truth.value < 1) ++partial_;
  }

  std::size_t count() const { return bounds_.size(); }
  // Pixels whose true value is strictly between 0 and 1.
  std::size_t partial() const { return partial_; }
  double worst_error() const { return worst_; }
  double median_bound() {
    const auto middle = bounds_.begin() + static_cast<std::ptrdiff_t>(bounds_.size() / 2);
    std::nth_element(bounds_.begin(), middle, bounds_.end());
    return *middle;
  }
  double max_bound() const { return *std::max_element(bounds_.begin(), bounds_.end()); }
  std::string summary() {
    std::ostringstream text;
    text << std::setprecision(2) << text_ << ": " << count() << " pixels, worst error " << worst_error()
         << ", bound median " << median_bound() << ", max " << max_bound();
    return text.str();
  }

 private:
  // Box: closed-form areas; every other kernel: iterated quadrature.
  oracle::Value oracle_value(const TestImage& image, Pixel pixel) const {
    const std::string_view kind = image.info().name;
    const bool box = filter_.info().name == "box";
    const double width = 2 * filter_.radius();
    if (kind == "edge") {
      const oracle::Edge e = oracle::edge_of(image);
      return box ? oracle::coverage(e, pixel, width) : oracle::filtered(kernel_, e, pixel);
    }
    if (kind == "disk") {
      const oracle::Disk d = oracle::disk_of(image);
      return box ? oracle::coverage(d, pixel, width) : oracle::filtered(kernel_, d, pixel);
    }
    const oracle::Board b = oracle::board_of(image);
    return box ? oracle::coverage(b, pixel, width) : oracle::filtered(kernel_, b, pixel);
  }

  std::string text_;
  Filter filter_;
  oracle::Kernel kernel_;
  double tolerance_;
  std::vector<double> bounds_;
  double worst_ = 0;
  std::size_t partial_ = 0;
};

}  // namespace moire
