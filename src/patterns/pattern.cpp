// The catalogue of patterns, and a pattern as a value.
#include "patterns/pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/names.h"

namespace moire {

#define MOIRE_ITEM(name) extern const PatternInfo name##_pattern;
#include "patterns_plugins.inc"
#undef MOIRE_ITEM

namespace {
constexpr const PatternInfo* kPatterns[] = {
#define MOIRE_ITEM(name) &name##_pattern,
#include "patterns_plugins.inc"
#undef MOIRE_ITEM
};

// The names of the patterns that can do something, for messages.
template <class Able>
std::string names_of(const Able& able) {
  std::vector<std::string_view> names;
  for (const PatternInfo* info : kPatterns) {
    if (able(*info)) names.push_back(info->name);
  }
  return join(names);
}
}  // namespace

std::span<const PatternInfo* const> patterns() { return kPatterns; }

const PatternInfo& find_pattern(std::string_view name, std::string_view place) {
  std::vector<std::string_view> known;
  for (const PatternInfo* info : patterns()) {
    if (info->name == name) return *info;
    known.push_back(info->name);
  }
  throw Error(std::string(place), unknown_name("pattern", name, known));
}

PatternChoice::PatternChoice(const Spec& spec)
    : info_(&find_pattern(spec.name, spec.place)),
      args_(fmt::format("pattern \"{}\"", info_->name), info_->params, spec.given, spec.place),
      text_(spec.text) {}

void PatternChoice::require_count(std::int64_t n) const {
  const auto refuse = [&](const std::string& instead) {
    throw Error(args_.place(),
                fmt::format("pattern \"{}\" cannot have {} samples per pixel; {}", info_->name, n, instead));
  };
  if (n < 1 || n > kMaxSamples) refuse(fmt::format("1 to {} are possible", kMaxSamples));
  const auto [below, above] = info_->counts(args_, static_cast<int>(n));
  if (below != n) refuse(fmt::format("nearest: {}, {}", below, above));
}

void PatternChoice::require_time() const {
  if (has_time()) return;
  throw Error(args_.place(),
              fmt::format("pattern \"{}\" has points in 2 dimensions, without a time; these have one: {}", info_->name,
                          names_of([](const PatternInfo& info) { return info.has_time; })));
}

std::int64_t PatternChoice::area_count(Grid area, std::int64_t n) const {
  if (info_->area_count == nullptr) {
    throw Error(args_.place(),
                fmt::format("pattern \"{}\" cannot fill an image as one set; these can: {}", info_->name,
                            names_of([](const PatternInfo& info) { return info.area_count != nullptr; })));
  }
  const double wanted = static_cast<double>(n) * area.width * area.height;
  const std::int64_t count =
      wanted > 0x1p40 ? std::int64_t{1} << 40 : info_->area_count(args_, area, n * area.width * area.height);
  if (count > kMaxAreaPoints) {
    throw Error(
        args_.place(),
        fmt::format("pattern \"{}\" with {} samples per pixel over {} x {} pixels would be a set of more than {} "
                    "points; give fewer samples or a smaller image",
                    info_->name, n, area.width, area.height, kMaxAreaPoints));
  }
  return count;
}

PatternInfo::Counts square_count(const Args&, int n) {
  n = std::min(n, kMaxSamples);  // itself a square, so the one above exists as well
  const int m = static_cast<int>(std::sqrt(static_cast<double>(n)));  // exact for squares: the root of one is a double
  return m * m == n ? PatternInfo::Counts{n, n} : PatternInfo::Counts{m * m, (m + 1) * (m + 1)};
}

Pattern::Pattern(const PatternChoice& choice, int n, Draw draw)
    : info_(&choice.info()), n_(n), varies_(choice.varies()) {
  choice.require_count(n);
  self_ = info_->make(choice.args(), n, draw);
}

}  // namespace moire
