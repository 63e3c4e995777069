// Every scene kind, filter and pattern of the catalogue, small enough to be rendered in all combinations.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "filter_list.h"
#include "patterns/pattern.h"
#include "scenes.h"

namespace moire::test {

// One or more scenes of each kind, the hard ones among them.
inline std::vector<std::pair<std::string, TestImage>> scene_catalogue(Grid grid = {32, 28}) {
  using namespace scenes;
  std::vector<std::pair<std::string, TestImage>> all;
  all.emplace_back("edge", edge({15.3, 14.7}, 97.3, grid));
  // Points of low-discrepancy patterns lie exactly on this line.
  all.emplace_back("edge on x = 16", edge({16, 0}, 180, grid));
  all.emplace_back("edge through lattice points", edge({8, 8}, {1, -2}, grid));
  all.emplace_back("disk", disk({15.7, 14.2}, 9.25, grid));
  all.emplace_back("disk through lattice points", disk({16, 14}, 5, grid));
  all.emplace_back("small disk", disk({15.9, 14.1}, 0.2, grid));
  // One disk covers most of the image; three touch it exactly, two each other; tiny ones stand alone and on a corner.
  all.emplace_back("disks", disks({16,  14,  13,  25,   26, 2, 4,    5,    2,     16,   27.5, 0.5, 17, 27.5,
                                   0.5, 1.5, 1.5, 1e-3, 30, 2, 0.01, 2.25, 25.75, 1e-6, 29.3, 5.1, 0.2},
                                  grid));
  // One disk to eight pixels: windows with none, with several, with a part of one.
  all.emplace_back("noise field", noise_field(3000, 0.05, 0.4, 1, grid));
  all.emplace_back("board", board({.focal = 28, .principal = {16, 11}, .height = 1.5, .pitch = 25, .yaw = 7, .roll = 3},
                                  {-3, 4, 1, 9}, grid));
  all.emplace_back("board on the pixel grid", board({0.25, 0, -1, 0, 0.25, -1, 0, 0, 1}, {0, 4, 0, 3}, grid));
  all.emplace_back("board to the horizon",
                   plane({.focal = 28, .principal = {16, 11}, .height = 1.5, .pitch = 10, .yaw = 7, .roll = 3}, grid));
  return all;
}

inline std::vector<Filter> filter_catalogue() {
  std::vector<Filter> all;
  for (const std::string& text : separable_texts()) all.emplace_back(parse_spec(text, "test"));
  return all;
}

inline std::vector<PatternChoice> pattern_catalogue() {
  std::vector<PatternChoice> all;
  for (const PatternInfo* p : patterns()) all.emplace_back(parse_spec(p->name, "test"));
  for (const char* text : {"hammersley:instance=shift", "zaremba:instance=scramble", "dart-throwing:bank=0,k=100"}) {
    all.emplace_back(parse_spec(text, "test"));
  }
  return all;
}

}  // namespace moire::test
