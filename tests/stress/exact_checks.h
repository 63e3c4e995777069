// What every family of exact values must do, whatever its scenes.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>

#include "engine/exact.h"
#include "filters/filter.h"
#include "stress/exact_case.h"
#include "stress/family.h"
#include "stress/hunt.h"
#include "study/scene_file.h"

namespace moire::stress {

// A description taken apart again: the scene file, the filter and the pixel.
struct Rerun {
  std::string scene, filter;
  Pixel pixel;

  explicit Rerun(const std::string& text) {
    const std::size_t pixel_at = text.find("; pixel "), filter_at = text.find("; --filter ");
    const std::size_t end = text.find("; moire exact ");
    REQUIRE(end != std::string::npos);
    REQUIRE(pixel_at < filter_at);
    REQUIRE(filter_at < end);
    scene = text.substr(0, pixel_at);
    for (std::size_t at = 0; (at = scene.find("; ", at)) != std::string::npos;) scene.replace(at, 2, "\n");
    const std::string coordinates = text.substr(pixel_at + 8, filter_at - pixel_at - 8);
    const std::size_t comma = coordinates.find(',');
    pixel = {std::stoll(coordinates.substr(0, comma)), std::stoll(coordinates.substr(comma + 1))};
    filter = text.substr(filter_at + 11, end - filter_at - 11);
  }

  Exact value() const {
    return exact_pixel(parse_scene(scene, "described.toml", "described").image, Filter(parse_spec(filter, "described")),
                       pixel);
  }
};

inline void check_passes(const Family& family, std::uint64_t seed, std::uint64_t cases) {
  int open = 0, blind = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Outcome outcome = run_case(family, {seed, i});
    INFO(family.describe({seed, i}) << ": " << outcome.computed << " +- " << outcome.bound << ", oracle "
                                    << outcome.wanted << " +- " << outcome.oracle_error << ' ' << outcome.fault);
    CHECK(passes(outcome));
    CHECK(outcome.severity > 0);
    CHECK(std::isfinite(outcome.severity));
    open += outcome.wanted != 0 && outcome.wanted != 1;
    blind += outcome.bound > 0 && outcome.oracle_error > 1000 * outcome.bound;
  }
  CHECK(open > static_cast<int>(cases) / 2);
  // Where a circle only just touches a wide kernel's window next to nothing is both the value and its bound, and the
  // oracle's sections are right to an ulp of the window only.
  CHECK(blind <= static_cast<int>(cases) / 200);
}

// The same key is the same case, another one another; and what `describe` says gives the same bits again.
inline void check_can_be_rerun(const Family& family, std::uint64_t seed, std::uint64_t cases) {
  std::set<std::string> texts;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const std::string text = family.describe({seed, i});
    INFO(text);
    CHECK(family.describe({seed, i}) == text);
    texts.insert(text);
    const Outcome outcome = run_case(family, {seed, i});
    const Exact again = Rerun(text).value();
    CHECK(again.value == outcome.computed);
    CHECK(again.bound == outcome.bound);
  }
  CHECK(texts.size() == cases);
}

// Every filter of the catalogue, the plain box most often.
inline void check_meets_all_filters(const Family& family, std::uint64_t seed, std::uint64_t cases) {
  std::set<std::string> met;
  std::uint64_t boxes = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const std::string filter = Rerun(family.describe({seed, i})).filter;
    boxes += filter == "box";
    met.insert(filter);
  }
  for (const std::string& text : filter_variants()) {
    CAPTURE(text);
    CHECK(met.count(text) == 1);
  }
  CHECK(boxes > cases / 3);
}

}  // namespace moire::stress
