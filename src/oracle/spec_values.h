// The values of a filter's description, as the oracle reads them.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/args.h"

namespace moire::oracle {

// What is given for the key, or the fallback. The first lives as long as the description.
inline std::string_view text_of(const Spec& spec, std::string_view key, std::string_view fallback) {
  for (const auto& [name, value] : spec.given)
    if (name == key) return value.text;
  return fallback;
}

// The parameter is the double that the program reads, not the decimal.
inline long double number_of(const Spec& spec, std::string_view key, long double fallback) {
  const std::string_view text = text_of(spec, key, "");
  if (text.empty()) return fallback;
  double number = 0;
  if (!parse_number(text, number)) throw std::invalid_argument("number " + std::string(text));
  return static_cast<long double>(number);
}

}  // namespace moire::oracle
