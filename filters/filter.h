// Reconstruction filters: how we weigh. The catalogue, and a filter as a value.
//
// Every filter here is separable: weight(x, y) = k(x) k(y), x and y in pixels from the pixel's centre, k normalised to
// integral 1. A plug-in gives the kernel's shape piece by piece between its knots; kernel.h turns it into piecewise
// Chebyshev series for k and its antiderivative K, with a proven bound on the fit.
#pragma once

#include <concepts>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/args.h"
#include "core/double_double.h"
#include "filters/kernel.h"

namespace moire {

// What a plug-in type must offer. All in pixels; the scale of the shape does not matter.
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

// One constant record per filter.
struct FilterInfo {
  std::string_view name, title, cite;
  std::span<const Param> params;
  Kernel (*make)(const Args&);
};

// Every filter of the program, in the order of filters/CMakeLists.txt.
std::span<const FilterInfo* const> filters();

// Every filter as it is without parameters, then with each other value of each of its choices (presets, windows): what
// a list of all filters means. Filters that need a file are left out.
std::vector<std::string> filter_variants();

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
  const Kernel& kernel() const noexcept { return *kernel_; }
  double radius() const noexcept { return kernel_->radius(); }
  // Pixels beyond the image whose samples its windows touch: ceil(R - 1/2) on each side.
  int apron() const noexcept;

 private:
  const FilterInfo* info_;
  Args args_;
  std::string text_;
  std::shared_ptr<const Kernel> kernel_;
};

// Fields that an author writes; describe() adds the table of functions.
struct FilterText {
  std::string_view name, title, cite;
  std::span<const Param> params;
};

template <FilterType F>
constexpr FilterInfo describe(const FilterText& t) {
  return {t.name, t.title, t.cite, t.params, [](const Args& a) {
            const F f(a);
            KernelShape s;
            s.knots = f.knots();
            s.degree = f.degree();
            s.shape = [&f](int piece, Dd x) { return f.shape(piece, x); };
            s.ellipse_bound = [&f](int piece, double rho) { return f.ellipse_bound(piece, rho); };
            return Kernel(s);
          }};
}

}  // namespace moire
