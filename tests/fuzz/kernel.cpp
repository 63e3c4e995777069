// Files of kernels: read, and made a filter with straight and with cubic pieces.
#include "core/args.h"
#include "filters/filter.h"
#include "fuzz.h"

using namespace moire;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > (1 << 14)) return 0;
  const fuzz::MemoryFile file(data, size);
  for (const char* between : {"linear", "cubic"}) {
    fuzz::run_target([&] {
      const Filter filter(parse_spec("tabulated:path=" + file.path() + ",between=" + between, "--filter"));
      fuzz::require(filter.radius() > 0 && filter.apron() >= 0, "a kernel has a radius");
    });
  }
  return 0;
}
