// Every filter of the catalogue with the parameters that make a difference, so that a new filter is tested before its
// author writes a test.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "filters/filter.h"

namespace moire::test {

// The separable ones of filter_variants(), then some with other numbers. Filters that need a file are left out: their
// own tests have one.
inline std::vector<std::string> separable_texts() {
  std::vector<std::string> texts = filter_variants(Symmetry::separable);
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

// The radial ones, likewise.
inline std::vector<std::string> radial_texts() {
  std::vector<std::string> texts = filter_variants(Symmetry::radial);
  for (const char* text :
       {"disk:radius=1.25", "cone:radius=2", "radial-gaussian:sigma=0.1,radius=0.3",
        "radial-gaussian:sigma=0.7,radius=3,cut=cut", "radial-bc:b=1,c=0", "radial-bc:b=0,c=0.5,radius=3",
        "radial-bc:b=1.5,c=-0.25", "radial-lanczos:a=1", "radial-lanczos:a=2", "radial-lanczos:a=5",
        "radial-blackman-harris:width=5", "jinc:lobes=1", "jinc:lobes=4,blur=0.9"}) {
    texts.emplace_back(text);
  }
  return texts;
}

inline std::vector<std::string> filter_texts() {
  std::vector<std::string> texts = separable_texts();
  for (std::string& text : radial_texts()) texts.push_back(std::move(text));
  return texts;
}

}  // namespace moire::test
