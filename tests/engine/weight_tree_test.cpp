// Weights of fixed points, summed over blocks: the sums are what they are defined to be and near exact ones, and
// skipping what the scene holds as wholes changes no bit of a cell or of an image.
#include "engine/weight_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "catalogue.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "engine/render.h"
#include "engine/skipping.h"
#include "engine/tree_cells.h"

using namespace moire;
using namespace moire::test;

namespace {

struct PointSet {
  std::vector<double> x, y;
};

PointSet points_of(const Pattern& pattern) {
  const auto n = static_cast<std::size_t>(pattern.n());
  PointSet set{std::vector<double>(n), std::vector<double>(n)};
  const Pixel pixel{};
  pattern.fill({&pixel, 1}, {set.x, set.y});
  return set;
}

// Those of the catalogue whose points are the same in every pixel, so many or the next count that they can have.
std::vector<Pattern> fixed_patterns(int n) {
  std::vector<Pattern> all;
  for (const PatternChoice& choice : pattern_catalogue()) {
    if (!choice.varies()) all.emplace_back(choice, choice.info().counts(choice.args(), n).above, Draw{});
  }
  return all;
}

std::vector<Filter> all_filters() {
  std::vector<Filter> all;
  for (const std::string& text : filter_variants()) all.emplace_back(parse_spec(text, "test"));
  return all;
}

// The weight of a point so far from a pixel's centre, before any rounding of a product.
long double weight(const Filter& filter, double dx, double dy) {
  if (filter.is_radial()) return static_cast<long double>(filter.radial_kernel().k(std::sqrt(dx * dx + dy * dy)));
  return static_cast<long double>(filter.kernel().k(dx)) * static_cast<long double>(filter.kernel().k(dy));
}

// Kernels of one to eleven cells, separable and radial, smooth and not, with and without negative lobes.
std::vector<Filter> narrow_and_wide_filters() {
  std::vector<Filter> filters;
  for (const char* text : {"box:width=0.5", "box:width=1.5", "tent", "mitchell", "gaussian", "lanczos", "lanczos:a=5",
                           "disk", "radial-gaussian:sigma=0.1,radius=0.3", "radial-bc", "jinc"}) {
    filters.emplace_back(parse_spec(text, "test"));
  }
  return filters;
}

// Uneven sets: crowded in a corner, so that most leaves are empty and one has nearly all, and many of them in one
// place.
std::vector<PointSet> uneven_sets() {
  std::vector<PointSet> all;
  const Key key{1, 2};
  for (const double extent : {0x1p-20, 0.01, 0.3}) {
    PointSet set;
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const Words w = hash(key, i, Axis::shift);
      set.x.push_back(i % 10 == 0 ? 0.0 : extent * unit(w.a, w.b));
      set.y.push_back(i % 10 == 0 ? 0.5 : 1 - 0x1p-53 - extent * unit(w.c, w.d));
    }
    all.push_back(std::move(set));
  }
  return all;
}

std::size_t largest_leaf(const WeightTree& tree) {
  std::size_t most = 0;
  for (std::uint32_t b = 1; b < tree.blocks(); ++b) {
    if (tree.is_leaf(b)) most = std::max(most, tree.end(b) - tree.begin(b));
  }
  return most;
}

// Cells of the image and one around it, every `step`th, whose sums differ between the two ways; counts the tests of the
// quicker one.
int differences(const TestImage& scene, const WeightTree& tree, int step, std::int64_t& tested) {
  TreeCells cells(scene, tree);
  const std::size_t size = tree.side() * tree.side();
  std::vector<WeightSum> some(size), all(size);
  OwnCount some_own, all_own;
  int count = 0, cell = 0;
  const auto n = static_cast<std::int64_t>(tree.x().size());
  for (int y = -1; y <= scene.grid().height; ++y) {
    for (int x = -1; x <= scene.grid().width; ++x) {
      if (cell++ % step != 0) continue;
      const std::int64_t few = cells.test_crossed({x, y}, some, some_own);
      tested += few;
      bool same = few <= n && cells.test_all({x, y}, all, all_own) == n && some_own.samples == all_own.samples &&
                  some_own.inside == all_own.inside;
      for (std::size_t i = 0; i < size; ++i) {
        same = same && same_bits(some[i].k, all[i].k) && same_bits(some[i].kf, all[i].kf);
      }
      count += !same;
    }
  }
  return count;
}

constexpr Estimator kShared[] = {Estimator::ratio, Estimator::unnormalised, Estimator::control_variate};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("blocks halve the pixel in turns, and hold the points that lie in them, in order") {
    const Filter filter(parse_spec("tent", "test"));
    for (const int n : {1, 2, 3, 5, 16, 17, 255, 1000, 4096}) {
      for (const Pattern& pattern : fixed_patterns(n)) {
        const PointSet set = points_of(pattern);
        const WeightTree tree(filter, set.x, set.y);
        REQUIRE(tree.blocks() == std::uint32_t{2} << tree.depth());
        CHECK(tree.columns() * tree.rows() == 1 << tree.depth());
        CHECK(tree.begin(1) == 0);
        CHECK(tree.end(1) == set.x.size());
        int wrong = 0;
        for (std::uint32_t b = 1; !tree.is_leaf(b); ++b) {
          const int level = static_cast<int>(std::bit_width(b)) - 1;
          wrong += tree.begin(b) != tree.begin(2 * b) || tree.end(2 * b) != tree.begin(2 * b + 1) ||
                   tree.end(2 * b + 1) != tree.end(b);
          // Everything in the first half is left of (above) everything in the second, by the halves' grid.
          const auto v = level % 2 == 0 ? tree.x() : tree.y();
          const double size = std::ldexp(1.0, -(level / 2) - 1);
          for (std::size_t i = tree.begin(b); i < tree.end(b); ++i) {
            const bool second = std::fmod(std::floor(v[i] / size), 2.0) == 1.0;
            wrong += second != (i >= tree.end(2 * b));
          }
        }
        CHECK(wrong == 0);
        std::vector<std::pair<double, double>> given, kept;
        for (std::size_t i = 0; i < set.x.size(); ++i) {
          given.emplace_back(set.x[i], set.y[i]);
          kept.emplace_back(tree.x()[i], tree.y()[i]);
        }
        if (tree.depth() == 0) CHECK(given == kept);
        std::sort(given.begin(), given.end());
        std::sort(kept.begin(), kept.end());
        CHECK(given == kept);
      }
    }
  }

  TEST_CASE("a block's sum is the sum of its halves, and near the sum over its points in long double") {
    std::vector<PointSet> sets = uneven_sets();
    for (const int n : {1, 2, 3, 5, 255, 4096}) {
      for (const Pattern& pattern : fixed_patterns(n)) sets.push_back(points_of(pattern));
    }
    for (const Filter& filter : narrow_and_wide_filters()) {
      CAPTURE(filter.text());
      const int reach = filter.apron();
      for (const PointSet& set : sets) {
        const WeightTree tree(filter, set.x, set.y);
        // Additions one after the other in a leaf, then one for each level, and the product's own rounding; 1.01 for
        // products of those. Weights from k() and weights() are the same bits.
        const long double unit_error = static_cast<long double>(largest_leaf(tree)) + tree.depth() + 1;
        int wrong = 0;
        for (const std::uint32_t b : {1u, 2u, 3u, 5u, tree.blocks() / 2, tree.blocks() - 1}) {
          if (b >= tree.blocks()) continue;
          for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
              long double sum = 0, absolute = 0;
              for (std::size_t i = tree.begin(b); i < tree.end(b); ++i) {
                const long double w = weight(filter, tree.x()[i] - (dx + 0.5), tree.y()[i] - (dy + 0.5));
                sum += w;
                absolute += std::fabs(w);
              }
              const std::size_t at =
                  static_cast<std::size_t>(dy + reach) * tree.pitch() + static_cast<std::size_t>(dx + reach);
              const double got = tree.sum(b)[at];
              wrong += !(std::fabs(static_cast<long double>(got) - sum) <= 1.01L * unit_error * 0x1p-53L * absolute);
              wrong += std::signbit(got) && got == 0;
              if (!tree.is_leaf(b)) wrong += !same_bits(got, tree.sum(2 * b)[at] + tree.sum(2 * b + 1)[at]);
            }
          }
        }
        CHECK(wrong == 0);
      }
    }
  }

  TEST_CASE("a cell's sums are those over its points inside, in long double") {
    const TestImage scene = scenes::disk({3.3, 2.7}, 2.1, {6, 6});
    for (const Filter& filter : narrow_and_wide_filters()) {
      const int reach = filter.apron();
      for (const int n : {5, 255, 1024}) {
        const Pattern pattern(PatternChoice(parse_spec("zaremba", "test")), n, {});
        const PointSet set = points_of(pattern);
        const WeightTree tree(filter, set.x, set.y);
        TreeCells cells(scene, tree);
        std::vector<WeightSum> sums(tree.side() * tree.side());
        OwnCount own;
        int wrong = 0;
        for (const Pixel pixel : {Pixel{1, 1}, Pixel{3, 2}, Pixel{4, 4}, Pixel{0, 0}}) {
          cells.test_crossed(pixel, sums, own);
          OwnCount expected;
          for (std::size_t at = 0; at < sums.size(); ++at) {
            const int dx = static_cast<int>(at % tree.side()) - reach, dy = static_cast<int>(at / tree.side()) - reach;
            long double k = 0, kf = 0, absolute = 0;
            for (std::size_t i = 0; i < set.x.size(); ++i) {
              // No point of these lies near the circle.
              const bool inside = std::hypot(static_cast<double>(pixel.x) + set.x[i] - 3.3,
                                             static_cast<double>(pixel.y) + set.y[i] - 2.7) <= 2.1;
              const long double w = weight(filter, set.x[i] - (dx + 0.5), set.y[i] - (dy + 0.5));
              k += w;
              kf += inside ? w : 0;
              absolute += std::fabs(w);
              const double r = filter.radius(), ox = set.x[i] - 0.5, oy = set.y[i] - 0.5;
              if (dx != 0 || dy != 0 || ox < -r || ox >= r || oy < -r || oy >= r) continue;
              ++expected.samples;
              expected.inside += inside;
            }
            const long double bound =
                1.01L * (static_cast<long double>(largest_leaf(tree)) + tree.depth() + 1) * 0x1p-53L * absolute;
            const long double k_error = static_cast<long double>(sums[at].k) - k,
                              kf_error = static_cast<long double>(sums[at].kf) - kf;
            wrong += !(std::fabs(k_error) <= bound && std::fabs(kf_error) <= bound);
          }
          wrong += own.samples != expected.samples || own.inside != expected.inside;
        }
        CAPTURE(filter.text());
        CAPTURE(n);
        CHECK(wrong == 0);
      }
    }
  }

  TEST_CASE("an edge crosses at most two leaves more than there are rows and columns, and no others are tested") {
    // A line crosses at most columns + rows - 1 cells; two rows or columns more are touched along their sides.
    const Filter filter(parse_spec("mitchell", "test"));
    for (const int n : {64, 256, 4096, 65536}) {
      for (const Pattern& pattern : fixed_patterns(n)) {
        const PointSet set = points_of(pattern);
        const WeightTree tree(filter, set.x, set.y);
        const std::int64_t most = (tree.columns() + tree.rows() + 1) * static_cast<std::int64_t>(largest_leaf(tree));
        std::vector<WeightSum> sums(tree.side() * tree.side());
        OwnCount own;
        for (const double angle : {0.0, 17.3, 45.0, 97.3, 200.0}) {
          const TestImage scene = scenes::edge({4.3, 4.1}, angle, {8, 8});
          TreeCells cells(scene, tree);
          for (int i = 0; i < 64; ++i) CHECK(cells.test_crossed({i % 8, i / 8}, sums, own) <= most);
        }
      }
    }
  }

  TEST_CASE("a disk of 4,096 fixed samples a pixel needs a twentieth of those in its active pixels") {
    // A line crosses at most 25 of a cell's 16 x 8 leaves, and one cell in four or five is crossed.
    const TestImage scene = scenes::disk({31.7, 32.3}, 25.25, {64, 64});
    const Filter filter(parse_spec("mitchell", "test"));
    const ActiveRows rows = enumerate(scene, filter.radius());
    for (const Pattern& pattern : fixed_patterns(4096)) {
      CHECK(Samples(pattern).same_in_all_pixels());
      const Rendered r = render(scene, pattern, filter, Estimator::ratio, rows);
      CHECK(r.samples_evaluated * 20 < static_cast<std::int64_t>(r.value.size()) * pattern.n());
    }
    const Pattern jittered(PatternChoice(parse_spec("jittered", "test")), 16, {});
    CHECK(!Samples(jittered).same_in_all_pixels());
  }

  TEST_CASE("trees that would not fit are not made: 65,536 points fit, 2^24 do not") {
    for (const Symmetry symmetry : {Symmetry::separable, Symmetry::radial}) {
      CHECK(WeightTree::fits(1, 8, symmetry));
      CHECK(WeightTree::fits(65536, 2, symmetry));
      CHECK(!WeightTree::fits(kMaxSamples, 0, symmetry));
      CHECK(!WeightTree::fits(65536, 64, symmetry));
    }
    // As the constant's comment says.
    CHECK(WeightTree::fits(400'000, 2, Symmetry::separable));
    CHECK(WeightTree::fits(180'000, 2, Symmetry::radial));
    CHECK(!WeightTree::fits(200'000, 2, Symmetry::radial));
  }

  TEST_CASE("blocks taken as wholes change no bit of a cell, for uneven sets and scenes") {
    for (const Filter& filter : narrow_and_wide_filters()) {
      for (const PointSet& set : uneven_sets()) {
        const WeightTree tree(filter, set.x, set.y);
        for (const auto& named : scene_catalogue()) {
          std::int64_t tested = 0;
          CAPTURE(named.first);
          CAPTURE(filter.text());
          CHECK(differences(named.second, tree, 17, tested) == 0);
        }
      }
    }
  }

  TEST_CASE("one thread and several give the same bits where points are fixed") {
    for (const auto& named : scene_catalogue()) {
      const TestImage& scene = named.second;
      CAPTURE(named.first);
      for (const Filter& filter : narrow_and_wide_filters()) {
        const ActiveRows rows = enumerate(scene, filter.radius());
        const auto run = [&](int threads) {
          const ThreadLimit limit(threads);
          const Pattern pattern(PatternChoice(parse_spec("zaremba", "test")), 100, {});
          return render(scene, pattern, filter, Estimator::ratio, rows);
        };
        const Rendered one = run(1), three = run(3);
        int different = one.value.size() != three.value.size() || one.samples_evaluated != three.samples_evaluated;
        for (std::size_t i = 0; i < one.value.size() && different == 0; ++i) {
          different += !same_bits(one.value[i], three.value[i]);
        }
        CHECK(different == 0);
      }
    }
  }
}

// Too slow under sanitizers.
TEST_SUITE("heavy") {
  TEST_CASE("blocks taken as wholes change no bit of a cell: every fixed pattern and filter on every scene") {
    for (const Filter& filter : all_filters()) {
      for (const int n : {1, 2, 3, 5, 255, 4096}) {
        for (const Pattern& pattern : fixed_patterns(n)) {
          const PointSet set = points_of(pattern);
          const WeightTree tree(filter, set.x, set.y);
          std::int64_t tested = 0;
          int wrong = 0;
          // Fewer cells of many points: what matters is how often the boundary passes blocks.
          for (const auto& named : scene_catalogue()) {
            wrong += differences(named.second, tree, n <= 5 ? 1 : n <= 255 ? 13 : 211, tested);
          }
          CAPTURE(filter.text());
          CAPTURE(n);
          CHECK(wrong == 0);
        }
      }
    }
  }

  TEST_CASE("skipping changes no bit of an image: fixed patterns, every estimator, few samples and many") {
    for (const Filter& filter : narrow_and_wide_filters()) {
      for (const int n : {1, 2, 3, 5, 255}) {
        for (const Pattern& pattern : fixed_patterns(n)) {
          for (const auto& named : scene_catalogue()) {
            CAPTURE(named.first);
            check_skipping(named.second, pattern, filter, kShared);
          }
        }
      }
    }
    const Filter mitchell(parse_spec("mitchell", "test"));
    for (const Pattern& pattern : fixed_patterns(4096)) {
      check_skipping(scenes::edge({5.3, 4.7}, 97.3, {12, 10}), pattern, mitchell, kShared);
      check_skipping(scenes::disk({5.7, 4.2}, 3.25, {12, 10}), pattern, mitchell, kShared);
    }
  }
}
