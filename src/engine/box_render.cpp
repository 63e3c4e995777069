// Images under the unit box; see box_render.h.
#include "engine/box_render.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "engine/box_count.h"
#include "engine/estimate.h"

namespace moire {
namespace {

// Pixels that go together: some 10 us of work at least, beside which handing them out costs little, and no more, since
// the boundary in a small image has only a few hundred pixels for all threads.
std::int64_t pixels_together(int n) { return std::clamp((1 << 14) / n, 32, 128); }

class BoxRenderer {
 public:
  BoxRenderer(const TestImage& scene, const Pattern& pattern, Estimator estimator, const ActiveRows& rows,
              bool exhaustive)
      : scene_(scene), pattern_(pattern), estimator_(estimator), rows_(rows), exhaustive_(exhaustive) {
    out_.pixels = rendered_pixels(estimator, exhaustive);
    const Grid grid = rows.grid();
    out_.samples_total = std::int64_t{pattern.n()} * grid.width * grid.height;
    first_.reserve(static_cast<std::size_t>(grid.height) + 1);
    first_.push_back(0);
    for (int y = 0; y < grid.height; ++y) {
      std::int64_t count = 0;
      for (const Run& r : rows.row(y)) count += is_rendered(out_.pixels, r.cover) ? r.x1 - r.x0 : 0;
      first_.push_back(first_.back() + count);
    }
    out_.value.resize(static_cast<std::size_t>(first_.back()));
  }

  Rendered render() && {
    const std::int64_t together = pixels_together(pattern_.n()), chunks = (first_.back() + together - 1) / together;
    std::vector<std::int64_t> evaluated(static_cast<std::size_t>(chunks));
    parallel_for(evaluated.size(), [&](std::size_t i) {
      const std::int64_t begin = static_cast<std::int64_t>(i) * together;
      evaluated[i] = render_pixels(begin, std::min(begin + together, first_.back()));
    });
    for (const std::int64_t e : evaluated) out_.samples_evaluated += e;
    return std::move(out_);
  }

 private:
  // The pixels of these numbers, row-major among those that have a value; returns the samples tested.
  std::int64_t render_pixels(std::int64_t begin, std::int64_t end) {
    BoxCounter counter(scene_, pattern_);
    std::vector<std::int64_t> inside;
    std::int64_t evaluated = 0;
    for (auto y = static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), begin) - first_.begin()) - 1;
         begin < end; ++y) {
      std::int64_t at = first_[y];  // number of the run's first pixel
      for (const Run& run : rows_.row(static_cast<int>(y))) {
        if (!is_rendered(out_.pixels, run.cover)) continue;
        const std::int64_t next = at + run.x1 - run.x0, stop = std::min(end, next);
        if (begin < stop) {
          const int x0 = run.x0 + static_cast<int>(begin - at), x1 = run.x0 + static_cast<int>(stop - at);
          inside.resize(static_cast<std::size_t>(x1 - x0));
          evaluated += count(counter, run.cover, x0, x1, static_cast<int>(y), inside);
          for (const std::int64_t i : inside) out_.value[static_cast<std::size_t>(begin++)] = value_of(i);
        }
        at = next;
      }
    }
    return evaluated;
  }

  // Samples inside, of each of the pixels x0 <= x < x1 of row y; returns the samples tested.
  std::int64_t count(BoxCounter& counter, Cover cover, int x0, int x1, int y, std::span<std::int64_t> inside) const {
    const bool by_cells = !exhaustive_ && cover == Cover::partial && counter.has_cells();
    // A pixel that holds nothing of the scene may be active: its window is grown, and touching counts.
    const bool look_for_empty = !exhaustive_ && estimator_ == Estimator::unnormalised && !by_cells;
    if (!by_cells && !look_for_empty) {
      counter.test_all(x0, x1, y, inside);
      return std::int64_t{pattern_.n()} * (x1 - x0);
    }
    std::int64_t evaluated = 0;
    for (int x = x0; x < x1; ++x) {
      std::int64_t& here = inside[static_cast<std::size_t>(x - x0)];
      if (by_cells) {
        const BoxCounter::Count found = counter.test_crossed({x, y});
        here = found.inside;
        evaluated += found.tested;
      } else if (scene_.cover({x, y}, {{0, 0}, {1, 1}}) == Cover::none) {
        here = 0;
      } else {
        counter.test_all(x, x + 1, y, {&here, 1});
        evaluated += pattern_.n();
      }
    }
    return evaluated;
  }

  double value_of(std::int64_t inside) const {
    const double n = pattern_.n(), count = static_cast<double>(inside);
    return estimate(estimator_, {n, count}, n, [&] { return count / n; }).value;
  }

  const TestImage& scene_;
  const Pattern& pattern_;
  Estimator estimator_;
  const ActiveRows& rows_;
  bool exhaustive_;
  Rendered out_;
  std::vector<std::int64_t> first_;  // number of each row's first pixel, and the end
};

}  // namespace

Rendered render_box(const TestImage& scene, const Pattern& pattern, Estimator estimator, const ActiveRows& rows,
                    bool exhaustive) {
  return BoxRenderer(scene, pattern, estimator, rows, exhaustive).render();
}

}  // namespace moire
