// Where a dart may still land: the torus cut into boxes, and a list of those that no single kept point covers.
//
// Every box knows how near a point is that covers it whole. A list holds for one radius: all boxes that are open there
// or were when it was made. As the radius shrinks, boxes open again, and the list grows by those alone. After K. B.
// White, D. Cline and P. K. Egbert, "Poisson disk point sets by hierarchical dart throwing", IEEE Symposium on
// Interactive Ray Tracing 2007, and M. S. Ebeida, S. A. Mitchell, A. Patney, A. A. Davidson and J. D. Owens, "A simple
// algorithm for maximal Poisson-disk sampling in high dimensions", Computer Graphics Forum 31(2), 2012: lists of the
// squares that may still be hit, here of one size.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

namespace moire {

class DartBoxes {
 private:
  static constexpr int kPerRadius = 10;  // boxes to the first radius; no point covers one that is farther away

  struct Side {
    double length;  // of the torus
    int boxes;
    double per_unit, box;          // boxes to a unit and their length
    double box_in_r0, half_in_r0;  // in first radii
    Side(double l, double r0, int most_boxes)
        : length(l),
          boxes(static_cast<int>(std::clamp(kPerRadius * l / r0, 1.0, static_cast<double>(most_boxes)))),
          per_unit(boxes / l),
          box(l / boxes),
          box_in_r0(box / r0),
          half_in_r0(0.5 * box_in_r0) {}
  };

 public:
  struct Box {
    std::int32_t x, y;  // column and row
  };

  // Working memory for the boxes of a torus of width x height whose radius starts at r0 and never grows. Not
  // initialised, so that it costs nothing before it is used: at most 3 bytes times most_boxes^2.
  class Memory {
   public:
    Memory(double r0, double width, double height, int most_boxes)
        : r0_(r0),
          across_(width, r0, most_boxes),
          down_(height, r0, most_boxes),
          boxes_(static_cast<std::size_t>(across_.boxes) * static_cast<std::size_t>(down_.boxes)),
          room_(boxes_ / 4 + kPart),
          reach2_(std::make_unique_for_overwrite<std::uint8_t[]>(boxes_)),
          list_(std::make_unique_for_overwrite<Box[]>(room_)) {}

   private:
    friend class DartBoxes;
    double r0_;
    Side across_, down_;
    std::size_t boxes_, room_;
    std::unique_ptr<std::uint8_t[]> reach2_;
    std::unique_ptr<Box[]> list_;
  };

  // All boxes open, none listed.
  explicit DartBoxes(Memory& memory) noexcept
      : r0_(memory.r0_),
        across_(memory.across_),
        down_(memory.down_),
        boxes_(memory.boxes_),
        room_(memory.room_),
        reach2_(memory.reach2_.get()),
        list_(memory.list_.get()) {
    std::fill_n(reach2_, boxes_, kOpen);
    set_radius(r0_);
  }

  // All boxes, and those listed.
  std::size_t size() const noexcept { return boxes_; }
  std::size_t listed() const noexcept { return listed_; }

  // The radius that covered() is about.
  void set_radius(double r) noexcept { limit_ = limit(r); }

  // Whether some kept point is nearer than the radius to all points of the box. False never harms.
  bool covered(Box box) const noexcept { return reach2_[at(box)] < limit_; }
  Box box_of(double x, double y) const noexcept { return {part(x, across_), part(y, down_)}; }

  // The point at (u, v) of the box, both in [0, 1]; at the far end of the torus it may round to the torus's length.
  double x(Box box, double u) const noexcept { return (box.x + u) * across_.box; }
  double y(Box box, double v) const noexcept { return (box.y + v) * down_.box; }

  // Makes the list anew, of all boxes that are open at some radius >= r. False: too many, and there is no list.
  bool list(double r) noexcept {
    listed_ = 0;
    const int from = limit(r);
    list_limit_ = from;
    return append(from, kOpen);
  }
  // Makes a list hold for radii >= r, too, and drops what is covered for good.
  bool extend(double r) noexcept {
    std::size_t open = 0;
    for (std::size_t i = 0; i < listed_; ++i) {
      const Box box = list_[i];
      list_[open] = box;
      open += reach2_[at(box)] >= list_limit_;
    }
    listed_ = open;
    const int to = list_limit_ - 1;
    list_limit_ = std::min(list_limit_, int{limit(r)});
    return append(list_limit_, to);
  }
  Box listed_box(std::size_t i) const noexcept { return list_[i]; }
  // Drops box i of the list if it is covered at all radii for which the list holds; the last one takes its place.
  void drop_if_covered(std::size_t i) noexcept {
    if (reach2_[at(list_[i])] < list_limit_) list_[i] = list_[--listed_];
  }

  // Adds a point; r is the radius or more.
  void keep(double x, double y, double r) noexcept {
    const int right = reach(r, across_), below = reach(r, down_);
    const int column = part(x, across_), row = part(y, down_);
    std::array<std::uint8_t, 2 * kPerRadius + 3> columns;
    const int width = 2 * right + 1;
    for (int i = 0; i < width; ++i) columns[static_cast<std::size_t>(i)] = far2(x, column - right + i, across_);
    const int first = wrapped(column - right, across_.boxes), unwrapped = std::min(width, across_.boxes - first);
    for (int j = row - below; j <= row + below; ++j) {
      const std::uint8_t dy2 = far2(y, j, down_);
      std::uint8_t* const boxes = reach2_ + static_cast<std::size_t>(wrapped(j, down_.boxes)) * columns_in_row();
      lower(boxes + first, columns.data(), unwrapped, dy2);
      lower(boxes, columns.data() + unwrapped, width - unwrapped, dy2);
    }
  }

 private:
  // Squared distances in units of r0^2 / 254, rounded up; 255 is more than any radius.
  static constexpr std::uint8_t kOpen = 255;
  static constexpr int kRun = 64, kPart = 16;  // boxes that append() skips at once

  // Squared distances below it are below r^2.
  std::uint8_t limit(double r) const noexcept {
    const double relative = r / r0_;
    return static_cast<std::uint8_t>(254 * (relative * relative));
  }
  std::size_t columns_in_row() const noexcept { return static_cast<std::size_t>(across_.boxes); }
  std::size_t at(Box box) const noexcept {
    return static_cast<std::size_t>(box.x) + columns_in_row() * static_cast<std::size_t>(box.y);
  }
  // x < length, but the product may round up to the number of boxes.
  static int part(double x, const Side& side) noexcept {
    return std::min(static_cast<int>(x * side.per_unit), side.boxes - 1);
  }
  static int wrapped(int i, int side) noexcept { return i < 0 ? i + side : i >= side ? i - side : i; }
  static int reach(double r, const Side& side) noexcept {
    return std::min({static_cast<int>(r * side.per_unit), (side.boxes - 1) / 2, kPerRadius + 1});
  }

  // The square of the distance from x to the far side of box i, which may lie beyond the ends of the torus. 2^-20 more
  // than that, relative, stands above all rounding here, in distances between points and in finding a point's box.
  static std::uint8_t far2(double x, int i, const Side& side) noexcept {
    const double far = std::abs(x * side.per_unit - (i + 0.5)) * side.box_in_r0 + side.half_in_r0;
    return static_cast<std::uint8_t>(std::min(254 * (1 + 0x1p-20) * (far * far) + 1, 255.0));
  }
  // reach2[i] = min(reach2[i], dx2[i] + dy2), sums above 255 being 255.
  static void lower(std::uint8_t* __restrict reach2, const std::uint8_t* __restrict dx2, int n,
                    std::uint8_t dy2) noexcept {
    const auto rest = static_cast<std::uint8_t>(kOpen - dy2);
    for (int i = 0; i < n; ++i)
      reach2[i] = std::min(reach2[i], static_cast<std::uint8_t>(std::min(dx2[i], rest) + dy2));
  }

  // least <= reach2 <= least + span
  static bool within(std::uint8_t reach2, std::uint8_t least, std::uint8_t span) noexcept {
    return static_cast<std::uint8_t>(reach2 - least) <= span;
  }
  // Whether that is so for one of n boxes: bytes that are looked at as words, for compilers do no better with a sum.
  template <std::size_t n>
  static bool any_within(const std::uint8_t* reach2, std::uint8_t least, std::uint8_t span) noexcept {
    std::array<std::uint8_t, n> found;
    for (std::size_t i = 0; i < n; ++i) found[i] = within(reach2[i], least, span) ? 255 : 0;
    std::uint64_t any = 0;
    for (const std::uint64_t word : std::bit_cast<std::array<std::uint64_t, n / 8>>(found)) any |= word;
    return any != 0;
  }

  // Lists all boxes with from <= reach2 <= to. Few are, so whole runs without one are passed over.
  bool append(int from, int to) noexcept {
    if (to < from) return true;
    const auto least = static_cast<std::uint8_t>(from), span = static_cast<std::uint8_t>(to - from);
    const std::uint8_t* row = reach2_;
    for (int y = 0; y < down_.boxes; ++y, row += across_.boxes)
      for (int run = 0; run < across_.boxes; run += kRun) {
        const int run_end = std::min(run + kRun, across_.boxes);
        if (run_end == run + kRun && !any_within<kRun>(row + run, least, span)) continue;
        for (int part = run; part < run_end; part += kPart) {
          const int part_end = std::min(part + kPart, run_end);
          if (part_end == part + kPart && !any_within<kPart>(row + part, least, span)) continue;
          if (listed_ + kPart > room_) return false;
          for (int x = part; x < part_end; ++x) {
            list_[listed_] = {x, y};
            listed_ += within(row[x], least, span);
          }
        }
      }
    return true;
  }

  double r0_;
  Side across_, down_;
  std::size_t boxes_, room_, listed_ = 0;
  std::uint8_t* reach2_;  // per box: all of it is nearer than that to a kept point
  Box* list_;
  int list_limit_ = 0;      // boxes of the list with less are covered wherever the list holds
  std::uint8_t limit_ = 0;  // the same at the radius
};

}  // namespace moire
