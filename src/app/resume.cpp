// What an earlier run left in a folder, put beside the plan of the study that is to go on there.
#include "app/resume.h"

#include <fmt/format.h>

#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/error.h"

namespace moire {
namespace {

constexpr std::string_view kAdvice = "give another folder, or run without --resume to start again";

}  // namespace

Earlier find_earlier(const std::string& path, const std::string& header, const PlannedRows& planned) {
  Earlier earlier{read_results(path), Table(planned.keys.size()), 0};
  ResultsFile& file = earlier.file;
  if (file.header.empty()) {
    // The very first line may have been cut; anything else is not ours to write over.
    if (!header.starts_with(file.cut))
      throw Error(path + ":1", fmt::format("is not the header of results; {}", kAdvice));
    return earlier;
  }
  // The seed stands in the study's text as well, but names what differs.
  const auto seed = static_cast<double>(planned.seed);
  if (!file.rows.empty() && file.rows.front().number("seed") != seed) {
    throw Error(path, fmt::format("is of another seed ({:.0f}, here {}); {}", file.rows.front().number("seed"),
                                  planned.seed, kAdvice));
  }
  if (const std::string difference = header_difference(file.header, header); !difference.empty()) {
    throw Error(path, fmt::format("is of {}; {}", difference, kAdvice));
  }

  std::unordered_map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < planned.keys.size(); ++i) index_of.emplace(planned.keys[i], i);
  for (std::size_t i = 0; i < file.rows.size(); ++i) {
    const std::string name = planned.key_of(file.rows[i]), place = fmt::format("{}:{}", path, i + 2);
    const auto found = index_of.find(name);
    if (found == index_of.end() || file.rows[i].number("seed") != seed) {
      throw Error(place, fmt::format("\"{}\" is no case of this study; mend or remove the line", name));
    }
    Row& row = earlier.rows[found->second];
    if (!row.cells().empty())
      throw Error(place, fmt::format("\"{}\" stands above already; remove one of the lines", name));
    row = std::move(file.rows[i]);
    ++earlier.kept;
  }
  file.rows.clear();
  return earlier;
}

}  // namespace moire
