// Finding what a person meant by a name that is not known.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace moire {

// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours count 1 each.
std::size_t edit_distance(std::string_view a, std::string_view b);

// `kind "name" is not known; did you mean a, b? (all: a, b, c)`; the nearest names first, none when nothing is near.
std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> known);

// Names joined by ", ".
std::string join(std::span<const std::string_view> names);

}  // namespace moire
