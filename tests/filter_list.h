// Every filter of the catalogue with the parameters that make a difference, so that a new filter is tested before its
// author writes a test.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "filters/filter.h"

namespace moire::test {

// Each filter with its defaults, then with every value of every choice, then some with other numbers. Filters that need
// a file are left out: their own tests have one.
inline std::vector<std::string> filter_texts() {
  std::vector<std::string> texts;
  for (const FilterInfo* info : filters()) {
    const std::string name(info->name);
    if (std::any_of(info->params.begin(), info->params.end(), [](const Param& p) { return p.required; })) continue;
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
  for (const char* text : {"box:width=0.5", "box:width=1.7", "box:width=2", "tent:radius=1.5", "tent:radius=2",
                           "mitchell:b=0.5,c=0.25", "gaussian:sigma=0.1,radius=0.3", "bspline:order=0",
                           "bspline:order=2", "bspline:order=5", "lanczos:a=2", "blackman-harris:width=3"}) {
    texts.emplace_back(text);
  }
  return texts;
}

}  // namespace moire::test
