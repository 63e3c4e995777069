#include "engine/exact.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/names.h"
#include "core/parallel.h"
#include "core/rounding.h"
#include "core/sum.h"
#include "engine/boundary_integral.h"
#include "engine/inverse_distribution.h"
#include "engine/radial_integral.h"
#include "engine/swept_integral.h"
#include "engine/weight_bounds.h"

namespace moire {
namespace {

// Throws Error for kernels that a moving scene cannot have.
void require_sweepable(const Filter& filter) {
  if (filter.kernel().pieces() <= SweptIntegral::kMaxPieces) return;
  throw Error("filter \"" + filter.text() + "\"", "a kernel of " + std::to_string(filter.kernel().pieces()) +
                                                      " pieces; exact values of a moving scene take at most " +
                                                      std::to_string(SweptIntegral::kMaxPieces));
}

// Throws Error: exact values of moving scenes are not known under this radial filter.
[[noreturn]] void refuse_moving(const Filter& filter) {
  std::vector<std::string_view> known;
  for (const FilterInfo* info : filters()) {
    if (info->symmetry() == Symmetry::separable) known.push_back(info->name);
  }
  throw Error(filter.args().place(), "filter \"" + filter.text() +
                                         "\" is radial, and a moving scene's exact values are known for separable "
                                         "filters only; choose from " +
                                         join(known));
}

double fit_error(const Kernel::PieceBounds& bounds) { return bounds.k_error_at_x; }
double fit_error(const RadialKernel::PieceBounds& bounds) { return bounds.k_error; }

// The kernel, separable or radial, as scenes may know it.
template <class Kernel>
std::vector<PieceWeight> pieces_of(const Kernel& kernel) {
  std::vector<PieceWeight> pieces;
  for (int p = 0; p < kernel.pieces(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    const auto& bounds = kernel.bounds(p);
    pieces.push_back({kernel.knots()[i], kernel.knots()[i + 1], kernel.k_series(p), bounds.k, fit_error(bounds)});
  }
  return pieces;
}

// `besides`: what the integral of the boundary may be off by besides its own bound.
template <class Integral>
Exact integrate(Integral& integral, const Boundary& boundary, double besides) {
  integral.reset();
  for (const Segment& s : boundary.segments) integral.add(s);
  for (const Circle& c : boundary.circles) integral.add(c);
  return {integral.value() + 0.0, integral.bound() + besides};
}

// What is known of every pixel: a scene is 0 or 1 everywhere, so that a value lies between minus the integral of the
// kernel's negative part and that of its positive one. Their difference is 1 and their sum A, the integral of |k|.
class KnownRange {
 public:
  explicit KnownRange(const Filter& filter) : filter_(filter) {}

  // `e`, or the middle of the range and half of its width where the bound of `e` says no more. Written so that a bound
  // that is no number counts as such.
  Exact meet(const Exact& e) {
    if (e.bound <= 0.5) return e;  // A >= 1
    if (!half_) half_ = half_width();
    return e.bound <= *half_ ? e : Exact{0.5, *half_};
  }

 private:
  double half_width() const {
    const InverseDistribution magnitude(filter_);  // in one dimension, of a separable kernel
    const double a = magnitude.absolute_integral() + magnitude.error();
    return 0.5 * (filter_.is_radial() ? a : a * a) * (1 + 0x1p-50);
  }

  const Filter& filter_;
  std::optional<double> half_;  // found when it is first asked for, which it hardly ever is
};

// The scene's boundary in one window, integrated. Buffers are kept from pixel to pixel.
class PixelIntegrator {
 public:
  PixelIntegrator(const TestImage& scene, const Filter& filter, const WeightAim& aim)
      : scene_(scene),
        kernel_(filter.kernel()),
        aim_(aim),
        pieces_(pieces_of(kernel_)),
        bounds_(weight_bounds(kernel_)),
        known_(filter),
        integral_(filter.kernel()) {
    if (kernel_.degree() == 0 && kernel_.pieces() == 1) {
      const double k = kernel_.k(0);
      box_ = true;
      box_weight_ = k * k;
      box_weight_error_ = 2.1 * k * kernel_.k_error() + 3 * kUnit * box_weight_;
    }
    if (scene.sweep() == Vec2{}) return;
    require_sweepable(filter);
    swept_.emplace(kernel_, scene.sweep());
    motion_error_ = swept_->motion_error();
    if (!swept_->moves()) swept_.reset();
  }

  Exact operator()(Pixel pixel) {
    if (box_) {
      const std::optional<BoxIntegral> box = scene_.box_integral(pixel, kernel_.radius());
      if (box) return known_.meet(weighed(*box));
    }
    boundary_.clear();
    const std::optional<WeightIntegral> known = scene_.weight_integral(pixel, pieces_, aim_, boundary_);
    if (!known) scene_.boundary(pixel, kernel_.radius(), boundary_);
    const double besides = doubt(boundary_, bounds_, 2.1 * kernel_.k_max() * kernel_.k_error()) + motion_error_;
    Exact e = swept_ ? integrate(*swept_, boundary_, besides) : integrate(integral_, boundary_, besides);
    if (!known) return known_.meet(e);
    e.value += known->value;
    e.bound += known->bound + kUnit * std::fabs(e.value);
    return known_.meet(e);
  }

 private:
  // A box filter's value from the integral over its window: k(x) k(y) is constant there.
  Exact weighed(const BoxIntegral& box) const {
    return {box.value * box_weight_, (1 + 8 * kUnit) * (box.bound * (box_weight_ + box_weight_error_) +
                                                        std::fabs(box.value) * box_weight_error_)};
  }

  const TestImage& scene_;
  const Kernel& kernel_;
  WeightAim aim_;
  std::vector<PieceWeight> pieces_;
  WeightBounds bounds_;
  KnownRange known_;
  bool box_ = false;  // the kernel is one constant: its square, and what that may be off by
  double box_weight_ = 0, box_weight_error_ = 0;
  BoundaryIntegral integral_;
  std::optional<SweptIntegral> swept_;  // of a scene that moves by more than nothing
  double motion_error_ = 0;
  Boundary boundary_;
};

// The same with a radial filter.
class RadialPixelIntegrator {
 public:
  // The weight is to stay.
  RadialPixelIntegrator(const TestImage& scene, const Filter& filter, const RadialWeight& weight, const WeightAim& aim)
      : scene_(scene), aim_(aim), kernel_(filter.radial_kernel()), weight_(weight), known_(filter), integral_(kernel_) {
    if (scene.sweep() != Vec2{}) refuse_moving(filter);
  }

  Exact operator()(Pixel pixel) {
    boundary_.clear();
    WeightIntegral known;
    if (scene_.has_radial_integral()) {
      known = scene_.radial_integral(pixel, weight_, aim_, boundary_);
    } else {
      scene_.boundary(pixel, kernel_.radius(), boundary_);
    }
    Exact e = integrate(integral_, boundary_, doubt(boundary_, weight_.bounds, kernel_.k_error()));
    if (known.bound > 0) {
      e.value += known.value;
      e.bound += known.bound + kUnit * std::fabs(e.value);
    }
    return known_.meet(e);
  }

 private:
  const TestImage& scene_;
  WeightAim aim_;
  const RadialKernel& kernel_;
  const RadialWeight& weight_;
  KnownRange known_;
  RadialIntegral integral_;
  Boundary boundary_;
};

// Calls visit(x, y, index) for the active pixels with first <= index < last, row-major.
template <class Visit>
void for_active(const ActiveRows& rows, std::int64_t first, std::int64_t last, const Visit& visit) {
  int y = 0;
  for (int end = rows.grid().height; end - y > 1;) {
    const int middle = y + (end - y) / 2;
    (rows.first_active(middle) <= first ? y : end) = middle;
  }
  for (std::int64_t index = rows.first_active(y); index < last; ++y) {
    for (const Run& run : rows.row(y)) {
      if (run.cover != Cover::partial) continue;
      const std::int64_t count = run.x1 - run.x0;
      for (std::int64_t i = std::max<std::int64_t>(0, first - index); i < std::min(count, last - index); ++i)
        visit(run.x0 + static_cast<int>(i), y, index + i);
      index += count;
    }
  }
}

}  // namespace

Exact exact_pixel(const TestImage& scene, const Filter& filter, Pixel pixel, const WeightAim& aim) {
  switch (classify(scene, filter.radius(), pixel)) {
    case Cover::none:
      return {0, 0};
    case Cover::all:
      return {1, 0};
    case Cover::partial:
      break;
  }
  if (!filter.is_radial()) return PixelIntegrator(scene, filter, aim)(pixel);
  const RadialWeight weight(pieces_of(filter.radial_kernel()), weight_bounds(filter.radial_kernel()));
  return RadialPixelIntegrator(scene, filter, weight, aim)(pixel);
}

Reference exact(const TestImage& scene, const Filter& filter, const ActiveRows& rows, const WeightAim& aim) {
  Reference reference;
  reference.value.resize(static_cast<std::size_t>(rows.active_pixels()));
  reference.bound.resize(reference.value.size());
  // Pixels that are found together: making an integrator takes as long as two or three under the box, and handing out
  // work as much again. Under other filters a few rows near a horizon take most of the time.
  const bool uneven = scene.info().meets_horizon != nullptr && !filter.is_unit_box();
  const std::int64_t together = uneven ? 8 : 64;
  const std::int64_t active = rows.active_pixels();
  const auto blocks = static_cast<std::size_t>((active + together - 1) / together);
  std::optional<RadialWeight> weight;
  if (filter.is_radial()) weight.emplace(pieces_of(filter.radial_kernel()), weight_bounds(filter.radial_kernel()));
  // Threads take neighbouring items of a loop, so that blocks from all over the picture are made neighbours.
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(blocks))));
  parallel_for(side * side, [&](std::size_t item) {
    const std::size_t block = item % side * side + item / side;
    if (block >= blocks) return;
    const std::int64_t first = static_cast<std::int64_t>(block) * together;
    const auto fill = [&](auto integrate) {
      for_active(rows, first, std::min(active, first + together), [&](int x, int y, std::int64_t index) {
        const Exact e = integrate(Pixel{x, y});
        reference.value[static_cast<std::size_t>(index)] = e.value;
        reference.bound[static_cast<std::size_t>(index)] = e.bound;
      });
    };
    if (weight) return fill(RadialPixelIntegrator(scene, filter, *weight, aim));
    fill(PixelIntegrator(scene, filter, aim));
  });
  Sum squares;
  for (const double b : reference.bound) {
    reference.max_bound = std::max(reference.max_bound, b);
    squares.add(b * b);
  }
  if (!reference.bound.empty()) {
    reference.rms_bound = std::sqrt(squares.value() / static_cast<double>(reference.bound.size()));
  }
  return reference;
}

}  // namespace moire
