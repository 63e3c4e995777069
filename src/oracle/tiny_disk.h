// Disks far smaller than a pixel under separable kernels, to as many digits as large ones.
#pragma once

#include "oracle/kernel.h"
#include "oracle/scene.h"

namespace moire::oracle {

// Integral of k(x) k(y) over the disk, over the square of its radius, which may be anything up to the kernel's. Places
// are counted from the disk's centre, in radii: sections of height sin a and half length cos a, summed over the angle
// a, so that nothing cancels and no integrand has a root. RingKernel's counterpart is in rings.h.
Value filtered_per_square(const Kernel& k, const Disk& disk, Pixel pixel);

}  // namespace moire::oracle
