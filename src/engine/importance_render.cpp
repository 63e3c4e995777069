// Images by importance sampling; see importance_render.h.
//
// The pattern's points (u, v) of a pixel become points (x(u), x(v)) around its centre, x the inverse distribution of
// |k|; for a radial filter x(u) is the distance and 2 pi v the direction. They lie in the pixel's window but not in the
// pixel, and are handed to the scene from the corner of the pixel that holds them, which is what its answers are exact
// for.
#include "engine/importance_render.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "engine/inverse_distribution.h"

namespace moire {
namespace {

// Points placed and tested at a time.
constexpr std::size_t kBatch = 1024;

// A coordinate from the corner of a pixel as that of another pixel and a rest in [0, 1). What the rest rounds, 2^-54
// at most, moves the sample and is no error: windows are grown by far more before they are classified.
struct Placed {
  std::int64_t pixel;
  double rest;
};

Placed place(double from_corner) {
  const double whole = std::floor(from_corner), rest = from_corner - whole;
  const auto pixel = static_cast<std::int64_t>(whole);
  return rest < 1 ? Placed{pixel, rest} : Placed{pixel + 1, 0.0};
}

// Samples of a pixel with their signs: all of them, and those inside the scene.
struct SignSums {
  std::int64_t all = 0, inside = 0;
};

class ImportanceRenderer {
 public:
  ImportanceRenderer(const TestImage& scene, const Pattern& pattern, const Filter& filter, Estimator estimator,
                     const ActiveRows& rows, bool exhaustive)
      : scene_(scene),
        pattern_(pattern),
        is_box_(filter.is_unit_box()),
        is_radial_(filter.is_radial()),
        inverse_(filter),
        estimator_(estimator),
        rows_(rows),
        exhaustive_(exhaustive) {}

  Rendered render() {
    Rendered out;
    out.pixels = exhaustive_ ? Pixels::every : inverse_.has_negative_lobes() ? Pixels::covered : Pixels::active;
    const Grid grid = rows_.grid();
    out.samples_total = std::int64_t{pattern_.n()} * grid.width * grid.height;
    std::vector<std::size_t> first{0};  // value of each row
    for (int y = 0; y < grid.height; ++y) {
      std::size_t count = first.back();
      for (const Run& run : rows_.row(y)) {
        if (is_rendered(out.pixels, run.cover)) count += static_cast<std::size_t>(run.x1 - run.x0);
      }
      first.push_back(count);
    }
    out.value.resize(first.back());
    std::vector<std::int64_t> evaluated(static_cast<std::size_t>(grid.height));
    parallel_for(evaluated.size(), [&](std::size_t y) {
      std::size_t index = first[y];
      Block block;
      for (const Run& run : rows_.row(static_cast<int>(y))) {
        if (!is_rendered(out.pixels, run.cover)) continue;
        for (int x = run.x0; x < run.x1; ++x) {
          // A window that is all inside is so for all of its samples: only their signs are asked for.
          const bool flat = !exhaustive_ && run.cover == Cover::all;
          const Pixel pixel{x, static_cast<std::int64_t>(y)};
          block.take(pattern_, pixel, scene_.moves());
          out.value[index++] = value_of(flat ? flat_sums(block) : sums(pixel, block));
          if (!flat) evaluated[y] += pattern_.n();
        }
      }
    });
    for (const std::int64_t e : evaluated) out.samples_evaluated += e;
    return out;
  }

 private:
  // The pattern's points of a pixel, and room for what becomes of some of them.
  struct Block {
    std::vector<double> u, v, t, x, y;
    std::vector<Pixel> pixels;
    std::vector<int> sign;
    std::vector<std::uint8_t> inside;

    void take(const Pattern& pattern, Pixel pixel, bool with_time) {
      const auto n = static_cast<std::size_t>(pattern.n());
      u.resize(n);
      v.resize(n);
      if (with_time) t.resize(n);
      pattern.fill({&pixel, 1}, {u, v, t});
    }
  };

  SignSums flat_sums(const Block& block) const {
    SignSums sums;
    for (std::size_t i = 0; i < block.u.size(); ++i) {
      sums.all += inverse_.sign(block.u[i]) * (is_radial_ ? 1 : inverse_.sign(block.v[i]));
    }
    return {sums.all, sums.all};
  }

  SignSums sums(Pixel pixel, Block& block) const {
    SignSums sums;
    for (std::size_t begin = 0; begin < block.u.size(); begin += kBatch) {
      const std::size_t count = std::min(kBatch, block.u.size() - begin);
      block.x.resize(count);
      block.y.resize(count);
      block.pixels.resize(count);
      block.sign.resize(count);
      block.inside.resize(count);
      for (std::size_t i = 0; i < count; ++i) {
        const Sample sample = sample_of(block.u[begin + i], block.v[begin + i]);
        const Placed x = place(sample.x), y = place(sample.y);
        block.pixels[i] = {pixel.x + x.pixel, pixel.y + y.pixel};
        block.x[i] = x.rest;
        block.y[i] = y.rest;
        block.sign[i] = sample.sign;
      }
      if (scene_.moves()) {
        scene_.contains_at(block.pixels, block.x, block.y, std::span(block.t).subspan(begin, count), block.inside);
      } else {
        scene_.contains(block.pixels, block.x, block.y, block.inside);
      }
      for (std::size_t i = 0; i < count; ++i) {
        sums.all += block.sign[i];
        sums.inside += block.sign[i] * block.inside[i];
      }
    }
    return sums;
  }

  // From the pixel's corner, with the sign of the weight.
  struct Sample {
    double x, y;
    int sign;
  };

  Sample sample_of(double u, double v) const {
    if (is_box_) return {u, v, 1};  // to the last bit
    const InverseDistribution::Point a = inverse_.at(u);
    if (is_radial_) {
      const double angle = 2 * std::numbers::pi * v;
      return {0.5 + a.x * std::cos(angle), 0.5 + a.x * std::sin(angle), a.sign};
    }
    const InverseDistribution::Point b = inverse_.at(v);
    return {0.5 + a.x, 0.5 + b.x, a.sign * b.sign};
  }

  // Adding +0.0 turns a negative zero, from signs that are mostly negative, into a positive one.
  double value_of(const SignSums& sums) const {
    const double integral = inverse_.absolute_integral(), area = is_radial_ ? integral : integral * integral;
    const double inside = static_cast<double>(sums.inside), n = pattern_.n();
    if (estimator_ == Estimator::importance || sums.all == 0) return area * inside / n + 0.0;
    return inside / static_cast<double>(sums.all) + 0.0;
  }

  const TestImage& scene_;
  const Pattern& pattern_;
  bool is_box_, is_radial_;
  InverseDistribution inverse_;
  Estimator estimator_;
  const ActiveRows& rows_;
  bool exhaustive_;
};

}  // namespace

Rendered render_importance(const TestImage& scene, const Pattern& pattern, const Filter& filter, Estimator estimator,
                           const ActiveRows& rows, bool exhaustive) {
  assert(!scene.moves() || pattern.has_time());
  return ImportanceRenderer(scene, pattern, filter, estimator, rows, exhaustive).render();
}

}  // namespace moire
