#include "engine/exact.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "core/rounding.h"
#include "core/sum.h"
#include "engine/boundary_integral.h"
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

// The kernel as scenes may know it.
std::vector<PieceWeight> pieces_of(const Kernel& kernel) {
  std::vector<PieceWeight> pieces;
  for (int p = 0; p < kernel.pieces(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    const Kernel::PieceBounds& bounds = kernel.bounds(p);
    pieces.push_back({kernel.knots()[i], kernel.knots()[i + 1], kernel.k_series(p), bounds.k, bounds.k_error_at_x});
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

// The scene's boundary in one window, integrated. Buffers are kept from pixel to pixel.
class PixelIntegrator {
 public:
  PixelIntegrator(const TestImage& scene, const Filter& filter, const WeightAim& aim)
      : scene_(scene),
        kernel_(filter.kernel()),
        aim_(aim),
        pieces_(pieces_of(kernel_)),
        bounds_(weight_bounds(kernel_)),
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
      if (box) return weighed(*box);
    }
    boundary_.clear();
    const std::optional<WeightIntegral> known = scene_.weight_integral(pixel, pieces_, aim_, boundary_);
    if (!known) scene_.boundary(pixel, kernel_.radius(), boundary_);
    const double besides = doubt(boundary_, bounds_, 2.1 * kernel_.k_max() * kernel_.k_error()) + motion_error_;
    Exact e = swept_ ? integrate(*swept_, boundary_, besides) : integrate(integral_, boundary_, besides);
    if (!known) return e;
    e.value += known->value;
    e.bound += known->bound + kUnit * std::fabs(e.value);
    return e;
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
  RadialPixelIntegrator(const TestImage& scene, const Filter& filter)
      : scene_(scene), kernel_(filter.radial_kernel()), bounds_(weight_bounds(kernel_)), integral_(kernel_) {
    if (scene.sweep() != Vec2{}) require_separable(filter, "the exact value of a moving scene");
  }

  Exact operator()(Pixel pixel) {
    boundary_.clear();
    scene_.boundary(pixel, kernel_.radius(), boundary_);
    return integrate(integral_, boundary_, doubt(boundary_, bounds_, kernel_.k_error()));
  }

 private:
  const TestImage& scene_;
  const RadialKernel& kernel_;
  WeightBounds bounds_;
  RadialIntegral integral_;
  Boundary boundary_;
};

// Rows in bands of at least so many active pixels, where their end allows: making an integrator takes as long as two
// or three pixels, and handing out work as much again.
std::vector<int> bands_of(const ActiveRows& rows) {
  constexpr std::int64_t kEnough = 64;
  std::vector<int> begin{0};
  for (int y = 1; y < rows.grid().height; ++y) {
    if (rows.first_active(y) - rows.first_active(begin.back()) >= kEnough) begin.push_back(y);
  }
  begin.push_back(rows.grid().height);
  return begin;
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
  return filter.is_radial() ? RadialPixelIntegrator(scene, filter)(pixel) : PixelIntegrator(scene, filter, aim)(pixel);
}

Reference exact(const TestImage& scene, const Filter& filter, const ActiveRows& rows, const WeightAim& aim) {
  Reference reference;
  reference.value.resize(static_cast<std::size_t>(rows.active_pixels()));
  reference.bound.resize(reference.value.size());
  const std::vector<int> bands = bands_of(rows);
  parallel_for(bands.size() - 1, [&](std::size_t band) {
    auto index = static_cast<std::size_t>(rows.first_active(bands[band]));
    if (rows.first_active(bands[band]) == rows.first_active(bands[band + 1])) return;
    const auto fill = [&](auto integrate) {
      for (int y = bands[band]; y < bands[band + 1]; ++y) {
        for (const Run& run : rows.row(y)) {
          if (run.cover != Cover::partial) continue;
          for (std::int32_t x = run.x0; x < run.x1; ++x, ++index) {
            const Exact e = integrate({x, y});
            reference.value[index] = e.value;
            reference.bound[index] = e.bound;
          }
        }
      }
    };
    if (filter.is_radial()) return fill(RadialPixelIntegrator(scene, filter));
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
