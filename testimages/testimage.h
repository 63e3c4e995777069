// Test images ("scenes" on the command line): what is true. Black and white: inside = 1, outside = 0.
//
// A scene is asked relative to a pixel and does the one translation itself, in double-double, so that coordinates far
// from the origin lose nothing. It answers three questions: is this point inside, does the boundary meet this
// rectangle, and what is the boundary around this pixel.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/args.h"
#include "core/geometry.h"
#include "curve/boundary.h"
#include "curve/piece_weight.h"
#include "testimages/radial_rings.h"

namespace moire {

// What a rectangle holds: nothing of the scene, only scene, or perhaps both.
enum class Cover : std::uint8_t { none, all, partial };

// The doubles that define a scene after reading, e.g. {"normal", {0, 1}}.
using StoredDoubles = std::vector<std::pair<std::string, std::vector<double>>>;

template <class S>
concept TestImageType = std::constructible_from<S, const Args&, Grid> &&
    requires(const S& s, Pixel origin, std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
             std::span<std::uint8_t> inside, Rect r, double half_width, Boundary& out) {
  // Points relative to the upper left corners of a run of pixels, x.size() / run.size() points each, pixel-major.
  // inside[i] = 1 or 0. The answer is the exact one for the stored doubles: doubtful signs are settled exactly.
  { s.contains(run, x, y, inside) }
  noexcept;
  // The closed rectangle r, relative to the upper left corner of pixel `origin`. May say partial when unsure, never
  // the reverse: none and all are promises about every point of r, its sides included.
  { s.cover(origin, r) }
  noexcept->std::same_as<Cover>;
  // Appends the closed boundary of any set that equals the scene inside the window: the square of that half width
  // around the CENTRE of pixel `origin`, relative to that centre.
  s.boundary(origin, half_width, out);
  { s.stored() } -> std::same_as<StoredDoubles>;
};

// A scene may reach to a horizon, beyond which it has no detail but towards which its detail has no end: whether the
// closed rectangle r, relative to the upper left corner of pixel `origin`, meets it.
template <class S>
concept HasHorizon = requires(const S& s, Pixel origin, Rect r) {
  { s.meets_horizon(origin, r) }
  noexcept->std::same_as<bool>;
};

// A scene may move while the shutter is open: at time t, from 0 to 1, it is the scene of time 0 moved by t motion().
// Then contains() and stored() are about time 0; cover() is about all times: all and none are promises for every t; and
// boundary() gives a set that, moved by t sweep(), equals the moving scene inside the window at every t.
template <class S>
concept Moves = requires(const S& s, std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                         std::span<const double> t, std::span<std::uint8_t> inside) {
  // Pixels; (0, 0): this scene stands still, and answers as one without motion does, bit for bit.
  { s.motion() }
  noexcept->std::same_as<Vec2>;
  // A displacement that does the same to the scene, up to an ulp of each component: an edge moved along itself
  // stands still.
  { s.sweep() }
  noexcept->std::same_as<Vec2>;
  // contains() at a time of its own for each point, 0 <= t <= 1, exact for the doubles as they are. Where t is not
  // 0 it must be at least 2^-100.
  { s.contains_at(run, x, y, t, inside) }
  noexcept;
};

// The area of a scene inside a window, square pixels, and a guaranteed bound on its error.
struct BoxIntegral {
  double value = 0, bound = 0;
};

// A scene may know the integral over a box, the window around the CENTRE of pixel `origin` of that half width, in a way
// that needs no boundary. No answer where boundary() serves better.
template <class S>
concept HasBoxIntegral = requires(const S& s, Pixel origin, double half_width) {
  { s.box_integral(origin, half_width) } -> std::same_as<std::optional<BoxIntegral>>;
};

// What a scene's part of a window comes to under a weight, and a guaranteed bound on its error.
struct WeightIntegral {
  double value = 0, bound = 0;
};

// The bound on a pixel's value that is worth time, above 0: where the window meets the horizon, and elsewhere.
struct WeightAim {
  double bound = 1e-12, at_horizon = 1e-9;

  // The same for all windows.
  static constexpr WeightAim everywhere(double bound) { return {bound, bound}; }
};

// What may be asked for in place of these.
inline constexpr double kFinestAim = 1e-15, kCoarsestAim = 0.1;

// A scene may know the integral under a separable weight k(x) k(y), the pieces of k in order from the window's left
// side to its right, around the CENTRE of pixel `origin`, or a part of it. The rest is appended to `rest` as boundary()
// would: what is asked is the sum of the two. No answer, and nothing appended, where boundary() alone serves better.
template <class S>
concept HasWeightIntegral = requires(const S& s, Pixel origin, std::span<const PieceWeight> pieces,
                                     const WeightAim& aim, Boundary& rest) {
  { s.weight_integral(origin, pieces, aim, rest) } -> std::same_as<std::optional<WeightIntegral>>;
};

// A scene may know the integral under a radial weight k(r), r the distance from the CENTRE of pixel `origin`, or a part
// of it. The rest is appended to `rest` as boundary() would.
template <class S>
concept HasRadialIntegral = requires(const S& s, Pixel origin, const RadialWeight& weight, const WeightAim& aim,
                                     Boundary& rest) {
  { s.radial_integral(origin, weight, aim, rest) } -> std::same_as<WeightIntegral>;
};

// What strips of a pixel hold of a scene, x and y from the pixel's upper left corner. For every point of the pixel in
// the closed strip j: outside the scene if x < outer_begin[j] or x > outer_end[j], inside if inner_begin[j] <= x <=
// inner_end[j]; begin > end: no such x. Numbers may lie beyond the pixel or be infinite, but are no NaN.
struct Strips {
  std::span<double> outer_begin, outer_end, inner_begin, inner_end;
};

// A scene that is convex in most pixels may know at once what strips of a pixel hold of it: strip j has sides[j] <= y
// <= sides[j + 1], ascending, 0 <= y <= 1. Promises as of cover(), about time 0. False where it does not know: then
// `out` means nothing.
template <class S>
concept HasStrips = requires(const S& s, Pixel origin, std::span<const double> sides, Strips out) {
  { s.strips(origin, sides, out) }
  noexcept->std::same_as<bool>;
};

// One constant record per kind of scene.
struct TestImageInfo {
  std::string_view name, title, cite;
  std::span<const Param> params;
  std::shared_ptr<const void> (*make)(const Args&, Grid);
  void (*contains)(const void*, std::span<const Pixel>, std::span<const double>, std::span<const double>,
                   std::span<std::uint8_t>) noexcept;
  Cover (*cover)(const void*, Pixel, Rect) noexcept;
  void (*boundary)(const void*, Pixel, double, Boundary&);
  StoredDoubles (*stored)(const void*);
  bool (*meets_horizon)(const void*, Pixel, Rect) noexcept;                // null: has none
  std::optional<BoxIntegral> (*box_integral)(const void*, Pixel, double);  // null: has none
  // Null: never moves.
  Vec2 (*motion)(const void*) noexcept;
  Vec2 (*sweep)(const void*) noexcept;
  void (*contains_at)(const void*, std::span<const Pixel>, std::span<const double>, std::span<const double>,
                      std::span<const double>, std::span<std::uint8_t>) noexcept;
  bool (*strips)(const void*, Pixel, std::span<const double>, Strips) noexcept;  // null: has none
  std::optional<WeightIntegral> (*weight_integral)(const void*, Pixel, std::span<const PieceWeight>, const WeightAim&,
                                                   Boundary&);  // null: has none
  WeightIntegral (*radial_integral)(const void*, Pixel, const RadialWeight&, const WeightAim&,
                                    Boundary&);  // null: has none
};

// Every kind of scene, in the order of testimages/CMakeLists.txt.
std::span<const TestImageInfo* const> testimages();

// Throws Error naming the nearest kinds.
const TestImageInfo& find_testimage(std::string_view name, std::string_view place);

// Largest width and height of an image, in pixels.
inline constexpr int kMaxSide = 1 << 20;

// A scene with its image size: a value, cheap to copy, immutable, shared freely between threads.
class TestImage {
 public:
  // `given` holds the keys of a scene file other than kind, name, file, width and height. Throws Error.
  TestImage(const TestImageInfo& info, const Given& given, Grid grid, std::string_view place);

  const TestImageInfo& info() const { return *info_; }
  Grid grid() const noexcept { return grid_; }
  StoredDoubles stored() const { return info_->stored(self_.get()); }

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept {
    info_->contains(self_.get(), run, x, y, inside);
  }
  Cover cover(Pixel origin, Rect r) const noexcept { return info_->cover(self_.get(), origin, r); }
  void boundary(Pixel origin, double half_width, Boundary& out) const {
    info_->boundary(self_.get(), origin, half_width, out);
  }
  bool meets_horizon(Pixel origin, Rect r) const noexcept {
    return info_->meets_horizon != nullptr && info_->meets_horizon(self_.get(), origin, r);
  }
  std::optional<BoxIntegral> box_integral(Pixel origin, double half_width) const {
    if (info_->box_integral == nullptr) return std::nullopt;
    return info_->box_integral(self_.get(), origin, half_width);
  }
  std::optional<WeightIntegral> weight_integral(Pixel origin, std::span<const PieceWeight> pieces, const WeightAim& aim,
                                                Boundary& rest) const {
    if (info_->weight_integral == nullptr) return std::nullopt;
    return info_->weight_integral(self_.get(), origin, pieces, aim, rest);
  }
  // See HasRadialIntegral.
  bool has_radial_integral() const noexcept { return info_->radial_integral != nullptr; }
  // Precondition: has_radial_integral().
  WeightIntegral radial_integral(Pixel origin, const RadialWeight& weight, const WeightAim& aim, Boundary& rest) const {
    return info_->radial_integral(self_.get(), origin, weight, aim, rest);
  }
  // See HasStrips.
  bool has_strips() const noexcept { return info_->strips != nullptr; }
  bool strips(Pixel origin, std::span<const double> sides, Strips out) const noexcept {
    return info_->strips != nullptr && info_->strips(self_.get(), origin, sides, out);
  }
  // See Moves; (0, 0) for scenes that cannot move.
  Vec2 motion() const noexcept { return info_->motion == nullptr ? Vec2{} : info_->motion(self_.get()); }
  Vec2 sweep() const noexcept { return info_->sweep == nullptr ? Vec2{} : info_->sweep(self_.get()); }
  bool moves() const noexcept { return motion() != Vec2{}; }
  // Precondition: moves().
  void contains_at(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                   std::span<const double> t, std::span<std::uint8_t> inside) const noexcept {
    info_->contains_at(self_.get(), run, x, y, t, inside);
  }

 private:
  const TestImageInfo* info_;
  Grid grid_;
  std::shared_ptr<const void> self_;
};

// Fields that an author writes; describe() adds the table of functions.
struct TestImageText {
  std::string_view name, title, cite;
  std::span<const Param> params;
};

template <class S>
constexpr auto horizon_of() -> bool (*)(const void*, Pixel, Rect) noexcept {
  if constexpr (HasHorizon<S>) {
    return [](const void* p, Pixel o, Rect r) noexcept { return static_cast<const S*>(p)->meets_horizon(o, r); };
  } else {
    return nullptr;
  }
}

template <class S>
constexpr auto box_integral_of() -> std::optional<BoxIntegral> (*)(const void*, Pixel, double) {
  if constexpr (HasBoxIntegral<S>) {
    return [](const void* p, Pixel o, double h) { return static_cast<const S*>(p)->box_integral(o, h); };
  } else {
    return nullptr;
  }
}

template <class S>
constexpr auto motion_of() -> Vec2 (*)(const void*) noexcept {
  if constexpr (Moves<S>) {
    return [](const void* p) noexcept { return static_cast<const S*>(p)->motion(); };
  } else {
    return nullptr;
  }
}

template <class S>
constexpr auto sweep_of() -> Vec2 (*)(const void*) noexcept {
  if constexpr (Moves<S>) {
    return [](const void* p) noexcept { return static_cast<const S*>(p)->sweep(); };
  } else {
    return nullptr;
  }
}

template <class S>
constexpr auto contains_at_of()
    -> void (*)(const void*, std::span<const Pixel>, std::span<const double>, std::span<const double>,
                std::span<const double>, std::span<std::uint8_t>) noexcept {
  if constexpr (Moves<S>) {
    return [](const void* p, std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
              std::span<const double> t,
              std::span<std::uint8_t> inside) noexcept { static_cast<const S*>(p)->contains_at(run, x, y, t, inside); };
  } else {
    return nullptr;
  }
}

template <class S>
constexpr auto strips_of() -> bool (*)(const void*, Pixel, std::span<const double>, Strips) noexcept {
  if constexpr (HasStrips<S>) {
    return [](const void* p, Pixel o, std::span<const double> sides, Strips out) noexcept {
      return static_cast<const S*>(p)->strips(o, sides, out);
    };
  } else {
    return nullptr;
  }
}

template <class S>
constexpr auto weight_integral_of()
    -> std::optional<WeightIntegral> (*)(const void*, Pixel, std::span<const PieceWeight>, const WeightAim&,
                                         Boundary&) {
  if constexpr (HasWeightIntegral<S>) {
    return [](const void* p, Pixel o, std::span<const PieceWeight> pieces, const WeightAim& aim, Boundary& rest) {
      return static_cast<const S*>(p)->weight_integral(o, pieces, aim, rest);
    };
  } else {
    return nullptr;
  }
}

template <class S>
constexpr auto radial_integral_of()
    -> WeightIntegral (*)(const void*, Pixel, const RadialWeight&, const WeightAim&, Boundary&) {
  if constexpr (HasRadialIntegral<S>) {
    return [](const void* p, Pixel o, const RadialWeight& weight, const WeightAim& aim, Boundary& rest) {
      return static_cast<const S*>(p)->radial_integral(o, weight, aim, rest);
    };
  } else {
    return nullptr;
  }
}

template <TestImageType S>
constexpr TestImageInfo describe(const TestImageText& t) {
  return {t.name,
          t.title,
          t.cite,
          t.params,
          [](const Args& a, Grid g) -> std::shared_ptr<const void> { return std::make_shared<const S>(a, g); },
          [](const void* p, std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
             std::span<std::uint8_t> in) noexcept { static_cast<const S*>(p)->contains(run, x, y, in); },
          [](const void* p, Pixel o, Rect r) noexcept { return static_cast<const S*>(p)->cover(o, r); },
          [](const void* p, Pixel o, double h, Boundary& out) { static_cast<const S*>(p)->boundary(o, h, out); },
          [](const void* p) { return static_cast<const S*>(p)->stored(); },
          horizon_of<S>(),
          box_integral_of<S>(),
          motion_of<S>(),
          sweep_of<S>(),
          contains_at_of<S>(),
          strips_of<S>(),
          weight_integral_of<S>(),
          radial_integral_of<S>()};
}

}  // namespace moire
