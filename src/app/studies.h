// Studies that are part of the program: the files of reports/studies, embedded when it is built.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "study/discrepancy_study.h"
#include "study/study.h"

namespace moire {

struct BuiltinStudy {
  std::string_view name, text;
};

std::span<const BuiltinStudy> builtin_studies();

// What a study is for: the first comment of its text.
std::string_view study_title(std::string_view text);

// Of images, or of discrepancies alone.
using AnyStudy = std::variant<Study, DiscrepancyStudy>;

// A built-in study by name, else a study file. Throws Error; a word that is neither a built-in name nor looks like a
// file (no '/', no ".toml") is answered with the nearest names.
AnyStudy load_study(const std::string& word);

}  // namespace moire
