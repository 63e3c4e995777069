// Scenes as files describe them: the keys of one scene, with ranges, to test images.
#include "study/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "core/args.h"
#include "core/error.h"
#include "core/names.h"
#include "study/random_lines.h"

namespace moire {
namespace {

constexpr std::string_view kLineMark = ":line=";
constexpr std::size_t kMaxNumbers = std::size_t{1} << 23;  // of all scenes of a table
constexpr std::string_view kEdgeKind = "edge";

// A key of a scene with its value, or with its values when it is a range.
struct Entry {
  std::string key;
  const Node* node = nullptr;
  Value value;                 // when `values` is empty
  std::vector<double> values;  // of a range
};

bool is_range(const Node& node) {
  return node.kind == Node::Kind::table &&
         (node.find("from") != nullptr || node.find("to") != nullptr || node.find("step") != nullptr);
}

// A number, a list of numbers, a list of rows of numbers, or a text.
Value value_of(const Node& node) {
  Value value;
  value.place = node.place;
  if (node.kind == Node::Kind::text) {
    value.text = node.text;
    return value;
  }
  value.is_text = false;
  if (node.kind != Node::Kind::list) {
    value.numbers = {exact_number(node)};
    return value;
  }
  const bool rows = !node.items.empty() && node.items.front().kind == Node::Kind::list;
  value.rank = rows ? 2 : 1;
  for (const Node& item : node.items) {
    if (!rows) {
      value.numbers.push_back(exact_number(item));
      continue;
    }
    if (item.kind != Node::Kind::list) {
      throw Error(item.place, fmt::format("{} stands among lists; give rows of equal length", kind_name(item.kind)));
    }
    if (&item == &node.items.front()) value.columns = item.items.size();
    if (item.items.size() != value.columns || item.items.empty()) {
      throw Error(item.place, fmt::format("the row has {} numbers and the first one {}; give rows of equal length",
                                          item.items.size(), value.columns));
    }
    for (const Node& cell : item.items) value.numbers.push_back(exact_number(cell));
  }
  return value;
}

// The shortest decimal, of at most 15 digits, within `slack` of x, else x itself: 0.1 * 3 reads 0.3.
double round_to_decimal(double x, double slack) {
  if (std::abs(x) <= slack) return 0;
  for (int digits = 1; digits <= 15; ++digits) {
    char text[40];
    const auto written = std::to_chars(text, text + sizeof text, x, std::chars_format::general, digits);
    double decimal = x;
    if (parse_number({text, written.ptr}, decimal) && std::abs(decimal - x) <= slack) return decimal;
  }
  return x;
}

// Appends the entries of a table; sub-tables that are no ranges are flattened once: [camera] focal is "camera.focal".
void collect(const Node& table, const std::string& prefix, std::size_t limit, std::vector<Entry>& out) {
  for (const Node& node : table.items) {
    if (node.key == "lines" && prefix.empty()) continue;  // a key of its own kind, see line_scenes()
    Entry entry;
    entry.key = prefix + node.key;
    entry.node = &node;
    if (is_range(node)) {
      entry.values = range_values(node, limit);
    } else if (node.kind != Node::Kind::table) {
      entry.value = value_of(node);
    } else if (prefix.empty()) {
      collect(node, node.key + ".", limit, out);
      continue;
    } else {
      throw Error(node.place, fmt::format("\"{}\" is a table within a table; give a number", entry.key));
    }
    out.push_back(std::move(entry));
  }
}

void refuse_ranges(const Node& table) {
  for (const Node& node : table.items) {
    if (node.key == "lines") throw Error(node.place, "lines make several scenes; here give through and normal");
    if (is_range(node)) throw Error(node.place, "a range makes several scenes; here give one number");
    if (node.kind == Node::Kind::table) refuse_ranges(node);
  }
}

void refuse_unknown_keys(const std::vector<Entry>& entries, const TestImageInfo& info) {
  std::vector<std::string_view> known = {"kind", "name", "width", "height"};
  for (const Param& p : info.params) known.push_back(p.name);
  if (info.name == kEdgeKind) known.push_back("lines");
  for (const Entry& e : entries) {
    if (std::find(known.begin(), known.end(), e.key) == known.end()) {
      throw Error(e.node->key_place,
                  fmt::format("scene kind \"{}\": {}", info.name, unknown_name("key", e.key, known)));
    }
  }
}

int side_of(const Given& given, std::string_view key, const Node& table) {
  for (const auto& [name, value] : given) {
    if (name != key) continue;
    const double x = !value.is_text && value.rank == 0 ? value.numbers.at(0) : 0;
    if (x != std::floor(x) || !(x >= 1 && x <= kMaxSide)) {
      throw Error(value.place, fmt::format("{} must be a whole number of pixels, 1 to {}", key, kMaxSide));
    }
    return static_cast<int>(x);
  }
  throw Error(table.place, fmt::format("the scene has no {}; give it in pixels, 1 to {}", key, kMaxSide));
}

TestImage make_image(const TestImageInfo& info, const Given& given, const Node& table) {
  const Grid grid{side_of(given, "width", table), side_of(given, "height", table)};
  Given own;
  for (const auto& entry : given) {
    if (entry.first != "width" && entry.first != "height") own.push_back(entry);
  }
  return TestImage(info, own, grid, table.place);
}

struct Lines {
  EdgeLaw law = EdgeLaw::isotropic;
  std::uint32_t count = 0;
  std::uint64_t seed = 1;
};

Lines lines_of(const Node& node, std::size_t limit) {
  constexpr std::string_view kKeys[] = {"law", "count", "seed"};
  if (node.kind != Node::Kind::table) {
    throw Error(node.place, fmt::format("lines is {}; write {{ law = \"isotropic\", count = 256, seed = 1 }}",
                                        kind_name(node.kind)));
  }
  for (const Node& member : node.items) {
    if (std::find(std::begin(kKeys), std::end(kKeys), member.key) == std::end(kKeys)) {
      throw Error(member.key_place, "lines: " + unknown_name("key", member.key, kKeys));
    }
  }
  const auto member = [&](std::string_view key) -> const Node& {
    const Node* found = node.find(key);
    if (found == nullptr) {
      throw Error(node.place,
                  fmt::format("the lines have no \"{}\"; write {{ law = \"isotropic\", count = 256 }}", key));
    }
    return *found;
  };
  const Node& law = member("law");
  const auto known = std::find(std::begin(kEdgeLaws), std::end(kEdgeLaws), text_of(law, "law"));
  if (known == std::end(kEdgeLaws)) throw Error(law.place, unknown_name("law of lines", law.text, kEdgeLaws));
  Lines lines;
  lines.law = static_cast<EdgeLaw>(known - std::begin(kEdgeLaws));
  lines.count = static_cast<std::uint32_t>(integer_of(member("count"), "count", 1, static_cast<std::int64_t>(limit)));
  if (const Node* seed = node.find("seed")) {
    lines.seed = static_cast<std::uint64_t>(integer_of(*seed, "seed", 0, std::numeric_limits<std::int64_t>::max()));
  }
  return lines;
}

// The scenes of a table with `lines`; `entries` are its other keys.
std::vector<NamedScene> line_scenes(const Node& table, const Node& node, const std::vector<Entry>& entries,
                                    const TestImageInfo& info, const std::string& name, std::size_t limit) {
  Given given;
  for (const Entry& e : entries) {
    if (e.key == "through" || e.key == "normal") {
      throw Error(e.node->key_place,
                  fmt::format("\"{}\" stands beside \"lines\", which draws it; give one of them", e.key));
    }
    if (!e.values.empty()) {
      throw Error(e.node->place,
                  "a range stands beside \"lines\"; give one number, or a table [[scene]] for each value");
    }
    given.emplace_back(e.key, e.value);
  }
  const Lines lines = lines_of(node, limit);
  const Grid grid{side_of(given, "width", table), side_of(given, "height", table)};
  std::vector<NamedScene> scenes;
  for (std::uint32_t i = 0; i < lines.count; ++i) {
    const RandomLine line = random_line(lines.law, lines.seed, i, grid);
    Given drawn = given;
    for (const auto& [key, vector] : {std::pair("through", line.through), std::pair("normal", line.normal)}) {
      Value value;
      value.is_text = false;
      value.rank = 1;
      value.numbers = {vector.x, vector.y};
      value.place = node.place;
      drawn.emplace_back(key, std::move(value));
    }
    scenes.push_back({fmt::format("{}{}{}", name, kLineMark, i), make_image(info, drawn, table)});
  }
  return scenes;
}

std::size_t count_of(const Entry& e) { return std::max<std::size_t>(e.values.size(), 1); }

}  // namespace

std::string_view scene_family(std::string_view scene_name) {
  const std::size_t mark = scene_name.rfind(kLineMark);
  if (mark == std::string_view::npos) return scene_name;
  const std::string_view number = scene_name.substr(mark + kLineMark.size());
  const bool is_line = !number.empty() && number.find_first_not_of("0123456789") == std::string_view::npos;
  return is_line ? scene_name.substr(0, mark) : scene_name;
}

std::int64_t line_number(std::string_view scene_name) {
  const std::size_t family = scene_family(scene_name).size();
  std::int64_t number = 0;
  if (family < scene_name.size()) {
    const char* const end = scene_name.data() + scene_name.size();
    std::from_chars(scene_name.data() + family + kLineMark.size(), end, number);
  }
  return number;
}

std::vector<double> range_values(const Node& range, std::size_t limit) {
  for (const Node& member : range.items) {
    if (member.key != "from" && member.key != "to" && member.key != "step") {
      constexpr std::string_view kKeys[] = {"from", "to", "step"};
      throw Error(member.key_place, "a range: " + unknown_name("key", member.key, kKeys));
    }
  }
  const auto number = [&](std::string_view key) {
    const Node* node = range.find(key);
    if (node == nullptr) {
      throw Error(range.place, fmt::format("the range has no \"{}\"; write {{ from = A, to = B, step = C }}", key));
    }
    return exact_number(*node);
  };
  const double from = number("from"), to = number("to"), step = number("step");
  if (step == 0 || (to - from) * step < 0) {
    throw Error(range.place,
                "the range's step does not lead from \"from\" to \"to\"; give a step of the other sign, "
                "not zero");
  }
  // Each of the three numbers is a decimal rounded to a double, so that the quotient is uncertain by this much.
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const double steps = (to - from) / step;
  const double slack = kEpsilon * ((std::abs(from) + std::abs(to)) / std::abs(step) + 2 * steps);
  if (!(steps + slack < static_cast<double>(limit))) {
    throw Error(range.place, fmt::format("the range makes more than {} scenes; give a larger step", limit));
  }
  std::vector<double> values = {from};
  const auto last = static_cast<std::int64_t>(std::floor(steps + slack));
  for (std::int64_t k = 1; k <= last; ++k) {
    const double offset = static_cast<double>(k) * step;
    // Half an epsilon each for the two decimals read, the product and the sum.
    values.push_back(round_to_decimal(from + offset, kEpsilon * (std::abs(from) + 1.5 * std::abs(offset))));
  }
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (values[k] == values[k - 1]) {
      throw Error(range.place, "the range's step is below the spacing of doubles there; give a larger step");
    }
  }
  return values;
}

std::vector<NamedScene> scenes_of(const Node& table, const std::string& name, std::size_t limit) {
  const Node* kind = table.find("kind");
  if (kind == nullptr) {
    std::vector<std::string_view> kinds;
    for (const TestImageInfo* info : testimages()) kinds.push_back(info->name);
    throw Error(table.place, fmt::format("the scene has no kind; give kind = \"NAME\", one of {}", join(kinds)));
  }
  const TestImageInfo& info = find_testimage(text_of(*kind, "kind"), kind->place);
  const Node* lines = table.find("lines");
  if (lines != nullptr && info.name != kEdgeKind) {
    throw Error(lines->key_place, fmt::format("random lines are edges; give kind = \"{}\"", kEdgeKind));
  }
  std::vector<Entry> entries;
  collect(table, "", limit, entries);
  refuse_unknown_keys(entries, info);
  std::erase_if(entries, [](const Entry& e) { return e.key == "kind" || e.key == "name"; });
  if (lines != nullptr) return line_scenes(table, *lines, entries, info, name, limit);

  std::size_t total = 1;
  for (const Entry& e : entries) {
    if (count_of(e) > limit / total) {
      throw Error(table.place, fmt::format("the scene's ranges make more than {} scenes; give larger steps", limit));
    }
    total *= count_of(e);
  }
  // Each scene holds the numbers of all keys.
  std::size_t numbers = 0;
  for (const Entry& e : entries) numbers += std::max<std::size_t>(e.value.numbers.size(), 1);
  if (numbers > kMaxNumbers / total) {
    throw Error(table.place, fmt::format("the ranges make {} scenes of {} numbers each; at most {} together, so give "
                                         "larger steps or shorter lists",
                                         total, numbers, kMaxNumbers));
  }
  std::vector<NamedScene> scenes;
  for (std::size_t index = 0; index < total; ++index) {
    Given given;
    std::string full_name = name;
    char separator = ':';
    std::size_t above = total;  // scenes that share the values of the ranges before this one
    for (const Entry& e : entries) {
      Value value = e.value;
      if (!e.values.empty()) {
        above /= e.values.size();
        value.numbers = {e.values[index / above % e.values.size()]};
        value.is_text = false;
        value.place = e.node->place;
        full_name += fmt::format("{}{}={}", separator, e.key, shortest(value.numbers[0]));
        separator = ',';
      }
      given.emplace_back(e.key, std::move(value));
    }
    scenes.push_back({full_name, make_image(info, given, table)});
  }
  return scenes;
}

NamedScene parse_scene(std::string_view text, const std::string& file, const std::string& name) {
  const Node table = parse_toml(text, file);
  refuse_ranges(table);
  const Node* own = table.find("name");
  return scenes_of(table, own != nullptr ? name_of(*own, "name") : name, 1).front();
}

}  // namespace moire
