// Kernel files: the rows "x,k" of a kernel that a user brings, read and checked.
//
// Plain CSV: an optional header line, lines that begin with # and blank lines do not count. x in pixels from the
// kernel's centre, never decreasing; two rows of one x are a jump there. Where no x is negative the rows are the right
// half of an even kernel, and its two innermost rows are neighbours like any others.
#pragma once

#include <string>
#include <vector>

namespace moire {

struct KernelRow {
  double x, k;
};

// Limits of a file: its rows, and the size of |x| in pixels. Different x are at least kLeastStep apart: nearer ones are
// a jump, which is written with one x. The largest |k| lies within kLeastPeak and kMostPeak.
inline constexpr int kMaxKernelRows = 4096;
inline constexpr double kMaxKernelRadius = 16, kMinKernelRadius = 0.0625, kLeastStep = 0x1p-20, kLeastPeak = 1e-30,
                        kMostPeak = 1e30;

// The rows of the whole kernel, from left to right; a half is mirrored. At least two, of at least two different x.
// Throws Error with file:line:column; for a file that cannot be read, with `place` and Exit::io.
std::vector<KernelRow> read_kernel_file(const std::string& path, const std::string& place);

}  // namespace moire
