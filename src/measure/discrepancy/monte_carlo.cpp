// L2 discrepancies by counting points in random boxes, half-planes and disks.
#include "measure/discrepancy/monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/instruction_sets.h"
#include "core/parallel.h"

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

// The tests, as what is inside of them; t of points in the plane is not looked at.
struct Box2 {
  double x, y;
  [[gnu::always_inline]] bool operator()(double px, double py, double) const { return (px < x) & (py < y); }
};

struct Box3 {
  double x, y, t;
  [[gnu::always_inline]] bool operator()(double px, double py, double pt) const {
    return (px < x) & (py < y) & (pt < t);
  }
};

struct HalfPlane {
  TestLine line;
  [[gnu::always_inline]] bool operator()(double px, double py, double) const {
    return line.nx * px + line.ny * py >= line.c;
  }
};

struct Disk {
  double x, y, square;
  [[gnu::always_inline]] bool operator()(double px, double py, double) const {
    const double dx = std::fabs(px - x), dy = std::fabs(py - y), other_x = 1 - dx, other_y = 1 - dy;
    // To the nearest image; of radius 1/2 at most, the disk meets no other.
    const double to_x = dx < other_x ? dx : other_x, to_y = dy < other_y ? dy : other_y;
    return to_x * to_x + to_y * to_y <= square;
  }
};

// Points from `first` on that are inside. Without branches, so that compilers vectorise it.
template <class Region>
[[gnu::always_inline]] inline std::int64_t count_loop(const PointView& points, std::size_t first, const Region& of) {
  const Region region = of;
  const double *const x = points.x.data(), *const y = points.y.data(), *const t = points.t.data();
  const std::size_t n = points.size();
  std::int64_t count = 0;
  if constexpr (std::is_same_v<Region, Box3>) {
    for (std::size_t i = first; i < n; ++i) count += region(x[i], y[i], t[i]) ? 1 : 0;
  } else {
    for (std::size_t i = first; i < n; ++i) count += region(x[i], y[i], 0) ? 1 : 0;
  }
  return count;
}

template <class Region>
using Count = std::int64_t (*)(const PointView& points, std::size_t first, const Region& region);

template <class Region>
std::int64_t count_plain(const PointView& points, std::size_t first, const Region& region) {
  return count_loop(points, first, region);
}
#if MOIRE_HAS_AVX
template <class Region>
[[MOIRE_AVX2]] std::int64_t count_avx2(const PointView& points, std::size_t first, const Region& region) {
  return count_loop(points, first, region);
}
template <class Region>
[[MOIRE_AVX512]] std::int64_t count_avx512(const PointView& points, std::size_t first, const Region& region) {
  return count_loop(points, first, region);
}
template <class Region>
constexpr Count<Region> kCounts[] = {count_plain<Region>, count_avx2<Region>, count_avx512<Region>};
#else
template <class Region>
constexpr Count<Region> kCounts[] = {count_plain<Region>};
#endif

// The estimate from tests whose regions, of the areas (or volumes) given, are those of the indices.
template <class Region, class Test>
MonteCarlo run_tests(const PointView& points, std::int64_t tests, Counted counted, const Test& test) {
  const Count<Region> count = kCounts<Region>[usable_sets() - 1];
  const std::size_t first = counted == Counted::all ? 0 : 1;
  const auto n = static_cast<double>(points.size());
  return run(tests, [&](std::uint64_t index) {
    const std::pair<Region, double> region_and_area = test(index);
    const std::int64_t inside = count(points, first, region_and_area.first);
    return static_cast<double>(inside) / n - region_and_area.second;
  });
}

}  // namespace

MonteCarlo star_l2_monte_carlo(const PointView& points, std::int64_t tests, const Key& key, Counted counted) {
  if (points.dims() == 2) {
    return run_tests<Box2>(points, tests, counted, [&](std::uint64_t index) {
      const Uniforms u = uniforms(key, index, Axis::test_box);
      return std::pair(Box2{u.a, u.b}, u.a * u.b);
    });
  }
  return run_tests<Box3>(points, tests, counted, [&](std::uint64_t index) {
    const Uniforms u = uniforms(key, index, Axis::test_box);
    return std::pair(Box3{u.a, u.b, u.c}, u.a * u.b * u.c);
  });
}

MonteCarlo edge_l2_monte_carlo(const PointView& points, LineLaw law, std::int64_t tests, const Key& key,
                               Counted counted) {
  return run_tests<HalfPlane>(points, tests, counted, [&](std::uint64_t index) {
    const TestLine line = test_line(law, key, index);
    return std::pair(HalfPlane{line}, area_above(line));
  });
}

MonteCarlo edge_l2_monte_carlo(const PointView& points, std::span<const MeasuredLine> lines, Counted counted) {
  return run_tests<HalfPlane>(points, static_cast<std::int64_t>(lines.size()), counted, [&](std::uint64_t index) {
    const MeasuredLine& line = lines[index];
    return std::pair(HalfPlane{line.line}, line.area);
  });
}

MonteCarlo disk_l2_monte_carlo(const PointView& points, std::optional<double> radius, std::int64_t tests,
                               const Key& key, Counted counted) {
  return run_tests<Disk>(points, tests, counted, [&](std::uint64_t index) {
    const Uniforms u = uniforms(key, index, Axis::test_disk);
    const double square = radius ? *radius * *radius : u.c * u.c / 4;
    return std::pair(Disk{u.a, u.b, square}, std::numbers::pi * square);
  });
}

}  // namespace moire
