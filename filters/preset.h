// Presets: what a system means by a filter's name, as one word in place of the parameters that say it.
#pragma once

#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>

#include "core/args.h"
#include "core/error.h"

namespace moire {

// The row of `table` (rows have a `name`) that the parameter "preset" names, null for "none". Throws Error when one of
// the parameters that a preset sets is given beside it.
template <class Row, std::size_t n>
const Row* find_preset(const Args& args, std::string_view filter, const Row (&table)[n],
                       std::initializer_list<std::string_view> sets) {
  const std::string_view name = args.text("preset");
  if (name == "none") return nullptr;
  const auto given = std::find_if(sets.begin(), sets.end(), [&](std::string_view p) { return args.given(p); });
  if (given != sets.end()) {
    std::string list;
    for (const std::string_view p : sets) {
      if (!list.empty()) list += p == *(sets.end() - 1) ? " and " : ", ";
      list += p;
    }
    throw Error(args.place(), "filter \"" + std::string(filter) + "\": a preset sets " + list +
                                  "; give the preset or \"" + std::string(*given) + "\", not both");
  }
  const auto row = std::find_if(std::begin(table), std::end(table), [&](const Row& r) { return r.name == name; });
  assert(row != std::end(table));  // the table and the choices name the same
  return row;
}

}  // namespace moire
