// Reconstruction filters: how we weigh. The catalogue, and a filter as a value.
//
// A filter is separable, weight(x, y) = k(x) k(y), or radial, weight(x, y) = k(r) with r = sqrt(x^2 + y^2); x and y in
// pixels from the pixel's centre, the integral of the weight over the plane 1. A plug-in gives the kernel's shape piece
// by piece between its knots; kernel.h and radial_kernel.h turn it into piecewise Chebyshev series for k and what its
// integrals need, with a proven bound on the fit.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/args.h"
#include "core/double_double.h"
#include "filters/kernel.h"
#include "filters/radial_kernel.h"

namespace moire {

// What the plug-in type of a separable filter must offer. All in pixels; the scale of the shape does not matter.
template <class F>
concept FilterType = std::constructible_from<F, const Args&> && requires(const F& f, int piece, Dd x, double rho) {
  { f.knots() } -> std::same_as<std::vector<double>>;  // increasing; the first is -radius, the last +radius
  { f.degree() } -> std::same_as<int>;                 // of the polynomial between knots; -1: not polynomial
  // The kernel's closed form between knots[piece] and knots[piece + 1], both ends included, in double-double: right to
  // 2^-80 of the largest value, so that only truncation and the rounding of coefficients are left to bound.
  { f.shape(piece, x) } -> std::same_as<Dd>;
  // Bound on |shape(piece, z)| over the Bernstein ellipse of parameter rho > 1 around the piece (foci at its knots).
  // Only asked when degree() is -1.
  { f.ellipse_bound(piece, rho) } -> std::same_as<double>;
};

// The same for a radial filter, in r.
template <class F>
concept RadialFilterType = std::constructible_from<F, const Args&> &&
    requires(const F& f, int piece, Dd r, double rho) {
  // Increasing; the first is 0, the last the radius; each after the second at most twice the one before.
  { f.knots() } -> std::same_as<std::vector<double>>;
  { f.degree() } -> std::same_as<int>;  // degree, shape and ellipse_bound as of a FilterType
  { f.shape(piece, r) } -> std::same_as<Dd>;
  { f.ellipse_bound(piece, rho) } -> std::same_as<double>;
};

enum class Symmetry : std::uint8_t { separable, radial };

// One constant record per filter: one of the two functions is null.
struct FilterInfo {
  std::string_view name, title, cite;
  std::span<const Param> params;
  Kernel (*make)(const Args&);
  RadialKernel (*make_radial)(const Args&);

  constexpr Symmetry symmetry() const { return make == nullptr ? Symmetry::radial : Symmetry::separable; }
};

// Every filter of the program, in the order of filters/CMakeLists.txt.
std::span<const FilterInfo* const> filters();

// Every filter as it is without parameters, then with each other value of each of its choices (presets, windows): what
// a list of all filters means. Filters that need a file are left out.
std::vector<std::string> filter_variants();
std::vector<std::string> filter_variants(Symmetry symmetry);  // those of one kind

// Throws Error naming the nearest filters.
const FilterInfo& find_filter(std::string_view name, std::string_view place);

// A filter with checked parameters: a value, cheap to copy, immutable, shared freely between threads.
class Filter {
 public:
  // Throws Error, also for a kernel whose integral is not positive or below 1/100 of that of its absolute value.
  explicit Filter(const Spec& spec);
  const std::string& text() const { return text_; }
  const FilterInfo& info() const { return *info_; }
  const Args& args() const { return args_; }
  bool is_radial() const noexcept { return radial_ != nullptr; }
  // Precondition: not is_radial(). Code that takes any filter asks first, or throws what require_separable() says.
  const Kernel& kernel() const noexcept;
  // Precondition: is_radial().
  const RadialKernel& radial_kernel() const noexcept;
  // Whether every weight is exactly 1 on the pixel and 0 beside it: Kernel::is_unit_box().
  bool is_unit_box() const noexcept { return !is_radial() && kernel_->is_unit_box(); }
  // Half the side of the window, pixels: of a radial filter the radius of its disk.
  double radius() const noexcept { return is_radial() ? radial_->radius() : kernel_->radius(); }
  // Pixels beyond the image whose samples its windows touch: ceil(R - 1/2) on each side.
  int apron() const noexcept;

 private:
  const FilterInfo* info_;
  Args args_;
  std::string text_;
  std::shared_ptr<const Kernel> kernel_;  // one of the two is null
  std::shared_ptr<const RadialKernel> radial_;
};

// Throws Error for a radial filter: `what`, as in "the noise of theory", is for separable ones only.
void require_separable(const Filter& filter, std::string_view what);

// Fields that an author writes; describe() adds the table of functions.
struct FilterText {
  std::string_view name, title, cite;
  std::span<const Param> params;
};

template <class F>
KernelShape shape_of(const F& f) {
  KernelShape s;
  s.knots = f.knots();
  s.degree = f.degree();
  s.shape = [&f](int piece, Dd x) { return f.shape(piece, x); };
  s.ellipse_bound = [&f](int piece, double rho) { return f.ellipse_bound(piece, rho); };
  return s;
}

template <FilterType F>
constexpr FilterInfo describe(const FilterText& t) {
  return {t.name,
          t.title,
          t.cite,
          t.params,
          [](const Args& a) {
            const F f(a);
            return Kernel(shape_of(f));
          },
          nullptr};
}

template <RadialFilterType F>
constexpr FilterInfo describe_radial(const FilterText& t) {
  return {t.name, t.title, t.cite, t.params, nullptr, [](const Args& a) {
            const F f(a);
            return RadialKernel(shape_of(f));
          }};
}

}  // namespace moire
