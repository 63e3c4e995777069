// Expected noise spectra against measured ones: one set of points over the image, the un-normalised estimator. And what
// the theory says of a noise field's own spectrum, and of a box with a pattern in every pixel.
#include "measure/noise_theory.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/active_rows.h"
#include "engine/exact.h"
#include "engine/render.h"
#include "engine/samples.h"
#include "filters/filter.h"
#include "measure/dft.h"
#include "measure/point_spectrum.h"
#include "measure/radial.h"
#include "patterns/area_points.h"
#include "scenes.h"
#include "testimages/noise_disks.h"

using namespace moire;

namespace {

constexpr Grid kGrid{64, 64};
constexpr int kPerPixel = 8;

Filter filter_of(const std::string& text) { return Filter(parse_spec(text, "test")); }
PatternChoice pattern_of(const std::string& text) { return PatternChoice(parse_spec(text, "test")); }

// A scene of disks, with its list.
struct Scene {
  std::string name;
  TestImage image;
  std::vector<GivenCircle> disks;
};

Scene field_scene() {
  const auto count = static_cast<int>(std::lround(0.3 * field_area(kGrid)));
  return {"noise field", scenes::noise_field(count, 0.15, 0.35, 1, kGrid),
          make_noise_disks({count, 0.15, 0.35, 1}, kGrid, "test")};
}
Scene disk_scene() {
  return {"disk", scenes::disk({31.3, 32.4}, 17.25, kGrid), {{{31.3, 32.4}, 17.25}}};
}

// The exact image of `scene` under `filter`, flat windows as well.
std::vector<double> exact_image(const TestImage& scene, const Filter& filter) {
  const ActiveRows rows = enumerate(scene, filter.radius());
  const Reference reference = exact(scene, filter, rows);
  std::vector<double> out;
  std::size_t next = 0;
  for (int y = 0; y < scene.grid().height; ++y) {
    for (const Run& run : rows.row(y)) {
      for (std::int32_t x = run.x0; x < run.x1; ++x)
        out.push_back(run.cover == Cover::partial ? reference.value[next++] : run.cover == Cover::all ? 1.0 : 0.0);
    }
  }
  return out;
}

// The scene as many times larger as there are cells to a pixel, its pixels under the box being the cells.
FineCoverage fine_coverage(const Scene& scene, int apron, int per_pixel = kPerPixel) {
  std::vector<double> circles;
  for (const GivenCircle& d : scene.disks) {
    for (const double v : {d.center.x + apron, d.center.y + apron, d.radius}) circles.push_back(v * per_pixel);
  }
  const Grid cells{(kGrid.width + 2 * apron) * per_pixel, (kGrid.height + 2 * apron) * per_pixel};
  return {kGrid, apron, per_pixel, exact_image(scenes::disks(circles, cells), filter_of("box"))};
}

// The signed errors of one image.
std::vector<double> errors(const TestImage& scene, const Samples& samples, const Filter& filter, Estimator estimator,
                           const ActiveRows& rows, std::vector<double> exact_values) {
  for (double& v : exact_values) v = -v;
  const Rendered got = render(scene, samples, filter, estimator, rows);
  for (int y = 0; y < rows.grid().height; ++y) {
    for (const Run& run : rows.row(y)) {
      if (is_rendered(got.pixels, run.cover) || run.cover != Cover::all) continue;
      for (std::int32_t x = run.x0; x < run.x1; ++x)
        exact_values[static_cast<std::size_t>(y * rows.grid().width + x)] += 1;
    }
  }
  for_each_rendered(rows, got, [&](int x, int y, Cover, double value) {
    exact_values[static_cast<std::size_t>(y * rows.grid().width + x)] += value;
  });
  return exact_values;
}

// |transform|^2 per pixel, in the order of spectrum.h.
std::vector<double> periodogram(const std::vector<double>& image, int width, int height) {
  const auto half = real_dft(image, width, height);
  std::vector<double> out;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      int k = (column - width / 2 + width) % width, l = (row - height / 2 + height) % height;
      if (k >= dft_columns(width)) {
        k = width - k;
        l = (height - l) % height;
      }
      out.push_back(std::norm(half[static_cast<std::size_t>(l * dft_columns(width) + k)]) /
                    static_cast<double>(image.size()));
    }
  }
  return out;
}

// Mean power of zero frequency, of each ring, and last of all bins.
std::vector<double> ring_means(const std::vector<double>& power, int width = kGrid.width, int height = kGrid.height) {
  std::vector<double> out;
  double all = 0;
  for (const double p : power) all += p / static_cast<double>(power.size());
  for (const Ring& ring : rings(power, width, height)) out.push_back(ring.mean);
  out[0] = power[static_cast<std::size_t>(height / 2 * width + width / 2)];
  out.push_back(all);
  return out;
}

// Means over trials with their standard errors, as the trials themselves scatter: errors of few samples are no Gaussian
// numbers, and the chi-square of Gaussian noise would be too narrow.
class Scatter {
 public:
  void add(const std::vector<double>& values) {
    sum_.resize(values.size());
    squares_.resize(values.size());
    ++trials_;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum_[i] += values[i];
      squares_[i] += values[i] * values[i];
    }
  }
  double mean(std::size_t i) const { return sum_[i] / trials_; }
  double error(std::size_t i) const {
    return std::sqrt((squares_[i] / trials_ - mean(i) * mean(i)) / (trials_ - 1));
  }
  std::size_t size() const { return sum_.size(); }

 private:
  std::vector<double> sum_, squares_;
  double trials_ = 0;
};

// The set of `pattern` over an image and its apron, in pixels from the upper left corner of the apron.
void collect(const AreaPoints& points, Grid area, int apron, std::vector<double>& x, std::vector<double>& y) {
  for (int row = 0; row < area.height; ++row) {
    const auto at = points.points(-apron, area.width - apron, row - apron);
    for (int i = 0; i < area.width; ++i) {
      for (std::size_t p = at.first[static_cast<std::size_t>(i)]; p < at.first[static_cast<std::size_t>(i) + 1]; ++p) {
        x.push_back((i + at.x[p]) / area.width);
        y.push_back((row + at.y[p]) / area.height);
      }
    }
  }
}

// Power of an isotropic pattern by the radial mean over some sets of other seeds, linear between rings, in cycles per
// pixel.
std::function<double(double, double)> measured_power(const std::string& pattern, int apron, int spp, int sets) {
  const Grid area{kGrid.width + 2 * apron, kGrid.height + 2 * apron};
  constexpr int kFrequencies = 512;
  PointSpectrum spectrum(kFrequencies);
  for (int s = 0; s < sets; ++s) {
    std::vector<double> x, y;
    collect(AreaPoints(pattern_of(pattern), kGrid, apron, spp, {900, static_cast<std::uint32_t>(s)}), area, apron, x, y);
    spectrum.add(x, y);
  }
  std::vector<double> radial;
  for (const RadialPower& ring : radial_power(spectrum.power(), kFrequencies, spectrum.sets()))
    radial.push_back(ring.power);
  radial.insert(radial.begin(), radial.front());  // towards zero frequency the power no longer changes
  return [radial, side = static_cast<double>(area.width)](double fx, double fy) {
    const double at = std::sqrt(fx * fx + fy * fy) * side;
    const auto below = static_cast<std::size_t>(at);
    if (below + 1 >= radial.size()) return 1.0;
    return radial[below] + (at - static_cast<double>(below)) * (radial[below + 1] - radial[below]);
  };
}

struct Worst {
  double ring = 0, total = 0;  // largest |z|
  double squares = 0;          // of the rings' z
  int rings = 0;
};

// Renders `trials` images per scene and filter and compares.
void compare(const std::string& pattern, int spp, int trials, Worst& worst) {
  const std::vector<Scene> all = {field_scene(), disk_scene()};
  for (const char* filter_text : {"box", "mitchell", "gaussian"}) {
    const Filter filter = filter_of(filter_text);
    const int apron = filter.apron();
    const double side = kGrid.width + 2 * apron;
    PairExcess pairs = random_pairs(kPerPixel);
    if (pattern == "jittered") {
      const double cell = side / std::round(std::sqrt(side * side * spp));
      pairs = jittered_pairs(cell, cell, kPerPixel);
    } else if (pattern != "random") {
      // Twice as far as the fifth neighbours' shell, where the correlations of such sets have died away.
      pairs = pairs_of_power(measured_power(pattern, apron, spp, 16), 6 / std::sqrt(spp), kPerPixel);
    }
    std::vector<Scatter> scatter(all.size());
    std::vector<ActiveRows> rows;
    std::vector<std::vector<double>> truth;
    for (const Scene& scene : all) {
      rows.push_back(enumerate(scene.image, filter.radius()));
      truth.push_back(exact_image(scene.image, filter));
    }
    double density = 0;
    for (int t = 0; t < trials; ++t) {
      const AreaPoints points(pattern_of(pattern), kGrid, apron, spp, {31, static_cast<std::uint32_t>(t)});
      density = points.density();
      for (std::size_t s = 0; s < all.size(); ++s) {
        const auto e = errors(all[s].image, points, filter, Estimator::unnormalised, rows[s], truth[s]);
        scatter[s].add(ring_means(periodogram(e, kGrid.width, kGrid.height)));
      }
    }
    for (std::size_t s = 0; s < all.size(); ++s) {
      CAPTURE(pattern);
      CAPTURE(spp);
      CAPTURE(filter_text);
      CAPTURE(all[s].name);
      const auto expected = ring_means(expected_noise(filter.kernel(), fine_coverage(all[s], apron), density, pairs));
      REQUIRE(expected.size() == scatter[s].size());
      double largest = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const double z = (scatter[s].mean(i) - expected[i]) / scatter[s].error(i);
        CAPTURE(i);
        CAPTURE(expected[i]);
        CAPTURE(scatter[s].mean(i));
        if (i + 1 == expected.size()) {
          CHECK(std::fabs(z) < 4);
          worst.total = std::max(worst.total, std::fabs(z));
          if (std::getenv("SHOW")) std::cout << pattern << ' ' << spp << ' ' << filter_text << ' ' << all[s].name << " total z " << z << " rel " << scatter[s].mean(i)/expected[i]-1 << " se " << scatter[s].error(i)/expected[i] << " worst ring " << largest << std::endl;
        } else if (i > 0) {
          CHECK(std::fabs(z) < 5);
          largest = std::max(largest, std::fabs(z));
          worst.ring = std::max(worst.ring, std::fabs(z));
          worst.squares += z * z;
          ++worst.rings;
        }
      }
    }
  }
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("the noise of independent points is as expected") {
    Worst worst;
    for (const int spp : {1, 4}) compare("random", spp, 64, worst);
    MESSAGE("worst ring z ", worst.ring, " total z ", worst.total, " mean z^2 ", worst.squares / worst.rings);
  }
  TEST_CASE("the noise of a jittered grid at a random place is as expected") {
    Worst worst;
    for (const int spp : {1, 4}) compare("jittered", spp, std::getenv("TR") ? std::atoi(std::getenv("TR")) : 64, worst);
    MESSAGE("worst ring z ", worst.ring, " total z ", worst.total, " mean z^2 ", worst.squares / worst.rings);
  }
  TEST_CASE("the noise of dart-throwing is as its points' measured power has it") {
    Worst worst;
    for (const int spp : {1, 4}) compare("dart-throwing:k=100", spp, 64, worst);
    MESSAGE("worst ring z ", worst.ring, " total z ", worst.total, " mean z^2 ", worst.squares / worst.rings);
  }
}
