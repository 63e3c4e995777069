// results.jsonl of a run that is to go on: nothing is taken for a row that is none.
#include "app/resume.h"

#include <fmt/format.h>

#include "fuzz.h"

using namespace moire;

namespace {

std::string key_of(const Row& row) {
  return fmt::format("{} {} {:.0f} {:.0f}", row.text("scene"), row.text("pattern"), row.number("spp"),
                     row.number("trial"));
}

// What a study of two scenes would write; the seeds of the corpus begin with this header.
const std::string& header() {
  static const std::string kHeader =
      R"({"kind":"header","schema":"moire.results/1","tool":{"version":"1"},"study":{"name":"s","sha256":"0"}})";
  return kHeader;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > (1 << 14)) return 0;
  const fuzz::MemoryFile file(data, size);
  return fuzz::run_target([&] {
    const PlannedRows planned{3, {"a random 4 0", "a random 4 1", "b regular 4 0"}, key_of};
    const Earlier earlier = find_earlier(file.path(), header(), planned);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < planned.keys.size(); ++i) {
      if (earlier.rows.at(i).cells().empty()) continue;
      ++kept;
      fuzz::require(key_of(earlier.rows[i]) == planned.keys[i], "a row that is kept is that of its case");
    }
    fuzz::require(kept == earlier.kept, "rows that are kept are counted");
    fuzz::require(earlier.file.whole_bytes + earlier.file.cut.size() <= size, "what is kept was there");
  });
}
