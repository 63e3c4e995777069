// The disks of a noise field: random sequential placing with a grid of neighbours.
#include "testimages/noise_disks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "core/args.h"
#include "core/error.h"
#include "core/hash.h"

namespace moire {
namespace {

// Where a disk is given up: never, as far as anybody knows, below most_noise_disks().
constexpr std::uint32_t kMostCandidates = 1u << 24;

// Mean area of a disk whose radius is uniform between the two.
double mean_area(double lo, double hi) { return std::numbers::pi / 3 * (lo * lo + lo * hi + hi * hi); }

// Disks sorted into cells of at least their largest diameter, so that only neighbouring cells can hold overlapping
// ones.
class Neighbours {
 public:
  Neighbours(double width, double height, double diameter, std::size_t count)
      : cell_(std::max(diameter, std::sqrt(width * height / static_cast<double>(count)))),
        columns_(static_cast<int>(width / cell_) + 1),
        rows_(static_cast<int>(height / cell_) + 1),
        first_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1) {
    disks_.reserve(count);
    next_.reserve(count);
  }

  bool has_room(const GivenCircle& disk) const noexcept {
    const int column = column_of(disk), row = row_of(disk);
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, rows_ - 1); ++j) {
      for (int i = std::max(column - 1, 0); i <= std::min(column + 1, columns_ - 1); ++i) {
        for (std::int32_t d = first_[cell(i, j)]; d >= 0; d = next_[static_cast<std::size_t>(d)]) {
          if (too_near(disks_[static_cast<std::size_t>(d)], disk)) return false;
        }
      }
    }
    return true;
  }

  void add(const GivenCircle& disk) {
    std::int32_t& first = first_[cell(column_of(disk), row_of(disk))];
    next_.push_back(first);
    first = static_cast<std::int32_t>(disks_.size());
    disks_.push_back(disk);
  }

  std::vector<GivenCircle>& disks() noexcept { return disks_; }

 private:
  // The excess stands above all rounding here, so that what has room is disjoint.
  static bool too_near(const GivenCircle& a, const GivenCircle& b) noexcept {
    const double dx = a.center.x - b.center.x, dy = a.center.y - b.center.y, reach = a.radius + b.radius;
    return dx * dx + dy * dy < reach * reach * (1 + 0x1p-39);
  }

  // Rounding is monotone: whoever is a cell's width or more away is in another cell, and at most one cell further on
  // when nearer than that.
  int column_of(const GivenCircle& disk) const noexcept {
    return static_cast<int>((disk.center.x + kFieldMargin) / cell_);
  }
  int row_of(const GivenCircle& disk) const noexcept {
    return static_cast<int>((disk.center.y + kFieldMargin) / cell_);
  }
  std::size_t cell(int column, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  double cell_;
  int columns_, rows_;
  std::vector<std::int32_t> first_, next_;  // the latest disk of each cell and the one before each disk, or -1
  std::vector<GivenCircle> disks_;
};

}  // namespace

double field_area(Grid grid) { return (grid.width + 2.0 * kFieldMargin) * (grid.height + 2.0 * kFieldMargin); }

std::int64_t most_noise_disks(double min_radius, double max_radius, Grid grid) {
  const double most = kMaxFieldCoverage * field_area(grid) / mean_area(min_radius, max_radius);
  return static_cast<std::int64_t>(std::min(std::floor(most), static_cast<double>(kMaxFieldDisks)));
}

std::vector<GivenCircle> make_noise_disks(const NoiseDisks& field, Grid grid, std::string_view place) {
  const std::int64_t most = most_noise_disks(field.min_radius, field.max_radius, grid);
  if (field.count > most) {
    const double area = field_area(grid);
    const auto per_pixel = [area](std::int64_t n) { return static_cast<double>(n) / area; };
    throw Error(std::string(place),
                fmt::format("{} disks of radius {} to {} are too many for the {:.0f} square pixels of the image and {} "
                            "pixels around it ({:.4g} a pixel); at most {} ({:.4g} a pixel)",
                            field.count, shortest(field.min_radius), shortest(field.max_radius), area, kFieldMargin,
                            per_pixel(field.count), most, per_pixel(most)));
  }
  const auto count = static_cast<std::size_t>(field.count);
  const Key key = pixel_key(draw_hash(field.seed, 0), {});
  const auto words = [&key](std::size_t k, std::uint32_t part) {
    return hash(key, static_cast<std::uint32_t>(k), Axis::field, part);
  };
  std::vector<double> radii(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Words w = words(k, 0);
    const double radius = field.min_radius + (field.max_radius - field.min_radius) * unit(w.a, w.b);
    radii[k] = std::min(radius, field.max_radius);
  }
  std::sort(radii.begin(), radii.end(), std::greater<>());

  const double width = grid.width + 2.0 * kFieldMargin, height = grid.height + 2.0 * kFieldMargin;
  Neighbours neighbours(width, height, 2 * field.max_radius, count);
  for (std::size_t k = 0; k < count; ++k) {
    GivenCircle disk{{}, radii[k]};
    std::uint32_t part = 0;
    do {
      if (part == kMostCandidates) {
        throw Error(std::string(place),
                    fmt::format("no room was found for disk {} of {}; give a smaller count", k, count));
      }
      const Words w = words(k, ++part);
      disk.center = {unit(w.a, w.b) * width - kFieldMargin, unit(w.c, w.d) * height - kFieldMargin};
    } while (!neighbours.has_room(disk));
    neighbours.add(disk);
  }
  return std::move(neighbours.disks());
}

}  // namespace moire
