// Filter strings: the kernel that comes out, and what it promises.
#include <cmath>

#include "core/args.h"
#include "filters/filter.h"
#include "fuzz.h"

using namespace moire;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 1024) return 0;
  const std::string_view text = fuzz::text_of(data, size);
  if (text.find("path") != std::string_view::npos) return 0;  // files of kernels have a target of their own
  return fuzz::run_target([&] {
    const Filter filter(parse_spec(text, "--filter"));
    fuzz::require(filter.radius() > 0 && filter.apron() >= 0, "a kernel has a radius");
    fuzz::require(!filter.text().empty(), "a filter has a name");
  });
}
