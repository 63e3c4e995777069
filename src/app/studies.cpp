// Studies that are part of the program, and study files.
#include "app/studies.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/names.h"
#include "study/document.h"
#include "study/text_file.h"

namespace moire {
namespace {

constexpr BuiltinStudy kStudies[] = {
#include "builtin_studies.inc"
};

AnyStudy parse_any(std::string_view text, const std::string& file, const std::string& stem) {
  const Node root = parse_toml(text, file);
  if (is_discrepancy_study(root)) return parse_discrepancy_study(root, text, stem);
  return parse_study(text, file, stem);
}

}  // namespace

std::span<const BuiltinStudy> builtin_studies() { return kStudies; }

std::string_view study_title(std::string_view text) {
  if (!text.starts_with("# ")) return {};
  text.remove_prefix(2);
  return text.substr(0, text.find('\n'));
}

AnyStudy load_study(const std::string& word) {
  std::vector<std::string_view> names;
  for (const BuiltinStudy& study : builtin_studies()) {
    if (study.name == word) return parse_any(study.text, word + ".toml", word);
    names.push_back(study.name);
  }
  const std::filesystem::path path(word);
  std::error_code none;  // a name that is too long does not exist
  if (word.find('/') == std::string::npos && path.extension() != ".toml" && !std::filesystem::exists(path, none)) {
    throw Error("STUDY", unknown_name("built-in study", word, names) + "; or give a file, NAME.toml");
  }
  return parse_any(read_bytes(word, kMaxTomlBytes), word, path.stem().string());
}

}  // namespace moire
