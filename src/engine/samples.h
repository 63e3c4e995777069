// Where the samples of an image come from: a pattern in every pixel by itself, or one set over the whole image.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "patterns/area_points.h"
#include "patterns/pattern.h"

namespace moire {

enum class Layout : std::uint8_t {
  pixel,  // the pattern in every pixel
  image   // one set over the image and its apron, without regard to pixels
};

// Their names; throws Error naming the nearest ones.
std::span<const std::string_view> layout_names();
std::string_view name_of(Layout layout);
Layout find_layout(std::string_view name, std::string_view place);

// Samples of a stretch of pixels of one row: pixel x0 + i has those from first[i] to first[i + 1].
struct RowSamples {
  std::vector<std::size_t> first;
  std::vector<double> x, y;   // from the sample's pixel's corner
  std::vector<double> t;      // its time, in [0, 1), or empty where none is asked for
  std::vector<Pixel> pixels;  // of each sample, or of each pixel where all have as many
};

// A view of a pattern or of a set, which must outlive it.
class Samples {
 public:
  Samples(const Pattern& pattern) : source_(&pattern) {}   // NOLINT: a pattern is samples
  Samples(const AreaPoints& points) : source_(&points) {}  // NOLINT

  // The pattern, null for a set over the image.
  const Pattern* pattern() const noexcept {
    const auto* pattern = std::get_if<const Pattern*>(&source_);
    return pattern == nullptr ? nullptr : *pattern;
  }
  // Whether x and y are the same in every pixel.
  bool same_in_all_pixels() const noexcept;
  // Samples per pixel, on the average over the image and its apron.
  double density() const noexcept;
  // Samples of an image and its apron.
  std::int64_t total(Grid grid, int apron) const noexcept;
  // Samples of the pixels x0 <= x < x1 of row y.
  std::int64_t count(int x0, int x1, int y) const noexcept;
  // Whether samples have a time.
  bool has_time() const noexcept;
  // The samples themselves; what `out` held is replaced. `with_time` asks for t, too; precondition: has_time().
  void get(int x0, int x1, int y, RowSamples& out, bool with_time = false) const;

 private:
  std::variant<const Pattern*, const AreaPoints*> source_;
};

}  // namespace moire
