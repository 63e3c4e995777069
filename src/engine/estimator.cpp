// The list of estimators.
#include "engine/estimator.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/args.h"
#include "core/error.h"
#include "core/names.h"

namespace moire {
namespace {

// By Estimator.
constexpr auto kTexts = std::to_array<std::string_view>(
    {"ratio", "unnormalised", "control-variate", "importance", "importance:form=ratio"});
constexpr auto kNames = std::to_array<std::string_view>({"ratio", "unnormalised", "control-variate", "importance"});

constexpr Param kImportanceParams[] = {choice(
    "form", "signed", "signed|ratio", "what signs of negative lobes are divided by: their number, or their sum")};

}  // namespace

std::span<const std::string_view> estimator_names() { return kNames; }
std::span<const std::string_view> estimator_texts() { return kTexts; }
std::string_view name_of(Estimator estimator) { return kTexts[static_cast<std::size_t>(estimator)]; }

Estimator find_estimator(std::string_view text, std::string_view place) {
  const Spec spec = parse_spec(text, place);
  const auto name = std::find(kNames.begin(), kNames.end(), spec.name);
  if (name == kNames.end()) throw Error(spec.place, unknown_name("estimator", spec.name, kNames));
  const auto estimator = static_cast<Estimator>(name - kNames.begin());
  const bool has_form = estimator == Estimator::importance;
  const Args args("estimator \"" + spec.name + "\"",
                  has_form ? std::span<const Param>(kImportanceParams) : std::span<const Param>(), spec.given,
                  spec.place);
  return has_form && args.text("form") == "ratio" ? Estimator::importance_ratio : estimator;
}

void require_layout(Estimator estimator, Layout layout, std::string_view place) {
  if (!is_importance(estimator) || layout == Layout::pixel) return;
  throw Error(std::string(place),
              "estimator \"" + std::string(name_of(estimator)) +
                  "\" draws samples for each pixel, which one set over the image (layout \"image\") does "
                  "not have; use layout \"pixel\", or another estimator");
}

}  // namespace moire
