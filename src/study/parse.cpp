// Study files: from TOML to a checked Study.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/args.h"
#include "core/error.h"
#include "core/names.h"
#include "study/document.h"
#include "study/scene_file.h"
#include "study/study.h"
#include "study/text_file.h"

namespace moire {
namespace {

constexpr std::array<std::string_view, 11> kStudyKeys = {
    "name", "seed", "trials", "layout", "spp", "patterns", "filters", "estimators", "measures", "images", "spectrum"};

// The members of a list that must not be empty.
const std::vector<Node>& list_of(const Node& node, std::string_view what, std::string_view example) {
  if (node.kind != Node::Kind::list || node.items.empty()) {
    throw Error(node.place,
                fmt::format("{} is {}; give a list such as {}", what,
                            node.kind == Node::Kind::list ? "an empty list" : kind_name(node.kind), example));
  }
  return node.items;
}

void refuse_twice(const Node& node, std::string_view what, bool inserted) {
  if (!inserted) throw Error(node.place, fmt::format("{} is listed twice; name each one once", what));
}

std::vector<int> parse_spp(const Node& node) {
  std::vector<int> counts;
  for (const Node& item : list_of(node, "spp", "[1, 4, 16]")) {
    const int n = static_cast<int>(integer_of(item, "a number of samples per pixel", 1, kMaxSamples));
    refuse_twice(item, std::to_string(n), std::find(counts.begin(), counts.end(), n) == counts.end());
    counts.push_back(n);
  }
  return counts;
}

// A list of specs: `make` turns each into a choice; the texts must differ.
template <class T, class F>
std::vector<T> parse_specs(const Node& node, std::string_view what, std::string_view example, F&& make) {
  std::vector<T> choices;
  std::unordered_set<std::string> seen;
  for (const Node& item : list_of(node, what, example)) {
    const std::string& text = text_of(item, fmt::format("an entry of {}", what));
    refuse_twice(item, fmt::format("\"{}\"", text), seen.insert(text).second);
    choices.push_back(make(text, item.place));
  }
  return choices;
}

// Paths start from `folder`, the study file's. The texts of files that the filter reads are appended to the study's.
Filter make_filter(const std::string& text, const std::string& place, const std::filesystem::path& folder,
                   std::string& study_text) {
  Spec spec = parse_spec(text, place);
  for (auto& [key, value] : spec.given) value.folder = folder.string();
  Filter filter(spec);
  for (const Param& p : filter.info().params) {
    if (p.kind != Param::Kind::path) continue;
    study_text += fmt::format("\n# {}\n{}", filter.args().text(p.name), read_text(filter.args().path(p.name)));
  }
  return filter;
}

EstimatorChoice make_estimator(const std::string& text, const std::string& place) {
  return {text, find_estimator(text, place)};
}

// One layout, or a list of them.
std::vector<Layout> parse_layouts(const Node& node) {
  if (node.kind == Node::Kind::text) return {find_layout(node.text, node.place)};
  std::vector<Layout> layouts;
  for (const Node& item : list_of(node, "layout", "[\"pixel\", \"image\"]")) {
    const Layout layout = find_layout(text_of(item, "an entry of layout"), item.place);
    refuse_twice(item, fmt::format("\"{}\"", item.text),
                 std::find(layouts.begin(), layouts.end(), layout) == layouts.end());
    layouts.push_back(layout);
  }
  return layouts;
}

MeasureSet parse_measures(const Node& node) {
  MeasureSet set;
  for (const Node& item : list_of(node, "measures", "[\"error\"]")) {
    const Measure m = find_measure(text_of(item, "an entry of measures"), item.place);
    refuse_twice(item, fmt::format("\"{}\"", item.text), !set.has(m));
    set.add(m);
  }
  if (!set.has(Measure::error)) {
    throw Error(node.place, "measures has no \"error\", which summaries and rankings rest on; add it");
  }
  return set;
}

SpectrumSettings parse_spectrum(const Node& node) {
  if (node.kind != Node::Kind::table) {
    throw Error(node.place, fmt::format("spectrum is {}; write a table [spectrum]", kind_name(node.kind)));
  }
  constexpr std::string_view kKeys[] = {"window", "pixels_per_degree"}, kWindows[] = {"none", "hann"};
  SpectrumSettings settings;
  for (const Node& item : node.items) {
    if (item.key == "window") {
      const std::string& name = text_of(item, "window");
      const auto known = std::find(std::begin(kWindows), std::end(kWindows), name);
      if (known == std::end(kWindows)) throw Error(item.place, unknown_name("window", name, kWindows));
      settings.window = static_cast<SpectrumWindow>(known - std::begin(kWindows));
    } else if (item.key == "pixels_per_degree") {
      settings.pixels_per_degree = exact_number(item);
      if (!(settings.pixels_per_degree >= 1 && settings.pixels_per_degree <= 1000)) {
        throw Error(item.place, fmt::format("pixels_per_degree is {}; give a number from 1 to 1000",
                                            shortest(settings.pixels_per_degree)));
      }
    } else {
      throw Error(item.key_place, "spectrum: " + unknown_name("key", item.key, kKeys));
    }
  }
  return settings;
}

Images parse_images(const Node& node) {
  constexpr std::string_view kNames[] = {"none", "first-trial", "all"};
  constexpr Images kValues[] = {Images::none, Images::first_trial, Images::all};
  const std::string& text = text_of(node, "images");
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    if (text == kNames[i]) return kValues[i];
  }
  throw Error(node.place, unknown_name("images", text, kNames));
}

// The scenes of one [[scene]] table. A scene file's text is appended to the study's.
std::vector<NamedScene> parse_scene_table(const Node& table, const std::string& file, std::size_t limit,
                                          std::string& study_text) {
  const Node* name = table.find("name");
  const Node* path = table.find("file");
  if (path == nullptr) {
    const Node* kind = table.find("kind");
    const Node* named_by = name != nullptr ? name : kind;
    return scenes_of(table, named_by != nullptr ? name_of(*named_by, named_by->key) : "", limit);
  }
  for (const Node& member : table.items) {
    if (member.key != "file" && member.key != "name") {
      throw Error(
          member.key_place,
          fmt::format("\"{}\" stands beside \"file\"; put it into that file, or give all keys here", member.key));
    }
  }
  const std::string& relative = text_of(*path, "file");
  if (relative.empty()) throw Error(path->place, "file is empty; give a scene file's path");
  const std::filesystem::path full = std::filesystem::path(file).parent_path() / relative;
  const auto text = [&] {
    try {
      return read_text(full.string());
    } catch (const Error& e) {
      throw Error(path->place, e.what(), e.code());
    }
  }();
  study_text += fmt::format("\n# {}\n{}", relative, text);
  const Node scene = parse_toml(text, full.string());
  const Node* own = name != nullptr ? name : scene.find("name");
  return scenes_of(scene, own != nullptr ? name_of(*own, "name") : full.stem().string(), limit);
}

std::vector<NamedScene> parse_scenes(const Node& root, const std::string& file, std::string& study_text) {
  const Node* list = root.find("scene");
  if (list == nullptr) throw Error(root.place, "the study has no scenes; add a table [[scene]]");
  if (list->kind != Node::Kind::list || list->items.empty()) {
    throw Error(list->place, fmt::format("scene is {}; write each scene as a table [[scene]]", kind_name(list->kind)));
  }
  std::vector<NamedScene> scenes;
  // A table's scenes may be one family, whose name must be no other table's either.
  std::unordered_map<std::string, const Node*> table_of;
  for (const Node& table : list->items) {
    if (table.kind != Node::Kind::table) {
      throw Error(table.place, fmt::format("a scene is {}; write it as a table [[scene]]", kind_name(table.kind)));
    }
    for (NamedScene& scene : parse_scene_table(table, file, kMaxScenes - scenes.size(), study_text)) {
      if (scene.name.empty()) throw Error(table.place, "the scene's name is empty; give name = \"NAME\"");
      const std::string family(scene_family(scene.name));
      const auto known = table_of.try_emplace(family, &table).first;
      if (known->second != &table) {
        throw Error(table.place,
                    fmt::format("a scene named \"{}\" stands above already; give it another name", family));
      }
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

}  // namespace

Study parse_study(std::string_view text, const std::string& file, const std::string& stem) {
  const Node root = parse_toml(text, file);
  std::vector<std::string_view> known(kStudyKeys.begin(), kStudyKeys.end());
  known.push_back("scene");
  for (const Node& node : root.items) {
    if (std::find(known.begin(), known.end(), node.key) == known.end()) {
      throw Error(node.key_place, "study: " + unknown_name("key", node.key, known));
    }
  }
  Study study;
  study.text = std::string(text);
  study.name = stem;
  if (const Node* n = root.find("name")) study.name = name_of(*n, "name");
  if (const Node* n = root.find("seed")) {
    study.seed = static_cast<std::uint64_t>(integer_of(*n, "seed", 0, std::numeric_limits<std::int64_t>::max()));
  }
  if (const Node* n = root.find("trials")) study.trials = static_cast<int>(integer_of(*n, "trials", 1, kMaxTrials));
  if (const Node* n = root.find("layout")) study.layouts = parse_layouts(*n);
  const Node* spp = root.find("spp");
  study.spp = spp != nullptr ? parse_spp(*spp) : std::vector<int>{1, 4, 16, 64, 256};
  const Node* patterns = root.find("patterns");
  if (patterns == nullptr) throw Error(root.place, "the study has no patterns; add patterns = [\"jittered\"]");
  study.patterns = parse_specs<PatternChoice>(
      *patterns, "patterns", "[\"jittered\"]",
      [](const std::string& t, const std::string& place) { return PatternChoice(parse_spec(t, place)); });
  if (const Node* n = root.find("filters")) {
    study.filters =
        parse_specs<Filter>(*n, "filters", "[\"box\"]", [&](const std::string& t, const std::string& place) {
          return make_filter(t, place, std::filesystem::path(file).parent_path(), study.text);
        });
  } else {
    study.filters = {Filter(parse_spec("box", file))};
  }
  if (const Node* n = root.find("estimators")) {
    study.estimators = parse_specs<EstimatorChoice>(*n, "estimators", "[\"ratio\"]", make_estimator);
  } else {
    study.estimators = {make_estimator("ratio", file)};
  }
  if (const Node* n = root.find("measures")) {
    study.measures = parse_measures(*n);
  } else {
    study.measures.add(Measure::error);
  }
  if (const Node* n = root.find("spectrum")) study.spectrum = parse_spectrum(*n);
  if (const Node* n = root.find("images")) study.images = parse_images(*n);
  study.scenes = parse_scenes(root, file, study.text);
  return study;
}

}  // namespace moire
