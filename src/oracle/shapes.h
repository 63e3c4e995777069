// The definitions of the even kernels, in long double and on no particular scale: what oracle::Kernel integrates.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/args.h"

namespace moire::oracle {

// The half |x| >= 0 of an even kernel. x in pixels.
struct HalfKernel {
  // Where the kernel is not analytic as a function of |x|; 0 first, the radius last.
  std::vector<long double> breaks;
  // k(|x|) up to a factor. At a break, the value of the outer piece; at the radius, of the last one.
  std::function<long double(long double)> shape;
  int degree = -1;  // of the polynomials between breaks; -1: no polynomials
  // Not polynomials: the kernel is entire of about this exponential type between its breaks (sin(w x) has type w), in
  // 1/pixel. How finely pieces are cut follows from it.
  long double type = 0;
};

// The kernel of a filter as the program's catalogue names it, parameters and defaults included. Throws
// std::invalid_argument for a name or choice that has no definition here.
HalfKernel half_kernel(const Spec& spec);

// The even kernel whose right half a file holds in rows x,k, the first at x = 0; nothing else may stand there. Two rows
// of one x are a jump. `cubic`: the natural cubic spline of each stretch between jumps, else straight lines.
HalfKernel tabulated(const std::string& path, bool cubic);

}  // namespace moire::oracle
