// Keys that every kind of study has.
#include "study/study_keys.h"

#include <iterator>
#include <limits>

#include "core/error.h"
#include "core/names.h"

namespace moire {

std::uint64_t seed_of(const Node& node) {
  return static_cast<std::uint64_t>(integer_of(node, "seed", 0, std::numeric_limits<std::int64_t>::max()));
}

Images images_of(const Node& node) {
  constexpr std::string_view kNames[] = {"none", "first-trial", "all"};
  constexpr Images kValues[] = {Images::none, Images::first_trial, Images::all};
  const std::string& text = text_of(node, "images");
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    if (text == kNames[i]) return kValues[i];
  }
  throw Error(node.place, unknown_name("images", text, kNames));
}

}  // namespace moire
