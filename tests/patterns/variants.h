// Every pattern of the catalogue with the parameters that make a difference, so that a new pattern is tested before its
// author writes a test; and its points as plain vectors.
#pragma once

#include <string>
#include <vector>

#include "core/args.h"
#include "patterns/pattern.h"

namespace moire::test {

inline PatternChoice chosen(const std::string& text) { return PatternChoice(parse_spec(text, "test")); }

// Each pattern with its defaults, then with every value of every choice, the ends of every number, the low end of every
// integer. Patterns that need a file are left out: their own tests have one.
inline std::vector<std::string> variants() {
  std::vector<std::string> texts;
  for (const PatternInfo* info : patterns()) {
    const std::string name(info->name);
    bool needs_more = false;
    for (const Param& p : info->params) needs_more = needs_more || p.required;
    if (needs_more) continue;
    texts.push_back(name);
    for (const Param& p : info->params) {
      const std::string with = name + ":" + std::string(p.name) + "=";
      if (p.kind == Param::Kind::number || p.kind == Param::Kind::integer) texts.push_back(with + shortest(p.min));
      if (p.kind == Param::Kind::number) texts.push_back(with + shortest(p.max));
      if (p.kind == Param::Kind::choice)
        for (std::size_t from = 0; from <= p.choices.size();) {
          const std::size_t to = std::min(p.choices.find('|', from), p.choices.size());
          texts.push_back(with + std::string(p.choices.substr(from, to - from)));
          from = to + 1;
        }
    }
  }
  return texts;
}

struct PointSet {
  std::vector<double> x, y;
  std::vector<double> t = {};  // empty: no times
  friend bool operator==(const PointSet&, const PointSet&) = default;
};

// Room for `count` points, filled with what no pattern makes.
inline PointSet room_for(std::size_t count, bool with_time) {
  return {std::vector<double>(count, -1.0), std::vector<double>(count, -1.0),
          std::vector<double>(with_time ? count : 0, -1.0)};
}

inline Points points_of(PointSet& set) { return {set.x, set.y, set.t}; }

// The points of a run of pixels, n per pixel, with their times where they have any.
inline PointSet points_in(const Pattern& pattern, const std::vector<Pixel>& run) {
  PointSet set = room_for(run.size() * static_cast<std::size_t>(pattern.n()), pattern.has_time());
  pattern.fill(run, points_of(set));
  return set;
}

// The one set of a draw.
inline PointSet set_of(const std::string& text, int n, Draw draw = {}) {
  const Pattern pattern(chosen(text), n, draw);
  PointSet set = room_for(static_cast<std::size_t>(n), pattern.has_time());
  pattern.fill_set(points_of(set));
  return set;
}

// The count nearest to n, from above, that the pattern can have.
inline int usable(const PatternChoice& choice, int n) { return choice.info().counts(choice.args(), n).above; }

}  // namespace moire::test
