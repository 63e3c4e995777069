// Warnock's sums for the L2 star discrepancy in N log N and N log^2 N, in double-double; sources in the header.
#include "measure/discrepancy/star_l2.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "core/double_double.h"
#include "core/instruction_sets.h"

namespace moire {
namespace {

// 1 - x and 1 + x for 0 <= x <= 1, exactly.
Dd below_one(double x) { return quick_two_sum(1.0, -x); }
Dd above_one(double x) { return quick_two_sum(1.0, x); }

// A sum of numbers >= 0 in which one addition waits for one other, where it would wait for a dozen of a Dd. Each adds
// an error below 2 * 2^-106 of the sum, that of s.lo + v.lo; a Dd's would be 3 * 2^-106.
class LongSum {
 public:
  [[gnu::always_inline]] void add(Dd v) {
    const Dd s = two_sum(high_, v.hi);
    const Dd rest = two_sum(low_, s.lo + v.lo);
    high_ = s.hi;
    low_ = rest.hi;
    lowest_ += rest.lo;
  }
  [[gnu::always_inline]] Dd value() const {
    const Dd s = quick_two_sum(high_, low_);
    return {s.hi, s.lo + lowest_};
  }

 private:
  double high_ = 0, low_ = 0, lowest_ = 0;
};

// Sums over pairs of one item of each side of weight * weight * (1 - max(z, z')), kSums of them side by side. Items
// come in ascending order of z, so that each is the maximum of its pairs with all that came before it.
template <std::size_t kSums>
class MaxSums {
 public:
  [[gnu::always_inline]] void add(std::size_t sum, std::size_t side, Dd weight, double z) {
    total_[sum].add(weight * below_one(z) * before_[sum][1 - side].value());
    before_[sum][side].add(weight);
  }
  Dd total() const {
    Dd all;
    for (const LongSum& t : total_) all = all + t.value();
    return all;
  }

 private:
  std::array<LongSum, kSums> total_;
  std::array<std::array<LongSum, 2>, kSums> before_;
};

// Items of [first, last) that are in ascending order of key in each half become so as a whole; `out` has room for as
// many. visit(item, half) sees them in that order, half 0 for the first one. Which half comes next is as good as
// random: neither this nor `visit` may branch on it.
template <class Item, class Key, class Visit>
[[gnu::always_inline]] inline void merge_halves(Item* first, Item* last, Item* out, const Key& key,
                                                const Visit& visit) {
  const Item* const middle = first + (last - first) / 2;
  const Item *a = first, *b = middle;
  Item* to = out;
  while (a != middle && b != last) {
    const auto upper = static_cast<std::size_t>(key(*b) < key(*a));
    *to = *(upper != 0 ? b : a);
    a += 1 - upper;
    b += upper;
    visit(*to++, upper);
  }
  for (; a != middle; ++a) visit(*to++ = *a, std::size_t{0});
  for (; b != last; ++b) visit(*to++ = *b, std::size_t{1});
  std::copy(out, to, first);
}

// 1 - v, or 1 where not `counts`, without a branch.
[[gnu::always_inline]] inline Dd below_one_if(std::size_t counts, double v) {
  return below_one(static_cast<double>(static_cast<int>(counts)) * v);
}

struct Planar {
  double x, y;
};

// The merges of points in the plane and of those in space, for machines with and without a fused multiply-add, which
// products of Dd want: without, it is a call of the library. Same bits.
struct Spatial;
struct Merges {
  Dd (*planar)(Planar* first, Planar* last, Planar* scratch);
  Dd (*spatial)(Spatial* first, Spatial* last, Spatial* scratch);
  Dd (*few)(const Spatial* first, const Spatial* last);
  Dd (*few_across)(const Spatial* first, const Spatial* last);
};

// Sum over pairs from different halves of the order of x, each in ascending order of y. Leaves all in that order.
[[gnu::always_inline]] inline Dd merge(Planar* first, Planar* last, Planar* scratch) {
  MaxSums<1> across;
  merge_halves(
      first, last, scratch, [](const Planar& p) { return p.y; },
      [&](const Planar& p, std::size_t half) { across.add(0, half, below_one_if(half, p.x), p.y); });
  return across.total();
}

// Sum over pairs of prod_d (1 - max), points in ascending order of x. Leaves them in ascending order of y. Of a pair in
// different halves, the one in the upper half has the greater x.
Dd pairs(const Merges& merges, Planar* first, Planar* last, Planar* scratch) {
  if (last - first < 2) return 0.0;
  Planar* const middle = first + (last - first) / 2;
  const Dd within = pairs(merges, first, middle, scratch) + pairs(merges, middle, last, scratch);
  return within + merges.planar(first, last, scratch);
}

struct Spatial {
  double x, y, t;
  std::size_t side = 0;  // the half of the order of x that it is in
};

// Sum over pairs from different sides and different halves of the order of y, each half in ascending order of t. Leaves
// all in that order. Of a pair, side 1 has the greater x, and the upper half the greater y: each item is weighted with
// the maxima that are its own.
[[gnu::always_inline]] inline Dd merge(Spatial* first, Spatial* last, Spatial* scratch) {
  MaxSums<2> across;  // of pairs whose upper one is on side 1, and on side 0
  merge_halves(
      first, last, scratch, [](const Spatial& p) { return p.t; },
      [&](const Spatial& p, std::size_t half) {
        across.add(p.side ^ half, p.side, below_one_if(p.side, p.x) * below_one_if(half, p.y), p.t);
      });
  return across.total();
}

// The same sum over pairs as the merges find, pair by pair: quicker for a few items. Across: over pairs from
// different sides alone, without a branch.
constexpr std::ptrdiff_t kFew = 8;
template <bool kAcross>
[[gnu::always_inline]] inline Dd sum_of_few(const Spatial* first, const Spatial* last) {
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  LongSum sum;
  for (const Spatial* p = first; p != last; ++p) {
    for (const Spatial* q = first; q != p; ++q) {
      const Dd box = below_one(larger(p->x, q->x)) * below_one(larger(p->y, q->y)) * below_one(larger(p->t, q->t));
      const double counts = kAcross ? static_cast<double>(static_cast<int>(p->side ^ q->side)) : 1;
      sum.add({counts * box.hi, counts * box.lo});
    }
  }
  return sum.value();
}

template <class Key>
void sort_few(Spatial* first, Spatial* last, const Key& key) {
  for (Spatial* end = first; end != last; ++end) {
    const Spatial item = *end;
    Spatial* to = end;
    for (; to != first && key(item) < key(to[-1]); --to) *to = to[-1];
    *to = item;
  }
}

Dd merge_planar(Planar* first, Planar* last, Planar* scratch) { return merge(first, last, scratch); }
Dd merge_spatial(Spatial* first, Spatial* last, Spatial* scratch) { return merge(first, last, scratch); }
Dd few(const Spatial* first, const Spatial* last) { return sum_of_few<false>(first, last); }
Dd few_across(const Spatial* first, const Spatial* last) { return sum_of_few<true>(first, last); }
#if MOIRE_HAS_AVX
[[gnu::target("fma")]] Dd merge_planar_fma(Planar* first, Planar* last, Planar* scratch) {
  return merge(first, last, scratch);
}
[[gnu::target("fma")]] Dd merge_spatial_fma(Spatial* first, Spatial* last, Spatial* scratch) {
  return merge(first, last, scratch);
}
[[gnu::target("fma")]] Dd few_fma(const Spatial* first, const Spatial* last) { return sum_of_few<false>(first, last); }
[[gnu::target("fma")]] Dd few_across_fma(const Spatial* first, const Spatial* last) {
  return sum_of_few<true>(first, last);
}
Merges best_merges() {
  if (__builtin_cpu_supports("fma")) return {merge_planar_fma, merge_spatial_fma, few_fma, few_across_fma};
  return {merge_planar, merge_spatial, few, few_across};
}
#else
Merges best_merges() { return {merge_planar, merge_spatial, few, few_across}; }
#endif

// Sum over pairs from different sides, items in ascending order of y. Leaves them in ascending order of t.
Dd cross_pairs(const Merges& merges, Spatial* first, Spatial* last, Spatial* scratch) {
  if (last - first <= kFew) {
    sort_few(first, last, [](const Spatial& p) { return p.t; });
    return merges.few_across(first, last);
  }
  Spatial* const middle = first + (last - first) / 2;
  const Dd within = cross_pairs(merges, first, middle, scratch) + cross_pairs(merges, middle, last, scratch);
  return within + merges.spatial(first, last, scratch);
}

// As for Planar; `scratch` has room for twice as many.
Dd pairs(const Merges& merges, Spatial* first, Spatial* last, Spatial* scratch) {
  if (last - first <= kFew) {
    sort_few(first, last, [](const Spatial& p) { return p.y; });
    return merges.few(first, last);
  }
  Spatial* const middle = first + (last - first) / 2;
  const Dd within = pairs(merges, first, middle, scratch) + pairs(merges, middle, last, scratch);
  Spatial* to = scratch;
  merge_halves(
      first, last, scratch + (last - first), [](const Spatial& p) { return p.y; },
      [&](Spatial p, std::size_t half) {
        p.side = half;
        *to++ = p;
      });
  return within + cross_pairs(merges, scratch, to, to);
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
    off_diagonal = pairs(best_merges(), items.data(), items.data() + n, scratch.data());
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
    off_diagonal = pairs(best_merges(), items.data(), items.data() + n, scratch.data());
  }
  const Dd square = warnock(points.dims(), static_cast<double>(n), linear, diagonal + off_diagonal + off_diagonal);
  // Roth's lower bound keeps T^2 far above the rounding of any N that fits into memory; but never below 0, whatever
  // comes.
  return std::max(square.value(), 0.0);
}

}  // namespace moire
