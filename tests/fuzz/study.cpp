// Study files, of images and of discrepancies: read, planned where the plan is small, and the names of their files.
#include <algorithm>

#include "fuzz.h"
#include "study/discrepancy_study.h"
#include "study/document.h"
#include "study/file_names.h"
#include "study/study.h"

using namespace moire;

namespace {

// Sets of points that a plan may make in little time.
bool is_small(const std::vector<PatternChoice>& patterns, const std::vector<int>& counts) {
  for (const PatternChoice& p : patterns) {
    if (p.args().given("bank") || p.args().given("k")) return false;
  }
  return patterns.size() * counts.size() < 64 && *std::max_element(counts.begin(), counts.end()) <= 1024;
}

void require_inside(const std::string& stem) {
  fuzz::require(stem.starts_with("images/") && stem.find('/', 7) == std::string::npos && stem.size() < 4096 &&
                    stem.find('\0') == std::string::npos,
                "images stand in their folder");
}

void plan_images(const Study& study) {
  if (!is_small(study.patterns, study.spp) || study.scenes.size() > 1000) return;
  const std::vector<Case> cases = plan(study);
  fuzz::require(cases.size() <= kMaxRows, "a plan is no longer than its limit");
  for (std::size_t i = 0; i < cases.size(); i += 1 + cases.size() / 100) {
    fuzz::require(!describe(study, cases[i]).empty(), "a case has a name");
    require_inside(image_stem(study, cases[i]));
    require_inside(exact_stem(study, cases[i].scene, cases[i].filter));
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 4096) return 0;
  const std::string_view text = fuzz::text_of(data, size);
  // Files that a study names are read as others are; here they would be any of this machine.
  if (text.find("file") != std::string_view::npos || text.find("path") != std::string_view::npos) return 0;
  return fuzz::run_target([&] {
    const Node root = parse_toml(text, "s.toml");
    if (!is_discrepancy_study(root)) return plan_images(parse_study(text, "s.toml", "s"));
    const DiscrepancyStudy study = parse_discrepancy_study(root, text, "s");
    const DiscrepancyPlan planned = plan(study);
    fuzz::require(planned.rows <= kMaxRows, "a plan is no longer than its limit");
  });
}
