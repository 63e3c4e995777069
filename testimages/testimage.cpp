// The catalogue of scenes, built from the list in CMakeLists.txt.
#include "testimages/testimage.h"

#include <array>

#include "core/error.h"
#include "core/names.h"

namespace moire {

#define MOIRE_ITEM(name) extern const TestImageInfo name##_testimage;
#include "testimages_plugins.inc"
#undef MOIRE_ITEM

namespace {
#define MOIRE_ITEM(name) &name##_testimage,
constexpr auto kTestImages = std::to_array<const TestImageInfo*>({
#include "testimages_plugins.inc"
});
#undef MOIRE_ITEM
}  // namespace

std::span<const TestImageInfo* const> testimages() { return kTestImages; }

const TestImageInfo& find_testimage(std::string_view name, std::string_view place) {
  std::vector<std::string_view> known;
  for (const TestImageInfo* t : kTestImages) {
    if (t->name == name) return *t;
    known.push_back(t->name);
  }
  throw Error(std::string(place), unknown_name("scene kind", name, known));
}

TestImage::TestImage(const TestImageInfo& info, const Given& given, Grid grid, std::string_view place)
    : info_(&info),
      grid_(grid),
      self_(info.make(Args("scene kind \"" + std::string(info.name) + "\"", info.params, given, place), grid)) {
  if (grid.width < 1 || grid.height < 1 || grid.width > kMaxSide || grid.height > kMaxSide) {
    throw Error(std::string(place), "an image of " + std::to_string(grid.width) + " x " + std::to_string(grid.height) +
                                        " pixels; each side must be 1 to " + std::to_string(kMaxSide));
  }
}

}  // namespace moire
