// A plane seen in perspective: (x, y, 1) -> (U, V, W), u = U / W, v = V / W, seen where W > 0.
#pragma once

#include <array>

#include "core/args.h"
#include "core/double_double.h"
#include "core/geometry.h"

namespace moire {

// Row-major.
using Matrix3 = std::array<double, 9>;

// The homography of a pinhole camera over the plane from its keys camera.focal, camera.principal, ... in `args`; angles
// in degrees, the rays as the contract of scene files has them. Rounded to doubles: these define the scene.
Matrix3 camera_homography(const Args& args, Grid grid);

// Throws Error at `place` unless the matrix is finite and its rank, rows and columns scaled, is 3.
void require_invertible(const Matrix3& h, const std::string& place);

// The same homography with coordinates counted from a pixel's corner (shift 0) or centre (shift 0.5). The linear parts
// are exact; the constants come from double-double.
struct LocalHomography {
  // Rows U, V, W: a x + b y + c; c is right to c_error, also where its terms cancel.
  struct Row {
    double a, b;
    Dd c;
    double c_error = 0;
  } u, v, w;
};
LocalHomography localize(const Matrix3& h, Pixel origin, double shift);

}  // namespace moire
