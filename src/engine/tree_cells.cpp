// Sums of cells from a weight tree; see tree_cells.h.
#include "engine/tree_cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace moire {
namespace {

// How many points a look at a block must save. Scenes that know strips have cheap tests, 1 to 2 ns a point, against
// some 50 ns for a look; without strips, as on a board, a test costs 10 to 30 ns and a look no more.
constexpr int kWithStrips = 64, kWithoutStrips = 8;

}  // namespace

TreeCells::Place TreeCells::Place::half(std::uint32_t which) const noexcept {
  const bool cut_x = level % 2 == 0;
  return {2 * block + which, level + 1, cut_x ? 2 * column + which : column, cut_x ? row : 2 * row + which};
}

// All exact: fractions of powers of two.
Rect TreeCells::Place::rect() const noexcept {
  const double width = std::ldexp(1.0, -((level + 1) / 2)), height = std::ldexp(1.0, -(level / 2));
  return {{column * width, row * height}, {(column + 1) * width, (row + 1) * height}};
}

TreeCells::TreeCells(const TestImage& scene, const WeightTree& tree)
    : scene_(scene),
      tree_(tree),
      looks_(0),
      samples_a_look_(scene.has_strips() ? kWithStrips : kWithoutStrips),
      found_(tree.blocks()) {
  assert(!scene.moves());
  const std::size_t n = tree.x().size(), rows = static_cast<std::size_t>(tree.rows());
  looks_ = static_cast<std::int64_t>(n / samples_a_look_);
  sums_.resize((static_cast<std::size_t>(tree.depth()) + 1) * tree.sum_size());
  if (scene.has_strips()) {
    for (std::size_t j = 0; j <= rows; ++j) sides_.push_back(static_cast<double>(j) / static_cast<double>(rows));
    for (auto* bounds : {&strips_.outer_begin, &strips_.outer_end, &strips_.inner_begin, &strips_.inner_end}) {
      bounds->resize(2 * rows);
    }
  }
}

std::int64_t TreeCells::test_all(Pixel pixel, std::span<WeightSum> sums, OwnCount& own) {
  const std::size_t n = tree_.x().size();
  all_partial_.resize(tree_.blocks(), Cover::partial);
  inside_.resize(n);
  scene_.contains({&pixel, 1}, tree_.x(), tree_.y(), inside_);
  taken_ = 0;
  own_inside_ = 0;
  write(sum_up(all_partial_, 1, sums_.data(), sums_.data() + tree_.sum_size()), sums, own);
  return static_cast<std::int64_t>(n);
}

std::int64_t TreeCells::test_crossed(Pixel pixel, std::span<WeightSum> sums, OwnCount& own) {
  x_.clear();
  y_.clear();
  taken_ = 0;
  own_inside_ = 0;
  const Place whole;
  found_[1] = scene_.cover(pixel, whole.rect());
  if (found_[1] == Cover::partial) {
    looks_left_ = looks_;
    find_crossed(pixel, whole, find_strips(pixel));
    inside_.resize(x_.size());
    if (!x_.empty()) scene_.contains({&pixel, 1}, x_, y_, inside_);
  }
  write(sum_up(found_, 1, sums_.data(), sums_.data() + tree_.sum_size()), sums, own);
  assert(taken_ == x_.size());
  return static_cast<std::int64_t>(x_.size());
}

// Fills strips_, from the rows of leaves up to the whole pixel; false where the scene does not know, or one row alone
// would say no more than the look at the pixel has.
bool TreeCells::find_strips(Pixel pixel) {
  const auto rows = static_cast<std::size_t>(tree_.rows());
  if (!scene_.has_strips() || rows == 1) return false;
  const auto last = [rows](std::vector<double>& v) { return std::span<double>(v).subspan(rows); };
  auto& [outer_begin, outer_end, inner_begin, inner_end] = strips_;
  if (!scene_.strips(pixel, sides_, {last(outer_begin), last(outer_end), last(inner_begin), last(inner_end)})) {
    return false;
  }
  // An empty outer range must not widen that of its neighbour; an empty inner one makes the intersection empty anyway.
  for (std::size_t s = rows; s < 2 * rows; ++s) {
    const bool empty = outer_begin[s] > outer_end[s];
    outer_begin[s] = empty ? std::numeric_limits<double>::infinity() : outer_begin[s];
    outer_end[s] = empty ? -std::numeric_limits<double>::infinity() : outer_end[s];
  }
  for (std::size_t s = rows; s-- > 1;) {
    outer_begin[s] = std::min(outer_begin[2 * s], outer_begin[2 * s + 1]);
    outer_end[s] = std::max(outer_end[2 * s], outer_end[2 * s + 1]);
    inner_begin[s] = std::max(inner_begin[2 * s], inner_begin[2 * s + 1]);
    inner_end[s] = std::min(inner_end[2 * s], inner_end[2 * s + 1]);
  }
  return true;
}

// No allowance for rounding: sides of blocks are exact, and so is the block of a point, x0 <= x < x1.
Cover TreeCells::cover_by_strips(const Place& place) const noexcept {
  const std::size_t s = (std::size_t{1} << (place.level / 2)) + place.row;
  const double columns = static_cast<double>(std::uint32_t{1} << ((place.level + 1) / 2));
  const double x0 = place.column / columns, x1 = (place.column + 1) / columns;
  if (strips_.outer_end[s] < x0 || strips_.outer_begin[s] >= x1) return Cover::none;
  return strips_.inner_begin[s] <= x0 && strips_.inner_end[s] >= x1 ? Cover::all : Cover::partial;
}

// Given up after looks_ looks at a pixel: what crowds it so will not be told apart.
Cover TreeCells::look(Pixel pixel, const Place& place) {
  if (looks_left_ == 0 || tree_.end(place.block) - tree_.begin(place.block) < samples_a_look_) return Cover::partial;
  --looks_left_;
  return scene_.cover(pixel, place.rect());
}

// Below a block that may be crossed: what the scene covers of its parts, and the points of crossed leaves.
void TreeCells::find_crossed(Pixel pixel, const Place& place, bool by_strips) {
  if (tree_.is_leaf(place.block)) {
    const std::size_t begin = tree_.begin(place.block), n = tree_.end(place.block) - begin;
    const auto x = tree_.x().subspan(begin, n), y = tree_.y().subspan(begin, n);
    x_.insert(x_.end(), x.begin(), x.end());
    y_.insert(y_.end(), y.begin(), y.end());
    return;
  }
  for (const std::uint32_t which : {0u, 1u}) {
    const Place half = place.half(which);
    found_[half.block] = by_strips ? cover_by_strips(half) : look(pixel, half);
    if (found_[half.block] == Cover::partial) find_crossed(pixel, half, by_strips);
  }
}

// The sum of k f over a block: null for nothing, the tree's own sum for a whole one, or what was written to `out`.
// Leaving out a sum of nothing changes no bit, since x + 0 = x and no sum is -0. `scratch` has room for one sum more
// for each level below.
const double* TreeCells::sum_up(std::span<const Cover> covers, std::uint32_t block, double* out, double* scratch) {
  if (covers[block] == Cover::none) return nullptr;
  if (covers[block] == Cover::all) {
    own_inside_ += tree_.own(tree_.begin(block), tree_.end(block));
    return tree_.sum(block);
  }
  if (tree_.is_leaf(block)) return sum_leaf(block, out);
  const std::size_t size = tree_.sum_size();
  const double* first = sum_up(covers, 2 * block, out, scratch + size);
  const double* second = sum_up(covers, 2 * block + 1, first == out ? scratch : out, scratch + size);
  if (first == nullptr) return second;
  if (second == nullptr) return first;
  if (first == tree_.sum(2 * block) && second == tree_.sum(2 * block + 1)) return tree_.sum(block);
  for (std::size_t i = 0; i < size; ++i) out[i] = first[i] + second[i];
  return out;
}

const double* TreeCells::sum_leaf(std::uint32_t leaf, double* out) {
  const std::size_t begin = tree_.begin(leaf), n = tree_.end(leaf) - begin;
  const std::uint8_t* inside = inside_.data() + taken_;
  if (chosen_.size() < n) chosen_.resize(n);
  taken_ += n;
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    chosen_[count] = i;
    count += inside[i];
  }
  if (count == 0) return nullptr;
  if (count == n) {
    own_inside_ += tree_.own(begin, begin + n);
    return tree_.sum(leaf);
  }
  for (std::size_t c = 0; c < count; ++c) own_inside_ += tree_.own(begin + chosen_[c], begin + chosen_[c] + 1);
  tree_.sum_chosen(leaf, {chosen_.data(), count}, out);
  return out;
}

void TreeCells::write(const double* kf, std::span<WeightSum> sums, OwnCount& own) const {
  const double* k = tree_.sum(1);
  const std::size_t side = tree_.side(), pitch = tree_.pitch();
  for (std::size_t j = 0; j < side; ++j) {
    for (std::size_t i = 0; i < side; ++i) {
      sums[j * side + i] = {k[j * pitch + i], kf == nullptr ? 0.0 : kf[j * pitch + i]};
    }
  }
  own = {tree_.own(0, tree_.x().size()), own_inside_};
}

}  // namespace moire
