// Every filter of the catalogue with the parameters that make a difference, so that a new filter is tested before its
// author writes a test.
#pragma once

#include <string>
#include <vector>

#include "filters/filter.h"

namespace moire::test {

// filter_variants(), then some with other numbers. Filters that need a file are left out: their own tests have one.
inline std::vector<std::string> filter_texts() {
  std::vector<std::string> texts = filter_variants();
  for (const char* text : {"box:width=0.5", "box:width=1.7", "box:width=2", "tent:radius=1.5", "tent:radius=2",
                           "mitchell:b=0.5,c=0.25", "gaussian:sigma=0.1,radius=0.3", "bspline:order=0",
                           "bspline:order=2", "bspline:order=5", "lanczos:a=2", "blackman-harris:width=3"}) {
    texts.emplace_back(text);
  }
  return texts;
}

}  // namespace moire::test
