// Names of the image files of a study, relative to the folder of its results.
#include "study/file_names.h"

#include <fmt/format.h>

#include <map>

#include "core/error.h"

namespace moire {
namespace {

// Longest of the endings that are put behind a stem, ".error.exr" and that of a temporary file beside it.
constexpr std::size_t kLongestEnding = 40;
constexpr std::size_t kMaxFileName = 255;

// Throws when two of the names give the same part of a file name; returns the longest part.
template <class Items, class NameOf>
std::size_t check_parts(const Items& items, std::string_view what, NameOf&& name_of) {
  std::map<std::string, std::string> seen;
  std::size_t longest = 0;
  for (const auto& item : items) {
    const std::string& name = name_of(item);
    const auto [it, inserted] = seen.emplace(file_part(name), name);
    if (!inserted) {
      throw Error("images", fmt::format("the {}s \"{}\" and \"{}\" would share the file name \"{}\"; rename one, or "
                                        "set images = \"none\"",
                                        what, it->second, name, it->first));
    }
    longest = std::max(longest, it->first.size());
  }
  return longest;
}

}  // namespace

std::string file_part(std::string_view text) {
  std::string part(text);
  for (char& c : part) {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '=' || c == '-';
    if (!kept) c = '-';
  }
  return part;
}

std::string spectra_stem(const Study& study, const Case& c) {
  const std::string& estimator = study.estimators[c.estimator].text;
  return fmt::format("images/{}_{}_{}_{}{}{}", file_part(study.scenes[c.scene].name),
                     file_part(study.patterns[c.pattern].text()), study.spp[c.spp],
                     file_part(study.filters[c.filter].text()), estimator == "ratio" ? "" : "_" + file_part(estimator),
                     study.layouts[c.layout] == Layout::image ? "_image" : "");
}

std::string image_stem(const Study& study, const Case& c) {
  return fmt::format("{}_t{}", spectra_stem(study, c), c.trial);
}

std::string exact_stem(const Study& study, std::uint32_t scene, std::uint32_t filter) {
  return fmt::format("images/{}_{}", file_part(study.scenes[scene].name), file_part(study.filters[filter].text()));
}

bool keeps_images(const Study& study, std::uint32_t trial) {
  return study.images == Images::all || (study.images == Images::first_trial && trial == 0);
}

void check_image_size(const NamedScene& scene, const std::string& place) {
  const Grid grid = scene.image.grid();
  if (std::int64_t{grid.width} * grid.height > kMaxImagePixels) {
    throw Error(place,
                fmt::format("scene \"{}\" has {} x {} pixels, too many for an image file; give at most {} pixels, "
                            "or write no images",
                            scene.name, grid.width, grid.height, kMaxImagePixels));
  }
}

void check_file_names(const Study& study) {
  if (study.images == Images::none) return;
  const std::size_t longest =
      check_parts(study.scenes, "scene", [](const NamedScene& s) -> const std::string& { return s.name; }) +
      check_parts(study.patterns, "pattern", [](const PatternChoice& p) -> const std::string& { return p.text(); }) +
      check_parts(study.filters, "filter", [](const Filter& f) -> const std::string& { return f.text(); }) +
      check_parts(study.estimators, "estimator", [](const EstimatorChoice& e) -> const std::string& { return e.text; });
  if (longest + kLongestEnding > kMaxFileName) {
    throw Error("images", fmt::format("names of scene, pattern, filter and estimator make file names above {} bytes; "
                                      "shorten them, or set images = \"none\"",
                                      kMaxFileName));
  }
  for (const NamedScene& scene : study.scenes) check_image_size(scene, "images");
}

}  // namespace moire
