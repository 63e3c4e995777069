// Random small disks all over the image and beyond: content without direction or scale above the pixel, on which the
// noise of a pattern is the same everywhere and its radial spectrum means something.
// The disks: noise_disks.h.
#include <cmath>
#include <string>

#include "core/error.h"
#include "testimages/disk_union.h"
#include "testimages/noise_disks.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

// Disks a pixel when no count is given, and their radii. Disks that keep apart have less power at low frequencies than
// independent ones, disks of some size less at high ones; here these nearly cancel: the exact image under a box has
// 1.05 times its mean power around 1/8 cycle per pixel and 0.93 times that beyond 1/2, in the corners of the spectrum.
// (0.3 a pixel of 0.15 to 0.35: 1.35 and 0.7.)
constexpr double kUsualDensity = 1.2;
constexpr double kUsualRadii[] = {0.2, 0.3};

constexpr Param kParams[] = {
    numbers("count", false, "1.2 a pixel", "disks, in the image and the 64 pixels around it that the field goes on"),
    numbers("radius", false, "[0.2, 0.3]", "in pixels, 1e-6 to 8: one number, or [smallest, largest]"),
    integer("seed", 1, 0, 0x1p53, "names the field")};

double whole(const Value& v, double most) {
  const double n = v.rank == 0 && v.numbers.size() == 1 ? v.numbers[0] : 0;
  if (!(n >= 1) || n != std::floor(n) || n > most) {
    throw Error(v.place, "\"count\" must be a whole number of disks, 1 to " + shortest(most));
  }
  return n;
}

NoiseDisks read(const Args& args, Grid grid) {
  NoiseDisks field{.min_radius = kUsualRadii[0],
                   .max_radius = kUsualRadii[1],
                   .seed = static_cast<std::uint64_t>(args.integer("seed"))};
  if (const Value* v = args.find("radius")) {
    if (v->rank > 1 || v->numbers.empty() || v->numbers.size() > 2) {
      throw Error(v->place, "\"radius\" must be one number or [smallest, largest], in pixels");
    }
    field.min_radius = v->numbers.front();
    field.max_radius = v->numbers.back();
    if (!(field.min_radius >= kMinFieldRadius && field.min_radius <= field.max_radius &&
          field.max_radius <= kMaxFieldRadius)) {
      throw Error(v->place, "\"radius\" is " + shortest(field.min_radius) + " to " + shortest(field.max_radius) +
                                "; give " + shortest(kMinFieldRadius) +
                                " <= smallest <= largest <= " + shortest(kMaxFieldRadius) + " pixels");
    }
  }
  const Value* count = args.find("count");
  field.count = static_cast<std::int64_t>(count != nullptr ? whole(*count, static_cast<double>(kMaxFieldDisks))
                                                           : std::round(kUsualDensity * field_area(grid)));
  return field;
}

class NoiseField {
 public:
  NoiseField(const Args& args, Grid grid)
      : field_(read(args, grid)), disks_(make_noise_disks(field_, grid, place_of_count(args))) {}

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept {
    disks_.contains(run, x, y, inside);
  }
  Cover cover(Pixel origin, Rect r) const noexcept { return disks_.cover(origin, r); }
  bool strips(Pixel origin, std::span<const double> sides, Strips out) const noexcept {
    return disks_.strips(origin, sides, out);
  }
  void boundary(Pixel origin, double half_width, Boundary& out) const { disks_.boundary(origin, half_width, out); }

  // With the image's size these are all there is to know: the law of noise_disks.h makes the disks from them.
  StoredDoubles stored() const {
    return {{"count", {static_cast<double>(field_.count)}},
            {"radius", {field_.min_radius, field_.max_radius}},
            {"seed", {static_cast<double>(field_.seed)}}};
  }

 private:
  static std::string place_of_count(const Args& args) {
    const Value* count = args.find("count");
    return count != nullptr ? count->place : args.place();
  }

  NoiseDisks field_;
  DiskUnion disks_;
};

}  // namespace

extern constinit const TestImageInfo noise_field_testimage;
constinit const TestImageInfo noise_field_testimage =
    describe<NoiseField>({.name = "noise-field",
                          .title = "Random small disks",
                          .cite = "after Widom, \"Random sequential addition of hard spheres to a volume\", 1966",
                          .params = kParams});

}  // namespace moire
