// Estimator strings: what is found has a name that finds it again.
#include "engine/estimator.h"
#include "fuzz.h"

using namespace moire;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 1024) return 0;
  return fuzz::run_target([&] {
    const Estimator estimator = find_estimator(fuzz::text_of(data, size), "--estimator");
    fuzz::require(find_estimator(name_of(estimator), "") == estimator, "an estimator's name finds it");
  });
}
