// Warnock's sums for the L2 star discrepancy in N log N and N log^2 N, in double-double; sources in the header.
#include "measure/discrepancy/star_l2.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "core/double_double.h"

namespace moire {
namespace {

// 1 - x and 1 + x for 0 <= x <= 1, exactly.
Dd below_one(double x) { return quick_two_sum(1.0, -x); }
Dd above_one(double x) { return quick_two_sum(1.0, x); }

// Sum over pairs of one item of each side of weight * weight * (1 - max(z, z')). Items come in ascending order of z, so
// that each is the maximum of its pairs with all that came before it.
class MaxSum {
 public:
  void add(int side, Dd weight, double z) {
    total_ = total_ + weight * below_one(z) * before_[1 - side];
    before_[side] = before_[side] + weight;
  }
  // The same with weight 1.
  void add(int side, double z) {
    total_ = total_ + below_one(z) * before_[1 - side];
    before_[side] = before_[side] + Dd(1.0);
  }
  Dd total() const { return total_; }

 private:
  Dd total_, before_[2];
};

// Items of [first, last) that are in ascending order of key in each half become so as a whole; `out` has room for as
// many. visit(item, side) sees them in that order, side 0 for the first half.
template <class Item, class Key, class Visit>
void merge_halves(Item* first, Item* last, Item* out, const Key& key, const Visit& visit) {
  const Item* const middle = first + (last - first) / 2;
  const Item *a = first, *b = middle;
  Item* to = out;
  while (a != middle || b != last) {
    const bool upper = a == middle || (b != last && key(*b) < key(*a));
    *to = upper ? *b++ : *a++;
    visit(*to, upper ? 1 : 0);
    ++to;
  }
  std::copy(out, to, first);
}

struct Planar {
  double x, y;
};

// Sum over pairs of prod_d (1 - max), points in ascending order of x. Leaves them in ascending order of y. Of a pair in
// different halves, the one in the upper half has the greater x.
Dd pairs(Planar* first, Planar* last, Planar* scratch) {
  if (last - first < 2) return 0.0;
  Planar* const middle = first + (last - first) / 2;
  const Dd within = pairs(first, middle, scratch) + pairs(middle, last, scratch);
  MaxSum across;
  merge_halves(
      first, last, scratch, [](const Planar& p) { return p.y; },
      [&](const Planar& p, int side) { side == 0 ? across.add(0, p.y) : across.add(1, below_one(p.x), p.y); });
  return within + across.total();
}

struct Spatial {
  double x, y, t;
  int side = 0;  // the half of the order of x that it is in
};

// Sum over pairs from different sides, items in ascending order of y. Leaves them in ascending order of t. Of a pair,
// side 1 has the greater x, and the upper half the greater y: each item is weighted with the maxima that are its own.
Dd cross_pairs(Spatial* first, Spatial* last, Spatial* scratch) {
  if (last - first < 2) return 0.0;
  Spatial* const middle = first + (last - first) / 2;
  const Dd within = cross_pairs(first, middle, scratch) + cross_pairs(middle, last, scratch);
  MaxSum upper_is_right, upper_is_left;
  merge_halves(
      first, last, scratch, [](const Spatial& p) { return p.t; },
      [&](const Spatial& p, int half) {
        if (p.side == 0) {
          half == 0 ? upper_is_right.add(0, p.t) : upper_is_left.add(0, below_one(p.y), p.t);
        } else {
          half == 0 ? upper_is_left.add(1, below_one(p.x), p.t)
                    : upper_is_right.add(1, below_one(p.x) * below_one(p.y), p.t);
        }
      });
  return within + (upper_is_right.total() + upper_is_left.total());
}

// As for Planar; `scratch` has room for twice as many.
Dd pairs(Spatial* first, Spatial* last, Spatial* scratch) {
  if (last - first < 2) return 0.0;
  Spatial* const middle = first + (last - first) / 2;
  const Dd within = pairs(first, middle, scratch) + pairs(middle, last, scratch);
  Spatial* to = scratch;
  merge_halves(
      first, last, scratch + (last - first), [](const Spatial& p) { return p.y; },
      [&](Spatial p, int half) {
        p.side = half;
        *to++ = p;
      });
  return within + cross_pairs(scratch, to, to);
}

// T^2 from Warnock's sums over points and over ordered pairs.
Dd warnock(int dims, double n, Dd linear, Dd squares) {
  const Dd constant = Dd(1.0) / Dd(dims == 2 ? 9.0 : 27.0);
  const Dd count = n;
  return constant - linear * Dd(dims == 2 ? 0.5 : 0.25) / count + squares / (count * count);
}

}  // namespace

double star_l2_squared(const PointView& points) {
  const std::size_t n = points.size();
  // Summed in the order of the sorted points, like all else, so that their first order does not matter.
  Dd linear, diagonal, off_diagonal;
  if (points.dims() == 2) {
    std::vector<Planar> items(n), scratch(n);
    for (std::size_t i = 0; i < n; ++i) items[i] = {points.x[i], points.y[i]};
    std::sort(items.begin(), items.end(),
              [](const Planar& a, const Planar& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    for (const Planar& p : items) {
      const Dd box = below_one(p.x) * below_one(p.y);
      diagonal = diagonal + box;
      linear = linear + box * (above_one(p.x) * above_one(p.y));
    }
    off_diagonal = pairs(items.data(), items.data() + n, scratch.data());
  } else {
    std::vector<Spatial> items(n), scratch(2 * n);
    for (std::size_t i = 0; i < n; ++i) items[i] = {points.x[i], points.y[i], points.t[i]};
    std::sort(items.begin(), items.end(),
              [](const Spatial& a, const Spatial& b) { return std::tie(a.x, a.y, a.t) < std::tie(b.x, b.y, b.t); });
    for (const Spatial& p : items) {
      const Dd box = below_one(p.x) * below_one(p.y) * below_one(p.t);
      diagonal = diagonal + box;
      linear = linear + box * (above_one(p.x) * above_one(p.y) * above_one(p.t));
    }
    off_diagonal = pairs(items.data(), items.data() + n, scratch.data());
  }
  const Dd square = warnock(points.dims(), static_cast<double>(n), linear, diagonal + off_diagonal + off_diagonal);
  // Roth's lower bound keeps T^2 far above the rounding of any N that fits into memory; but never below 0, whatever
  // comes.
  return std::max(square.value(), 0.0);
}

}  // namespace moire
