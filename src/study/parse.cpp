// Study files: from TOML to a checked Study.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <unordered_map>
#include <utility>

#include "core/args.h"
#include "core/error.h"
#include "core/names.h"
#include "study/document.h"
#include "study/lists.h"
#include "study/scene_file.h"
#include "study/study.h"
#include "study/study_keys.h"
#include "study/text_file.h"

namespace moire {
namespace {

constexpr std::array<std::string_view, 12> kStudyKeys = {"name",     "seed",     "trials",   "layout",
                                                         "spp",      "patterns", "filters",  "estimators",
                                                         "measures", "images",   "spectrum", "accuracy"};

// The bound that exact values aim at, near the horizon and elsewhere.
WeightAim accuracy_of(const Node& node) {
  const double aim = exact_number(node);
  if (!(aim >= kFinestAim && aim <= kCoarsestAim)) {
    throw Error(node.place,
                fmt::format("accuracy = {}; a number from {} to {}, the error bound that exact values aim at",
                            shortest(aim), shortest(kFinestAim), shortest(kCoarsestAim)));
  }
  return WeightAim::everywhere(aim);
}

// Puts the text of a file that the study names behind the study's own.
void append_file(std::string_view name, const std::string& text, const std::string& place, std::string& study_text) {
  study_text += fmt::format("\n# {}\n{}", name, text);
  if (study_text.size() > kMaxStudyBytes) {
    throw Error(place,
                fmt::format("the study has more than {} MiB with the files that it names; name fewer, or smaller "
                            "ones",
                            kMaxStudyBytes >> 20));
  }
}

// Paths start from `folder`, the study file's. The texts of files that the filter reads are appended to the study's.
Filter make_filter(const std::string& text, const std::string& place, const std::filesystem::path& folder,
                   std::string& study_text) {
  Spec spec = parse_spec(text, place);
  for (auto& [key, value] : spec.given) {
    value.folder = folder.string();
    if (key == "path") require_regular_file((folder / value.text).string());
  }
  Filter filter(spec);
  for (const Param& p : filter.info().params) {
    if (p.kind != Param::Kind::path) continue;
    append_file(filter.args().text(p.name), read_named_file(filter.args().path(p.name), kMaxTomlBytes), place,
                study_text);
  }
  return filter;
}

// One estimator or form once, however it is written, and none that a layout of the study has no samples for.
std::vector<EstimatorChoice> parse_estimators(const Node& node, const std::vector<Layout>& layouts) {
  std::vector<EstimatorChoice> estimators;
  for (const Node& item : list_of(node, "estimators", "[\"ratio\"]")) {
    const std::string& text = text_of(item, "an entry of estimators");
    const Estimator estimator = find_estimator(text, item.place);
    const bool is_new = std::none_of(estimators.begin(), estimators.end(),
                                     [&](const EstimatorChoice& known) { return known.value == estimator; });
    const std::string_view name = name_of(estimator);
    refuse_twice(item, text == name ? fmt::format("\"{}\"", text) : fmt::format("\"{}\", which is \"{}\",", text, name),
                 is_new);
    for (const Layout layout : layouts) require_layout(estimator, layout, item.place);
    estimators.emplace_back(estimator);
  }
  return estimators;
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

// Measures of images, and discrepancies of the patterns' sets, one of a kind.
void parse_measures(const Node& node, Study& study) {
  MeasureSet& set = study.measures;
  for (const Node& item : list_of(node, "measures", "[\"error\"]")) {
    const std::string& text = text_of(item, "an entry of measures");
    if (const Spec spec = parse_spec(text, item.place); is_discrepancy(spec.name)) {
      const bool is_new = std::none_of(study.discrepancies.begin(), study.discrepancies.end(),
                                       [&](const DiscrepancyChoice& known) { return known.info().name == spec.name; });
      refuse_twice(item, fmt::format("\"{}\"", spec.name), is_new);
      study.discrepancies.emplace_back(spec);
      continue;
    }
    const Measure m = find_measure(text, item.place);
    refuse_twice(item, fmt::format("\"{}\"", item.text), !set.has(m));
    set.add(m);
  }
  if (!set.has(Measure::error)) {
    throw Error(node.place, "measures has no \"error\", which summaries and rankings rest on; add it");
  }
}

SpectrumSettings parse_spectrum(const Node& node) {
  if (node.kind != Node::Kind::table) {
    throw Error(node.place, fmt::format("spectrum is {}; write a table [spectrum]", kind_name(node.kind)));
  }
  constexpr std::string_view kKeys[] = {"window", "pixels_per_degree"};
  SpectrumSettings settings;
  for (const Node& item : node.items) {
    if (item.key == "window") {
      settings.window = find_window(text_of(item, "window"), item.place);
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

// Keys of a [[scene]] table that are no scene's own.
constexpr std::array<std::string_view, 3> kCaseKeys = {"patterns", "spp", "layout"};

bool is_case_key(std::string_view key) { return std::find(kCaseKeys.begin(), kCaseKeys.end(), key) != kCaseKeys.end(); }

// Where the members of a list of the scene's stand in the study's; `texts` are the study's, in words.
std::vector<std::uint32_t> chosen(const Node& node, const std::vector<std::string>& texts) {
  std::vector<std::uint32_t> indices;
  const std::vector<Node> one{node};
  const bool is_list = node.kind == Node::Kind::list;
  for (const Node& item : is_list ? list_of(node, node.key, "the study's") : one) {
    const std::string text =
        item.kind == Node::Kind::integer ? std::to_string(item.integer) : text_of(item, "an entry of " + node.key);
    const auto at = std::find(texts.begin(), texts.end(), text);
    if (at == texts.end()) {
      const std::vector<std::string_view> known(texts.begin(), texts.end());
      throw Error(item.place, fmt::format("\"{}\" is not in the study's own list of {}; there are {}", text, node.key,
                                          join(known)));
    }
    const auto index = static_cast<std::uint32_t>(at - texts.begin());
    refuse_twice(item, fmt::format("\"{}\"", text), std::find(indices.begin(), indices.end(), index) == indices.end());
    indices.push_back(index);
  }
  std::sort(indices.begin(), indices.end());  // the plan goes in the study's order
  return indices;
}

// What a [[scene]] table restricts its scenes to.
SceneCases parse_cases(const Node& table, const Study& study) {
  std::vector<std::string> patterns, spp, layouts;
  for (const PatternChoice& p : study.patterns) patterns.push_back(p.text());
  for (const int n : study.spp) spp.push_back(std::to_string(n));
  for (const Layout layout : study.layouts) layouts.emplace_back(name_of(layout));
  SceneCases cases = all_cases(study);
  const auto restrict_to = [&](std::string_view key, const std::vector<std::string>& texts,
                               std::vector<std::uint32_t>& indices) {
    if (const Node* node = table.find(key)) indices = chosen(*node, texts);
  };
  restrict_to("patterns", patterns, cases.patterns);
  restrict_to("spp", spp, cases.spp);
  restrict_to("layout", layouts, cases.layouts);
  return cases;
}

// The scenes of one [[scene]] table. A scene file's text is appended to the study's.
std::vector<NamedScene> parse_scene_table(const Node& table, const std::string& file, std::size_t limit,
                                          std::string& study_text) {
  const Node* name = table.find("name");
  const Node* path = table.find("file");
  if (path == nullptr) {
    const Node* kind = table.find("kind");
    const Node* named_by = name != nullptr ? name : kind;
    Node own = table;
    std::erase_if(own.items, [](const Node& node) { return is_case_key(node.key); });
    return scenes_of(own, named_by != nullptr ? name_of(*named_by, named_by->key) : "", limit);
  }
  for (const Node& member : table.items) {
    if (member.key != "file" && member.key != "name" && !is_case_key(member.key)) {
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
      return read_named_file(full.string(), kMaxTomlBytes);
    } catch (const Error& e) {
      throw Error(path->place, e.what(), e.code());
    }
  }();
  append_file(relative, text, path->place, study_text);
  const Node scene = parse_toml(text, full.string());
  const Node* own = name != nullptr ? name : scene.find("name");
  return scenes_of(scene, own != nullptr ? name_of(*own, "name") : full.stem().string(), limit);
}

void parse_scenes(const Node& root, const std::string& file, Study& study) {
  const Node* list = root.find("scene");
  if (list == nullptr) throw Error(root.place, "the study has no scenes; add a table [[scene]]");
  if (list->kind != Node::Kind::list || list->items.empty()) {
    throw Error(list->place, fmt::format("scene is {}; write each scene as a table [[scene]]", kind_name(list->kind)));
  }
  std::vector<NamedScene>& scenes = study.scenes;
  // A table's scenes may be one family, whose name must be no other table's either.
  std::unordered_map<std::string, const Node*> table_of;
  for (const Node& table : list->items) {
    if (table.kind != Node::Kind::table) {
      throw Error(table.place, fmt::format("a scene is {}; write it as a table [[scene]]", kind_name(table.kind)));
    }
    for (NamedScene& scene : parse_scene_table(table, file, kMaxScenes - scenes.size(), study.text)) {
      if (scene.name.empty()) throw Error(table.place, "the scene's name is empty; give name = \"NAME\"");
      const std::string family(scene_family(scene.name));
      const auto known = table_of.try_emplace(family, &table).first;
      if (known->second != &table) {
        throw Error(table.place,
                    fmt::format("a scene named \"{}\" stands above already; give it another name", family));
      }
      scenes.push_back(std::move(scene));
    }
    study.scene_cases.resize(scenes.size(), parse_cases(table, study));
  }
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
  if (const Node* n = root.find("seed")) study.seed = seed_of(*n);
  if (const Node* n = root.find("trials")) study.trials = static_cast<int>(integer_of(*n, "trials", 1, kMaxTrials));
  if (const Node* n = root.find("layout")) study.layouts = parse_layouts(*n);
  const Node* spp = root.find("spp");
  study.spp = spp != nullptr ? integers_of(*spp, "spp", "[1, 4, 16]", "a number of samples per pixel", 1, kMaxSamples)
                             : std::vector<int>{1, 4, 16, 64, 256};
  const Node* patterns = root.find("patterns");
  if (patterns == nullptr) throw Error(root.place, "the study has no patterns; add patterns = [\"jittered\"]");
  study.patterns = specs_of<PatternChoice>(
      *patterns, "patterns", "[\"jittered\"]",
      [](const std::string& t, const std::string& place) { return PatternChoice(parse_spec(t, place)); });
  if (const Node* n = root.find("filters")) {
    study.filters = specs_of<Filter>(*n, "filters", "[\"box\"]", [&](const std::string& t, const std::string& place) {
      return make_filter(t, place, std::filesystem::path(file).parent_path(), study.text);
    });
  } else {
    study.filters = {Filter(parse_spec("box", file))};
  }
  if (const Node* n = root.find("estimators")) {
    study.estimators = parse_estimators(*n, study.layouts);
  } else {
    study.estimators = {EstimatorChoice(Estimator::ratio)};
  }
  if (const Node* n = root.find("measures")) {
    parse_measures(*n, study);
  } else {
    study.measures.add(Measure::error);
  }
  if (const Node* n = root.find("spectrum")) study.spectrum = parse_spectrum(*n);
  if (const Node* n = root.find("images")) study.images = images_of(*n);
  if (const Node* n = root.find("accuracy")) study.accuracy = accuracy_of(*n);
  parse_scenes(root, file, study);
  return study;
}

}  // namespace moire
