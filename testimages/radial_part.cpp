#include "testimages/radial_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace moire {
namespace {

constexpr double kSlack = 1 + 0x1p-20;

}  // namespace

DiskPart::DiskPart(const LocalHomography::Row& w, double radius, const RadialPart& part)
    : part_(part),
      radius_(radius),
      centre_(w.c.value()),
      slope_(std::hypot(w.a, w.b)),
      towards_(std::atan2(w.b, w.a)) {}

// No wider than the notch: what is on its way to the horizon alone.
double DiskPart::largest_w(double r) const {
  const double w = std::clamp(centre_ + slope_ * r, 0.0, part_.depth);
  return r <= part_.notch ? std::min(w, part_.notch_depth) : w;
}

// Where the circle meets W = w.
double DiskPart::angle_at(double r, double w) const {
  const double rise = slope_ * r;
  if (w - centre_ >= rise) return 0;
  return w - centre_ <= -rise ? std::numbers::pi : std::acos((w - centre_) / rise);
}

Vec2 DiskPart::on_circle(double r, double angle) const {
  return {r * std::cos(towards_ + angle), r * std::sin(towards_ + angle)};
}

std::vector<DiskPart::Arc> DiskPart::arcs_of(double r) const {
  std::vector<Arc> arcs{{angle_at(r, part_.depth), angle_at(r, 0)}};
  const auto leave_out = [&](double from, double to) {
    if (!(from < to)) return;
    std::vector<Arc> left;
    for (const Arc& arc : arcs) {
      left.push_back({arc.from, std::min(arc.to, from)});
      left.push_back({std::max(arc.from, to), arc.to});
    }
    arcs = left;
  };
  if (part_.notch > 0) {
    const double bottom = angle_at(r, part_.notch_depth);
    const double side = r > part_.notch ? std::asin(part_.notch / r) : 0.5 * std::numbers::pi;
    leave_out(0, std::min(side, bottom));
    leave_out(std::numbers::pi - side, bottom);
  }
  std::erase_if(arcs, [](const Arc& arc) { return !(arc.to > arc.from); });
  return arcs;
}

// Angles are widened by more than rounding, which counts most where the circle touches a line.
double DiskPart::length_of(double r) const {
  const double off = 0x1p-40 * (slope_ * r + std::fabs(centre_) + part_.depth);
  return 2 * r * (angle_at(r, -off) - angle_at(r, part_.depth + off) + 0x1p-40);
}

std::vector<Vec2> DiskPart::path() const {
  const double half = angle_at(radius_, part_.depth);
  if (half == 0) return {};
  std::vector<Vec2> path{on_circle(radius_, -half)};
  if (part_.notch > 0) {
    const Vec2 up{std::cos(towards_), std::sin(towards_)};
    const auto add = [&](double across, double w) {
      const double rise = (w - centre_) / slope_;
      path.push_back({rise * up.x - across * up.y, rise * up.y + across * up.x});
    };
    add(-part_.notch, part_.depth);
    add(-part_.notch, part_.notch_depth);
    add(part_.notch, part_.notch_depth);
    add(part_.notch, part_.depth);
  }
  path.push_back(on_circle(radius_, half));
  return path;
}

double DiskPart::distance() const {
  if (!(slope_ > 0)) return 0;
  if (part_.notch > 0 && part_.notch_depth < centre_) return path_distance();
  return std::max({0.0, (centre_ - part_.depth) / slope_, -centre_ / slope_});
}

double DiskPart::path_distance() const {
  if (!(slope_ > 0)) return HUGE_VAL;
  if (part_.notch == 0) return std::fabs(part_.depth - centre_) / slope_ * (1 - 0x1p-40);
  return std::min(part_.notch, std::fabs(part_.notch_depth - centre_) / slope_) * (1 - 0x1p-40);
}

double DiskPart::area(double low, double high) const {
  const double ring = std::numbers::pi * (high - low) * (high + low) * kSlack;
  if (!(slope_ > 0)) return ring;
  const double nearest = std::max(centre_ - slope_ * high, 0.0);
  if (nearest > part_.depth) return 0;  // all of it is in front
  const double deepest = std::clamp(centre_ + slope_ * high, 0.0, part_.depth);
  return std::min(ring, 2 * high * (deepest - nearest) / slope_ * kSlack);
}

double DiskPart::reach() const { return slope_ > 0 ? radius_ + (std::fabs(centre_) + part_.depth) / slope_ : radius_; }

}  // namespace moire
