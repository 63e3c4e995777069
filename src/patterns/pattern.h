// Sampling patterns: where in each pixel we look. The catalogue, and a pattern as a value.
//
// A pattern is made for one sample count and one draw (seed, trial); after that it is immutable and shared between
// threads. It fills points for a run of pixels at a time (about 1024 points), never one by one. Its points in a pixel
// depend on the pixel alone, not on the run or the order in which they are asked for.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/args.h"
#include "core/geometry.h"
#include "patterns/cells.h"

namespace moire {

// Structure of arrays, pixel-major, n points per pixel. x, y in [0, 1) from the pixel's upper left corner; t in [0, 1),
// the time while the shutter is open. t is empty where no time is wanted; x and y are the same bits with and without.
struct Points {
  std::span<double> x, y;
  std::span<double> t = {};
  // Points begin .. begin + count - 1, with t where these have one.
  Points part(std::size_t begin, std::size_t count) const noexcept {
    return {x.subspan(begin, count), y.subspan(begin, count), t.empty() ? t : t.subspan(begin, count)};
  }
};

// Which replicate: `seed` names the experiment, `trial` counts its independent repetitions.
struct Draw {
  std::uint64_t seed = 1;
  std::uint32_t trial = 0;
};

// Largest number of samples per pixel: coordinates stay distinct and addressable in 52 bits up to there.
inline constexpr int kMaxSamples = 1 << 24;

// What a plug-in type must offer. `fill` writes run.size() * n points.
template <class P>
concept PatternType = std::constructible_from<P, const Args&, int, Draw> &&
    requires(const P& p, std::span<const Pixel> run, Points out) {
  { p.fill(run, out) }
  noexcept;
};

// A pattern may have points in time, too: it says so with `static constexpr bool kHasTime = true`, and then fills t
// wherever Points brings one. The others are never asked for it.
template <class P>
concept HasTime = P::kHasTime;

// A pattern may have points outside any pixel (a bank-based one): `fill_set` writes the one set of this draw, which
// `moire points` and the discrepancies use. Without it, that set is the one of pixel (0, 0).
template <class P>
concept HasSet = requires(const P& p, Points out) {
  { p.fill_set(out) }
  noexcept;
};

// A pattern may fill a whole image as one set, without regard to pixels: Mitchell's second way, and what shows a
// pattern's grain. `area_count` is how many points it makes where n are asked for (the nearest count that it can have);
// `fill_area` writes that many, x in [0, area.width) and y in [0, area.height) pixels, t in [0, 1), in any order. It
// may allocate.
template <class P>
concept FillsArea = requires(const Args& args, Grid area, std::int64_t n, Draw draw, Points out) {
  { P::area_count(args, area, n) } -> std::same_as<std::int64_t>;
  P::fill_area(args, area, draw, out);
};

// A pattern may know how its points lie in cells (cells.h). cells() says it for a pixel; take_cells() counts the points
// of some cells, and writes x and y of those of others, the bits of fill() in any order. No cell may be named twice.
// `out` has room for n points. Only asked where t is not wanted, and from kLeastForCells points a pixel on: with fewer
// it is faster to test all (on edges and disks, whose boundaries are the fastest to follow). The count decides and not
// the machine, so that everywhere as many samples are tested.
template <class P>
concept HasCells = requires(const P& p, Pixel pixel, std::span<const CellSpan> cells, Points out) {
  { P::kLeastForCells } -> std::convertible_to<int>;
  { p.cells(pixel) }
  noexcept->std::same_as<CellGrid>;
  { p.take_cells(pixel, cells, cells, out) }
  noexcept->std::same_as<CellPoints>;
};

// Most points that such a set may have: 2^26, some 2 GiB while they are made and sorted, 3 GiB with times.
inline constexpr std::int64_t kMaxAreaPoints = std::int64_t{1} << 26;

enum class Varies : std::uint8_t {
  never,     // the same points in every pixel and trial
  in_time,   // the same x and y in every pixel and trial; t differs by seed, trial and pixel
  by_trial,  // differs by seed, trial and pixel
};

// One constant record per pattern.
struct PatternInfo {
  std::string_view name, title, cite;
  Varies (*varies)(const Args&);
  // Counts that exist: the largest one <= n and the smallest one >= n, both within [1, kMaxSamples]; equal to n when
  // n itself is one. n is any integer >= 1.
  struct Counts {
    int below, above;
  };
  Counts (*counts)(const Args&, int n);
  std::span<const Param> params;
  std::shared_ptr<const void> (*make)(const Args&, int n, Draw);
  void (*fill)(const void*, std::span<const Pixel>, Points) noexcept;
  void (*fill_set)(const void*, Points) noexcept;
  std::int64_t (*area_count)(const Args&, Grid, std::int64_t);  // null: does not fill areas
  void (*fill_area)(const Args&, Grid, Draw, Points);           // null with area_count
  bool has_time;                                                // whether points have a t
  int least_for_cells;                                          // fewest points a pixel that come in cells; 0: never
  CellGrid (*cells)(const void*, Pixel) noexcept;
  CellPoints (*take_cells)(const void*, Pixel, std::span<const CellSpan>, std::span<const CellSpan>, Points) noexcept;
};

// Every pattern of the program, in the order of patterns/CMakeLists.txt.
std::span<const PatternInfo* const> patterns();

// Throws Error naming the nearest patterns.
const PatternInfo& find_pattern(std::string_view name, std::string_view place);

// What a person asked for: a pattern with checked parameters, not yet tied to a count or a draw.
class PatternChoice {
 public:
  explicit PatternChoice(const Spec& spec);  // throws Error
  const std::string& text() const { return text_; }
  const PatternInfo& info() const { return *info_; }
  const Args& args() const { return args_; }
  // Whether the points differ by seed, trial and pixel: x and y alone, or `with_time` (x, y, t).
  bool varies(bool with_time = false) const {
    const Varies varies = info_->varies(args_);
    return varies == Varies::by_trial || (with_time && varies == Varies::in_time);
  }
  bool has_time() const noexcept { return info_->has_time; }
  // Throws Error naming the nearest usable counts when the pattern cannot have n points.
  void require_count(std::int64_t n) const;
  // Throws Error naming the patterns whose points have a time when this one's have none.
  void require_time() const;
  // Points of the set that fills the area with about n points per pixel. Throws Error when the pattern cannot fill
  // areas, naming those that can, and for more than kMaxAreaPoints points.
  std::int64_t area_count(Grid area, std::int64_t n) const;

 private:
  const PatternInfo* info_;
  Args args_;
  std::string text_;
};

class Pattern {
 public:
  Pattern(const PatternChoice& choice, int n, Draw draw);  // throws Error as require_count does
  int n() const noexcept { return n_; }
  // Whether x and y differ by seed, trial and pixel; if not, they are the same in every pixel.
  bool varies() const noexcept { return varies_; }
  bool has_time() const noexcept { return info_->has_time; }
  // out.x and out.y hold run.size() * n() points, pixel-major; out.t as many, or none. Precondition for t: has_time().
  void fill(std::span<const Pixel> run, Points out) const noexcept { info_->fill(self_.get(), run, out); }
  // The one set of this draw, n() points.
  void fill_set(Points out) const noexcept { info_->fill_set(self_.get(), out); }
  // See HasCells.
  bool has_cells() const noexcept { return info_->least_for_cells > 0 && n_ >= info_->least_for_cells; }
  // A grid of no cells where nothing is known. Precondition: has_cells().
  CellGrid cells(Pixel pixel) const noexcept { return info_->cells(self_.get(), pixel); }
  // Counts the points of `counted` and writes those of `filled`. Precondition: cells() of the pixel has some.
  CellPoints take_cells(Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept {
    return info_->take_cells(self_.get(), pixel, counted, filled, out);
  }

 private:
  const PatternInfo* info_;
  std::shared_ptr<const void> self_;
  int n_;
  bool varies_;
};

// The counts of patterns that take any number of points.
inline PatternInfo::Counts any_count(const Args&, int n) { return {n, n}; }
// The counts m * m.
PatternInfo::Counts square_count(const Args&, int n);

// Fields that an author writes; describe() adds the table of functions.
struct PatternText {
  std::string_view name, title, cite;
  Varies (*varies)(const Args&);
  PatternInfo::Counts (*counts)(const Args&, int n);
  std::span<const Param> params;
};

template <class P>
constexpr auto area_count_of() -> std::int64_t (*)(const Args&, Grid, std::int64_t) {
  if constexpr (FillsArea<P>) return P::area_count;
  return nullptr;
}

template <class P>
constexpr auto fill_area_of() -> void (*)(const Args&, Grid, Draw, Points) {
  if constexpr (FillsArea<P>) return P::fill_area;
  return nullptr;
}

template <class P>
constexpr int least_for_cells_of() {
  if constexpr (HasCells<P>) {
    return P::kLeastForCells;
  } else {
    return 0;
  }
}

template <class P>
constexpr auto cells_of() -> CellGrid (*)(const void*, Pixel) noexcept {
  if constexpr (HasCells<P>) {
    return [](const void* p, Pixel pixel) noexcept { return static_cast<const P*>(p)->cells(pixel); };
  } else {
    return nullptr;
  }
}

template <class P>
constexpr auto take_cells_of()
    -> CellPoints (*)(const void*, Pixel, std::span<const CellSpan>, std::span<const CellSpan>, Points) noexcept {
  if constexpr (HasCells<P>) {
    return [](const void* p, Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
              Points out) noexcept { return static_cast<const P*>(p)->take_cells(pixel, counted, filled, out); };
  } else {
    return nullptr;
  }
}

template <PatternType P>
constexpr PatternInfo describe(const PatternText& t) {
  return {
      t.name,
      t.title,
      t.cite,
      t.varies,
      t.counts,
      t.params,
      [](const Args& a, int n, Draw d) -> std::shared_ptr<const void> { return std::make_shared<const P>(a, n, d); },
      [](const void* p, std::span<const Pixel> run, Points out) noexcept { static_cast<const P*>(p)->fill(run, out); },
      [](const void* p, Points out) noexcept {
        if constexpr (HasSet<P>) {
          static_cast<const P*>(p)->fill_set(out);
        } else {
          const Pixel origin{};
          static_cast<const P*>(p)->fill({&origin, 1}, out);
        }
      },
      area_count_of<P>(),
      fill_area_of<P>(),
      HasTime<P>,
      least_for_cells_of<P>(),
      cells_of<P>(),
      take_cells_of<P>()};
}

}  // namespace moire
