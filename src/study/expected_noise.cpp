// What theory expects the noise of a study's cases to be.
#include "study/expected_noise.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "core/parallel.h"
#include "patterns/jittered_grid.h"

namespace moire {
namespace {

constexpr int kCells = 8;   // along each side of a pixel
constexpr int kPoints = 4;  // along each side of a cell
constexpr int kSide = kCells * kPoints;

// The covered part of each cell of one pixel, into columns `at` to at + kCells of rows that are `stride` apart.
void cover_pixel(const TestImage& scene, Pixel pixel, std::span<const double> x, std::span<const double> y,
                 std::vector<std::uint8_t>& inside, double* at, std::size_t stride) {
  const Cover cover = scene.cover(pixel, {{0, 0}, {1, 1}});
  const bool partial = cover == Cover::partial;
  if (partial) scene.contains({&pixel, 1}, x, y, inside);
  for (std::size_t row = 0; row < kCells; ++row) {
    for (std::size_t column = 0; column < kCells; ++column) {
      int count = 0;
      for (std::size_t j = 0; partial && j < kPoints; ++j)
        for (std::size_t i = 0; i < kPoints; ++i) count += inside[(row * kPoints + j) * kSide + column * kPoints + i];
      at[row * stride + column] = partial ? count / static_cast<double>(kPoints * kPoints) : cover == Cover::all;
    }
  }
}

// Work as kMaxExpectedWork counts it.
double work_of(Grid area, double radius, const PairExcess& pairs) {
  const double cells = static_cast<double>(area.width) * area.height * kCells * kCells;
  const double distances = (2.0 * pairs.reach + 1) * (pairs.reach + 1.0);
  return cells * std::max(1.0, distances) * (4 * radius + 1);
}

}  // namespace

const FineCoverage& ExpectedNoise::coverage(std::uint32_t scene_index, int apron) {
  if (covered_ == std::pair(scene_index, apron)) return coverage_;
  const TestImage& scene = study_.scenes[scene_index].image;
  const Grid grid = scene.grid();
  const int columns = grid.width + 2 * apron, rows = grid.height + 2 * apron;
  const std::size_t stride = static_cast<std::size_t>(columns) * kCells;
  coverage_ = {grid, apron, kCells, std::vector<double>(stride * static_cast<std::size_t>(rows) * kCells)};
  std::vector<double> x, y;  // midpoints of kSide x kSide equal squares of a pixel
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      x.push_back((i + 0.5) / kSide);
      y.push_back((j + 0.5) / kSide);
    }
  }
  parallel_for(static_cast<std::size_t>(rows), [&](std::size_t row) {
    std::vector<std::uint8_t> inside(x.size());
    for (int column = 0; column < columns; ++column) {
      const Pixel pixel{column - apron, static_cast<std::int64_t>(row) - apron};
      double* const at = coverage_.value.data() + row * kCells * stride + static_cast<std::size_t>(column) * kCells;
      cover_pixel(scene, pixel, x, y, inside, at, stride);
    }
  });
  covered_ = {scene_index, apron};
  return coverage_;
}

std::vector<double> ExpectedNoise::of(const Case& c) {
  const PatternChoice& choice = study_.patterns[c.pattern];
  const std::string_view name = choice.info().name;
  const bool jittered = name == "jittered" && choice.args().number("amount") == 1;
  if (study_.layouts[c.layout] != Layout::image || (name != "random" && !jittered) ||
      study_.estimators[c.estimator].value != Estimator::unnormalised ||
      study_.spectrum.window != SpectrumWindow::none || study_.scenes[c.scene].image.moves()) {
    return {};
  }
  const Filter& filter = study_.filters[c.filter];
  if (filter.is_radial()) return {};
  const Grid grid = study_.scenes[c.scene].image.grid();
  const int apron = filter.apron();
  const Grid area{grid.width + 2 * apron, grid.height + 2 * apron};
  if (std::int64_t{grid.width} * grid.height > kMaxExpectedPixels) return {};

  const std::int64_t n = choice.area_count(area, study_.spp[c.spp]);
  PairExcess pairs = random_pairs(kCells);
  if (jittered) {
    const double columns = static_cast<double>(JitteredArea::columns_of(area, n));
    const double rows = static_cast<double>(n) / columns;
    pairs = jittered_pairs(area.width / columns, area.height / rows, kCells);
  }
  // On a torus that is no wider than two distances a pair would count twice.
  if (2 * pairs.reach >= kCells * std::min(area.width, area.height)) return {};
  if (work_of(area, filter.radius(), pairs) > kMaxExpectedWork) return {};
  const double density = static_cast<double>(n) / (static_cast<double>(area.width) * area.height);
  return expected_noise(filter.kernel(), coverage(c.scene, apron), density, pairs);
}

}  // namespace moire
