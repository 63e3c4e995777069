#include "testimages/homography.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "testimages/scene_args.h"

namespace moire {
namespace {

double one(const Args& args, std::string_view name, double fallback) {
  const Value* v = args.find(name);
  if (v == nullptr) return fallback;
  if (v->rank != 0 || v->numbers.size() != 1) throw Error(v->place, "\"" + std::string(name) + "\" must be one number");
  return v->numbers[0];
}

}  // namespace

Matrix3 camera_homography(const Args& args, Grid grid) {
  const double focal = one(args, "camera.focal", 0), height = one(args, "camera.height", 1);
  if (!(focal > 0)) throw Error(args.find("camera.focal")->place, "\"camera.focal\" must be above 0, in pixels");
  if (!(height > 0)) throw Error(args.find("camera.height")->place, "\"camera.height\" must be above 0, in squares");
  Vec2 principal{grid.width / 2.0, grid.height / 2.0};
  if (args.find("camera.principal") != nullptr) principal = point(args, "camera.principal");
  using Eigen::Matrix3d;
  const double degree = std::numbers::pi / 180;
  const double r = one(args, "camera.roll", 0) * degree, p = one(args, "camera.pitch", 0) * degree,
               w = one(args, "camera.yaw", 0) * degree;
  Matrix3d ray, roll, pitch, yaw, plane;
  ray << 1 / focal, 0, -principal.x / focal, 0, 1 / focal, -principal.y / focal, 0, 0, 1;
  roll << std::cos(r), -std::sin(r), 0, std::sin(r), std::cos(r), 0, 0, 0, 1;
  pitch << 1, 0, 0, 0, std::cos(p), std::sin(p), 0, -std::sin(p), std::cos(p);
  yaw << std::cos(w), 0, std::sin(w), 0, 1, 0, -std::sin(w), 0, std::cos(w);
  plane << height, 0, 0, 0, 0, height, 0, 1, 0;  // (X, Y, Z) -> (height X, height Z, Y)
  const Matrix3d h = plane * yaw * pitch * roll * ray;
  Matrix3 out;
  for (int i = 0; i < 9; ++i) out[static_cast<std::size_t>(i)] = h(i / 3, i % 3) + 0.0;
  return out;
}

void require_invertible(const Matrix3& h, const std::string& place) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = h[static_cast<std::size_t>(i)];
  for (int i = 0; i < 3; ++i) {
    const double size = m.row(i).cwiseAbs().maxCoeff();
    if (size > 0) m.row(i) /= size;
  }
  for (int i = 0; i < 3; ++i) {
    const double size = m.col(i).cwiseAbs().maxCoeff();
    if (size > 0) m.col(i) /= size;
  }
  if (!m.allFinite() || Eigen::FullPivLU<Eigen::Matrix3d>(m).rank() < 3) {
    throw Error(place, "the homography is singular; its rows must be independent");
  }
}

LocalHomography localize(const Matrix3& h, Pixel origin, double shift) {
  const Dd x = dd_from_integer(origin.x) + Dd(shift), y = dd_from_integer(origin.y) + Dd(shift);
  const auto row = [&](std::size_t i) {
    // Two products and two sums in double-double, and x and y themselves: 16 2^-106 of the terms.
    const double terms = std::fabs(h[i] * x.hi) + std::fabs(h[i + 1] * y.hi) + std::fabs(h[i + 2]);
    return LocalHomography::Row{h[i], h[i + 1], Dd(h[i]) * x + Dd(h[i + 1]) * y + Dd(h[i + 2]), 0x1p-102 * terms};
  };
  return {row(0), row(3), row(6)};
}

}  // namespace moire
