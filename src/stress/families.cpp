// The list of families, in the order of the table.
#include <array>

#include "stress/family.h"

namespace moire::stress {

extern const Family edges, disks, boards, kernels, patterns, discrepancies, sums, spectra, reconstruction;

std::span<const Family> families() {
  static const std::array all = {edges, disks, boards, kernels, patterns, discrepancies, sums, spectra, reconstruction};
  return all;
}

}  // namespace moire::stress
