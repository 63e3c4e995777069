// L2 discrepancies by counting points in random boxes, half-planes and disks.
#include "measure/discrepancy/monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "measure/discrepancy/test_lines.h"

namespace moire {
namespace {

// Mean and sum of squared deviations of D^2, kept as Welford, "Note on a method for calculating corrected sums of
// squares and products", Technometrics 4, 1962, does; merged as Chan, Golub and LeVeque, 1979, do.
struct Moments {
  double count = 0, mean = 0, deviations = 0;

  void add(double x) {
    count += 1;
    const double before = x - mean;
    mean += before / count;
    deviations += before * (x - mean);
  }
  void add(const Moments& other) {
    if (other.count == 0) return;
    const double together = count + other.count, difference = other.mean - mean;
    mean += difference * (other.count / together);
    deviations += other.deviations + difference * difference * (count * other.count / together);
    count = together;
  }
};

// Runs discrepancy(index) for all tests: blocks in parallel, each into its own slot, merged in order.
template <class Discrepancy>
MonteCarlo run(std::int64_t tests, const Discrepancy& discrepancy) {
  constexpr std::int64_t kBlock = 1024;
  std::vector<Moments> blocks(static_cast<std::size_t>((tests + kBlock - 1) / kBlock));
  parallel_for(blocks.size(), [&](std::size_t b) {
    const std::int64_t begin = static_cast<std::int64_t>(b) * kBlock, end = std::min(begin + kBlock, tests);
    Moments block;
    for (std::int64_t i = begin; i < end; ++i) {
      const double d = discrepancy(static_cast<std::uint64_t>(i));
      block.add(d * d);
    }
    blocks[b] = block;
  });
  Moments all;
  for (const Moments& block : blocks) all.add(block);
  const double variance = all.count > 1 ? all.deviations / (all.count - 1) : 0;
  return {all.mean, std::sqrt(variance / all.count)};
}

// Four numbers in [0, 1) of one test.
struct Uniforms {
  double a, b, c, d;
};

Uniforms uniforms(const Key& key, std::uint64_t index, Axis axis) {
  const auto low = static_cast<std::uint32_t>(index), high = static_cast<std::uint32_t>(index >> 32);
  const Words r = hash(key, low, axis, 2 * high), s = hash(key, low, axis, 2 * high + 1);
  return {unit(r.a, r.b), unit(r.c, r.d), unit(s.a, s.b), unit(s.c, s.d)};
}

// Share of the N points that are counted and inside.
template <class Inside>
double share(const PointView& points, Counted counted, const Inside& inside) {
  const std::size_t n = points.size();
  // Without branches, so that compilers vectorise it.
  std::int64_t count = 0;
  for (std::size_t i = counted == Counted::all ? 0 : 1; i < n; ++i) count += inside(i) ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(n);
}

}  // namespace

MonteCarlo star_l2_monte_carlo(const PointView& points, std::int64_t tests, const Key& key, Counted counted) {
  const double *const x = points.x.data(), *const y = points.y.data(), *const t = points.t.data();
  if (points.dims() == 2) {
    return run(tests, [&](std::uint64_t index) {
      const Uniforms u = uniforms(key, index, Axis::test_box);
      return share(points, counted, [=](std::size_t i) { return (x[i] < u.a) & (y[i] < u.b); }) - u.a * u.b;
    });
  }
  return run(tests, [&](std::uint64_t index) {
    const Uniforms u = uniforms(key, index, Axis::test_box);
    const auto inside = [=](std::size_t i) { return (x[i] < u.a) & (y[i] < u.b) & (t[i] < u.c); };
    return share(points, counted, inside) - u.a * u.b * u.c;
  });
}

MonteCarlo edge_l2_monte_carlo(const PointView& points, LineLaw law, std::int64_t tests, const Key& key,
                               Counted counted) {
  const double *const x = points.x.data(), *const y = points.y.data();
  return run(tests, [&](std::uint64_t index) {
    const TestLine line = test_line(law, key, index);
    const auto inside = [=](std::size_t i) { return line.nx * x[i] + line.ny * y[i] >= line.c; };
    return share(points, counted, inside) - area_above(line);
  });
}

MonteCarlo disk_l2_monte_carlo(const PointView& points, std::optional<double> radius, std::int64_t tests,
                               const Key& key, Counted counted) {
  const double *const x = points.x.data(), *const y = points.y.data();
  return run(tests, [&](std::uint64_t index) {
    const Uniforms u = uniforms(key, index, Axis::test_disk);
    const double square = radius ? *radius * *radius : u.c * u.c / 4;
    const auto inside = [=](std::size_t i) {
      const double dx = std::fabs(x[i] - u.a), dy = std::fabs(y[i] - u.b);
      // To the nearest image; of radius 1/2 at most, the disk meets no other.
      const double to_x = std::min(dx, 1 - dx), to_y = std::min(dy, 1 - dy);
      return to_x * to_x + to_y * to_y <= square;
    };
    return share(points, counted, inside) - std::numbers::pi * square;
  });
}

}  // namespace moire
