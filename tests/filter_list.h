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
  for (const char* text : {"box:width=0.5",
                           "box:width=1.7",
                           "box:width=2",
                           "tent:radius=1.5",
                           "mitchell:b=0.5,c=0.25",
                           "mitchell:radius=3",
                           "gaussian:sigma=0.1,radius=0.3",
                           "bspline:order=0",
                           "bspline:order=2",
                           "bspline:order=5",
                           "keys:a=-0.9",
                           "lagrange:order=2",
                           "lagrange:order=7",
                           "cubic-spline:lobes=3",
                           "cubic-spline:lobes=4",
                           "lanczos:a=2",
                           "lanczos:a=4",
                           "lanczos:a=2,blur=0.8",
                           "blackman-harris:width=3",
                           "pbrt-sinc:radius=2.5,tau=2",
                           "windowed-sinc:window=kaiser,radius=2.7,beta=12",
                           "windowed-sinc:window=welch,preset=imagemagick",
                           "sinc:radius=5.3"}) {
    texts.emplace_back(text);
  }
  return texts;
}

}  // namespace moire::test
