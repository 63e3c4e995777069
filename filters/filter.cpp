// The catalogue of filters, built from the list in CMakeLists.txt.
#include "filters/filter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "core/names.h"

namespace moire {

#define MOIRE_ITEM(name) extern const FilterInfo name##_filter;
#include "filters_plugins.inc"
#undef MOIRE_ITEM

namespace {
#define MOIRE_ITEM(name) &name##_filter,
constexpr auto kFilters = std::to_array<const FilterInfo*>({
#include "filters_plugins.inc"
});
#undef MOIRE_ITEM

std::string owner(std::string_view name) { return "filter \"" + std::string(name) + "\""; }

// Pixels are divided by the integral: it must not be what is left of lobes that cancel.
constexpr double kLeastShare = 0.01;

// The integral of |k| of a normalised kernel, by 16 midpoints a piece: right to a few percent.
constexpr int kPoints = 16;
double absolute_integral(const Kernel& kernel) {
  double sum = 0;
  for (int p = 0; p < kernel.pieces(); ++p) {
    const double left = kernel.knots()[static_cast<std::size_t>(p)], step = 2 * kernel.half_length(p) / kPoints;
    for (int i = 0; i < kPoints; ++i) sum += std::fabs(kernel.k_piece(p, left + (i + 0.5) * step)) * step;
  }
  return sum;
}

// Over the plane.
double absolute_integral(const RadialKernel& kernel) {
  double sum = 0;
  for (int p = 0; p < kernel.pieces(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    const double left = kernel.knots()[i], step = (kernel.knots()[i + 1] - left) / kPoints;
    for (int j = 0; j < kPoints; ++j) {
      const double r = left + (j + 0.5) * step;
      sum += 2 * std::numbers::pi * r * std::fabs(kernel.k_piece(p, r)) * step;
    }
  }
  return sum;
}

}  // namespace

std::span<const FilterInfo* const> filters() { return kFilters; }

std::vector<std::string> filter_variants() {
  std::vector<std::string> texts = filter_variants(Symmetry::separable);
  for (std::string& text : filter_variants(Symmetry::radial)) texts.push_back(std::move(text));
  return texts;
}

std::vector<std::string> filter_variants(Symmetry symmetry) {
  std::vector<std::string> texts;
  for (const FilterInfo* info : filters()) {
    if (info->symmetry() != symmetry) continue;
    if (std::any_of(info->params.begin(), info->params.end(), [](const Param& p) { return p.required; })) continue;
    const std::string name(info->name);
    texts.push_back(name);
    for (const Param& p : info->params) {
      if (p.kind != Param::Kind::choice) continue;
      for (std::size_t from = 0; from <= p.choices.size();) {
        const std::size_t to = std::min(p.choices.find('|', from), p.choices.size());
        const std::string_view value = p.choices.substr(from, to - from);
        if (value != p.text) texts.push_back(name + ":" + std::string(p.name) + "=" + std::string(value));
        from = to + 1;
      }
    }
  }
  return texts;
}

const FilterInfo& find_filter(std::string_view name, std::string_view place) {
  std::vector<std::string_view> known;
  for (const FilterInfo* f : kFilters) {
    if (f->name == name) return *f;
    known.push_back(f->name);
  }
  throw Error(std::string(place), unknown_name("filter", name, known));
}

Filter::Filter(const Spec& spec)
    : info_(&find_filter(spec.name, spec.place)),
      args_(owner(spec.name), info_->params, spec.given, spec.place),
      text_(spec.text) {
  if (info_->symmetry() == Symmetry::radial) {
    radial_ = std::make_shared<const RadialKernel>(info_->make_radial(args_));
  } else {
    kernel_ = std::make_shared<const Kernel>(info_->make(args_));
  }
  const double integral = is_radial() ? radial_->integral() : kernel_->integral();
  const double absolute = is_radial() ? absolute_integral(*radial_) : absolute_integral(*kernel_);
  // Written so that what is not a number is refused too.
  if (!(integral > 0 && absolute * kLeastShare <= 1)) {
    throw Error(spec.place, owner(spec.text) + ": the kernel's integral is " + shortest(integral) +
                                "; pixels are divided by it, so it must be positive and at least " +
                                shortest(kLeastShare) + " of the integral of the kernel's absolute value");
  }
}

const Kernel& Filter::kernel() const noexcept {
  assert(!is_radial());
  return *kernel_;
}

const RadialKernel& Filter::radial_kernel() const noexcept {
  assert(is_radial());
  return *radial_;
}

void require_separable(const Filter& filter, std::string_view what) {
  if (!filter.is_radial()) return;
  throw Error(owner(filter.text()), "a radial filter; " + std::string(what) + " is for separable ones only");
}

int Filter::apron() const noexcept { return static_cast<int>(std::ceil(radius() - 0.5)); }

}  // namespace moire
