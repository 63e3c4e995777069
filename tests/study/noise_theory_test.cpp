// Expected noise spectra against measured ones: one set of points over the image, the un-normalised estimator. And what
// the theory says of a noise field's own spectrum, and of a box with a pattern in every pixel.
#include "measure/noise_theory.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
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
#include "patterns/variants.h"
#include "scenes.h"
#include "testimages/noise_disks.h"

using namespace moire;

namespace {

constexpr Grid kGrid{64, 64};
constexpr int kPerPixel = 8;  // cells along each side

Filter filter_of(const std::string& text) { return Filter(parse_spec(text, "test")); }
PatternChoice pattern_of(const std::string& text) { return PatternChoice(parse_spec(text, "test")); }

// A scene of disks, with its list.
struct Scene {
  std::string name;
  TestImage image;
  std::vector<GivenCircle> disks;
};

Scene field_scene() {
  const auto count = static_cast<int>(std::lround(1.2 * field_area(kGrid)));
  return {"noise field", scenes::noise_field(count, 0.2, 0.3, 1, kGrid),
          make_noise_disks({count, 0.2, 0.3, 1}, kGrid, "test")};
}
Scene disk_scene() { return {"disk", scenes::disk({31.3, 32.4}, 17.25, kGrid), {{{31.3, 32.4}, 17.25}}}; }

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
FineCoverage fine_coverage(const Scene& scene, int apron, int per_pixel) {
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
std::vector<double> periodogram(const std::vector<double>& image, Grid grid) {
  const auto [width, height] = grid;
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
std::vector<double> ring_means(const std::vector<double>& power) {
  const auto [width, height] = kGrid;
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
  double error(std::size_t i) const { return std::sqrt((squares_[i] / trials_ - mean(i) * mean(i)) / (trials_ - 1)); }
  std::size_t size() const { return sum_.size(); }

 private:
  std::vector<double> sum_, squares_;
  double trials_ = 0;
};

// A set over an image without apron, as fractions of the image.
void collect(const AreaPoints& points, Grid area, std::vector<double>& x, std::vector<double>& y) {
  for (int row = 0; row < area.height; ++row) {
    const auto at = points.points(0, area.width, row);
    for (int i = 0; i < area.width; ++i) {
      for (std::size_t p = at.first[static_cast<std::size_t>(i)]; p < at.first[static_cast<std::size_t>(i) + 1]; ++p) {
        x.push_back((i + at.x[p]) / area.width);
        y.push_back((row + at.y[p]) / area.height);
      }
    }
  }
}

constexpr const char* kDarts = "dart-throwing:k=100";

// Means over the rings of `frequencies` x `frequencies` of dart-throwing at other seeds; ring k is k cycles per image.
std::vector<double> radial_power_of_darts(int spp, int frequencies, std::uint32_t sets) {
  PointSpectrum spectrum(frequencies);
  for (std::uint32_t s = 0; s < sets; ++s) {
    std::vector<double> x, y;
    collect(AreaPoints(pattern_of(kDarts), kGrid, 0, spp, {900, s}), kGrid, x, y);
    spectrum.add(x, y);
  }
  std::vector<double> means = {0};
  for (const RadialPower& ring : radial_power(spectrum.power(), frequencies, sets)) means.push_back(ring.power);
  means[0] = means[1];  // towards zero frequency the power no longer changes
  return means;
}

// Power of dart-throwing by frequency in cycles per pixel: the radial mean, linear between rings, to 4 times the
// frequency of the mean distance. (It depends on the number of points: how far the radius shrinks does.) Up to half of
// that it comes from as many points as the trials have, or nearly, so that its error stays below theirs; above, rings
// hold many frequencies and two sets do.
std::function<double(double, double)> power_of_darts(int spp) {
  const int most = spp == 1 ? 512 : 1024;
  std::vector<double> radial = radial_power_of_darts(spp, most, 2);
  const std::vector<double> low = radial_power_of_darts(spp, most / 2, spp == 1 ? 96 : 32);
  std::copy(low.begin(), low.end(), radial.begin());
  return [radial](double fx, double fy) {
    const double at = std::sqrt(fx * fx + fy * fy) * kGrid.width;
    const auto below = static_cast<std::size_t>(at);
    if (below + 1 >= radial.size()) return 1.0;
    return radial[below] + (at - static_cast<double>(below)) * (radial[below + 1] - radial[below]);
  };
}

// How a pattern's points know of each other, on the torus of an image with its apron.
using PairsOf = std::function<PairExcess(double side)>;

// Renders images of both scenes under three filters, and compares the mean power of each ring and of all bins.
void check_prediction(const std::string& pattern, int spp, int per_pixel, const PairsOf& pairs_of) {
  constexpr std::uint32_t kTrials = 64;
  const std::vector<Scene> scene_list = {field_scene(), disk_scene()};
  double worst_ring = 0, worst_total = 0;
  for (const std::string filter_text : {"box", "mitchell", "gaussian"}) {
    const Filter filter = filter_of(filter_text);
    std::vector<ActiveRows> rows;
    std::vector<std::vector<double>> truth;
    for (const Scene& scene : scene_list) {
      rows.push_back(enumerate(scene.image, filter.radius()));
      truth.push_back(exact_image(scene.image, filter));
    }
    std::vector<Scatter> scatter(scene_list.size());
    double density = 0;
    for (std::uint32_t t = 0; t < kTrials; ++t) {
      const AreaPoints points(pattern_of(pattern), kGrid, filter.apron(), spp, {31, t});
      density = points.density();
      for (std::size_t s = 0; s < scene_list.size(); ++s) {
        const auto e = errors(scene_list[s].image, points, filter, Estimator::unnormalised, rows[s], truth[s]);
        scatter[s].add(ring_means(periodogram(e, kGrid)));
      }
    }
    const PairExcess pairs = pairs_of(kGrid.width + 2.0 * filter.apron());
    for (std::size_t s = 0; s < scene_list.size(); ++s) {
      CAPTURE(pattern);
      CAPTURE(spp);
      CAPTURE(filter_text);
      CAPTURE(scene_list[s].name);
      const FineCoverage fine = fine_coverage(scene_list[s], filter.apron(), per_pixel);
      const std::vector<double> expected = ring_means(expected_noise(filter.kernel(), fine, density, pairs));
      // Zero frequency is one bin, the square of one number: too skew for a deviate.
      for (std::size_t i = 1; i < expected.size(); ++i) {
        CAPTURE(i);
        CAPTURE(expected[i]);
        CAPTURE(scatter[s].mean(i));
        const double z = std::fabs(scatter[s].mean(i) - expected[i]) / scatter[s].error(i);
        // By Student's t of 63 degrees one of the 1,600 rings is beyond 5 in one of 130 such tests, and one of the 36
        // totals beyond 4 in one of 160. Cells of 1/8 pixel add up to 0.3%, less than one standard error of a total.
        const bool is_total = i + 1 == expected.size();
        CHECK(z < (is_total ? 4 : 5));
        (is_total ? worst_total : worst_ring) = std::max(is_total ? worst_total : worst_ring, z);
      }
    }
  }
  MESSAGE(pattern, " at ", spp, ": largest z of a ring ", worst_ring, ", of a total ", worst_total);
}

// Six mean distances: there the pair correlation has gone into the noise of the measurement.
void check_darts(int spp, int per_pixel) {
  const PairExcess pairs = pairs_of_power(power_of_darts(spp), 6 / std::sqrt(spp), per_pixel);
  check_prediction(kDarts, spp, per_pixel, [&pairs](double) { return pairs; });
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("the noise of independent points over the image is as expected") {
    for (const int spp : {1, 4})
      check_prediction("random", spp, kPerPixel, [](double) { return random_pairs(kPerPixel); });
  }

  TEST_CASE("the noise of a jittered grid at a random place is as expected") {
    for (const int spp : {1, 4}) {
      check_prediction("jittered", spp, kPerPixel, [spp](double side) {
        const double cell = side / std::round(side * std::sqrt(spp));
        return jittered_pairs(cell, cell, kPerPixel);
      });
    }
  }

  TEST_CASE("the noise of dart-throwing over the image is as its points' measured power has it") { check_darts(1, 8); }

  TEST_CASE("a noise field has nearly the same power at all frequencies up to the pixel's") {
    const Filter box = filter_of("box");
    Scatter scatter;
    for (int seed = 1; seed <= 64; ++seed) {
      std::vector<double> image = exact_image(scenes::usual_noise_field(seed, kGrid), box);
      const double mean = mean_of(image);
      for (double& v : image) v -= mean;
      scatter.add(ring_means(periodogram(image, kGrid)));
    }
    const double all = scatter.mean(scatter.size() - 1);
    // Disks that keep their distance have less power at low frequencies than independent ones, and disks of some size
    // less at high ones; at the usual count and radii these nearly cancel. What is left is 0.3 dB to either side.
    for (std::size_t i = 1; i + 1 < scatter.size(); ++i)
      CHECK(std::fabs(scatter.mean(i) / all - 1) < 0.08 + 4 * scatter.error(i) / all);
  }

  TEST_CASE("a box with a pattern of its own in every pixel has white noise, whatever the pattern") {
    const Scene scene = disk_scene();
    const Filter box = filter_of("box");
    const ActiveRows rows = enumerate(scene.image, box.radius());
    const std::vector<double> truth = exact_image(scene.image, box);
    int seen = 0;
    for (const std::string& text : test::variants()) {
      const PatternChoice choice = test::chosen(text);
      if (!choice.varies()) continue;
      CAPTURE(text);
      ++seen;
      Scatter scatter;  // of rings less the mean of all bins
      for (std::uint32_t t = 0; t < 64; ++t) {
        const Pattern pattern(choice, test::usable(choice, 4), {17, t});
        std::vector<double> means =
            ring_means(periodogram(errors(scene.image, pattern, box, Estimator::unnormalised, rows, truth), kGrid));
        for (std::size_t i = 0; i + 1 < means.size(); ++i) means[i] -= means.back();
        scatter.add(means);
      }
      double worst = 0;
      for (std::size_t i = 1; i + 1 < scatter.size(); ++i)
        worst = std::max(worst, std::fabs(scatter.mean(i) / scatter.error(i)));
      CHECK(worst < 5);  // some 45 rings of each pattern
    }
    CHECK(seen > 5);
  }
}

TEST_SUITE("slow") {
  // Cells of 1/8 pixel leave 0.6% at this density, four standard errors of 300 trials.
  TEST_CASE("the noise of dart-throwing at 4 points per pixel is as its points' measured power has it") {
    check_darts(4, 16);
  }
}
