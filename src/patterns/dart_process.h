// The process of dart-throwing, sampled without most of its misses.
//
// Plainly: candidates uniform on the torus, each kept if no kept point is nearer than r; after k misses in a row r
// shrinks by 1%. Here candidates fall only into boxes that no kept point covers whole, which have the share p of the
// area. Of candidates on the whole torus, the number that miss those boxes before one does not is geometric: it is
// drawn and counted as so many misses. The law of points, radii and misses is that of the plain process, to 52 bits.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "core/geometry.h"
#include "core/hash.h"
#include "patterns/dart_board.h"
#include "patterns/dart_boxes.h"
#include "patterns/geometric.h"
#include "patterns/uniform.h"

namespace moire {

class DartProcess {
 public:
  // Working memory for n points on a torus of width x height, first radius r0; at most 3 most_boxes^2 + 29 n bytes,
  // untouched before they are used.
  struct Memory {
    DartBoard::Memory board;
    DartBoxes::Memory boxes;
    double width, height, r0;
    Memory(int n, double r, double w, double h, int most_boxes)
        : board(n, r, w, h), boxes(r, w, h, most_boxes), width(w), height(h), r0(r) {}
  };

  // Candidate c of a set takes its place from number 2 c of (key, axis), and its box and the misses before it from
  // number 2 c + 1.
  DartProcess(const Key& key, Axis axis, std::int64_t k, Memory& memory, double* x, double* y) noexcept
      : key_(key),
        axis_(axis),
        k_(k),
        board_(memory.board),
        boxes_(memory.boxes),
        last_x_(std::nextafter(memory.width, 0.0)),
        last_y_(std::nextafter(memory.height, 0.0)),
        width_(memory.width),
        height_(memory.height),
        r_(memory.r0),
        patience_(boxes_.size() / kBoxesPerTest + kBlock),
        x_(x),
        y_(y) {}

  // Writes n points and returns the radius at the end.
  double run(int n) noexcept {
    while (board_.kept() < n) has_list_ ? throw_at_list(n) : throw_anywhere(n);
    return r_;
  }

 private:
  static constexpr int kBlock = 64;
  // About so many boxes are looked at for a list in the time of one candidate.
  static constexpr std::size_t kBoxesPerTest = 64;
  static constexpr int kMostAhead = 64;

  void throw_anywhere(int n) noexcept {
    draw_places();
    for (int c = 0; c < kBlock && board_.kept() < n; ++c) {
      const double x = std::min(u_[at(c)] * width_, last_x_), y = std::min(v_[at(c)] * height_, last_y_);
      if (boxes_.covered(boxes_.box_of(x, y)) || board_.too_near(x, y, r_)) {
        miss(1);
      } else {
        keep(x, y);
      }
    }
    next_ += kBlock;
    if (wasted_ > patience_) make_list();
  }

  void throw_at_list(int n) noexcept {
    assert(ahead_left_ >= 0);
    draw_places();
    const std::size_t listed = boxes_.listed();
    draw_boxes(listed);
    for (int c = 0; c < kBlock && board_.kept() < n; ++c) {
      if (misses_ + skipped_[at(c)] >= k_) {
        miss(k_ - misses_);
      } else {
        misses_ += skipped_[at(c)];
        try_box(pick_[at(c)], u_[at(c)], v_[at(c)]);
      }
      // The rest of the block was drawn for the list as it was.
      if (ahead_left_ < 0) {
        make_list();
        break;
      }
    }
    next_ += kBlock;
  }

  // Boxes that were dropped since the block was drawn stand behind the list's end, as far as a draw can tell.
  void try_box(std::size_t i, double u, double v) noexcept {
    if (i >= boxes_.listed()) return miss(1);
    const DartBoxes::Box box = boxes_.listed_box(i);
    if (boxes_.covered(box)) {
      boxes_.drop_if_covered(i);
      return miss(1);
    }
    const double x = std::min(boxes_.x(box, u), last_x_), y = std::min(boxes_.y(box, v), last_y_);
    board_.too_near(x, y, r_) ? miss(1) : keep(x, y);
  }

  void keep(double x, double y) noexcept {
    x_[board_.kept()] = x;
    y_[board_.kept()] = y;
    board_.keep(x, y);
    boxes_.keep(x, y, r_);
    misses_ = 0;
  }

  void miss(std::int64_t count) noexcept {
    ++wasted_;
    misses_ += count;
    if (misses_ < k_) return;
    misses_ = 0;
    r_ *= 0.99;
    boxes_.set_radius(r_);
    --ahead_left_;
  }

  // A list, and for how many shrinkings: for more where they follow each other so fast that lists cost more than
  // misses.
  void make_list() noexcept {
    ahead_ = wasted_ < patience_ / 16 ? std::min(2 * ahead_, kMostAhead) : std::max(1, ahead_ / 2);
    double r = r_;
    for (int i = 0; i < ahead_; ++i) r *= 0.99;
    has_list_ = has_list_ ? boxes_.extend(r) : boxes_.list(r);
    if (!has_list_) ahead_ = 1;
    ahead_left_ = ahead_;
    wasted_ = 0;
  }

  void draw_places() noexcept {
    for (int c = 0; c < kBlock; ++c) {
      const Words w = words(c, 0);
      u_[at(c)] = unit(w.a, w.b);
      v_[at(c)] = unit(w.c, w.d);
    }
  }

  // Boxes of the list, and for each the misses before it, k or more being k.
  void draw_boxes(std::size_t listed) noexcept {
    const double rate = miss_rate(listed, boxes_.size()), most = static_cast<double>(k_);
    std::array<double, kBlock> before;
    for (int c = 0; c < kBlock; ++c) {
      const Words w = words(c, 1);
      pick_[at(c)] = static_cast<std::size_t>(uniform_below(w.a, w.b, static_cast<std::uint32_t>(listed)));
      before[at(c)] = minus_log(1 - unit(w.c, w.d));
    }
    // Without any box in the list rate is 0 and all candidates miss.
    for (int c = 0; c < kBlock; ++c)
      skipped_[at(c)] = before[at(c)] < most * rate ? static_cast<std::int64_t>(before[at(c)] / rate) : k_;
  }

  static std::size_t at(int c) noexcept { return static_cast<std::size_t>(c); }
  Words words(int c, std::uint64_t which) const noexcept {
    const std::uint64_t number = 2 * (next_ + static_cast<std::uint64_t>(c)) + which;
    return hash(key_, static_cast<std::uint32_t>(number), axis_, static_cast<std::uint32_t>(number >> 32));
  }

  Key key_;
  Axis axis_;
  std::int64_t k_;
  DartBoard board_;
  DartBoxes boxes_;
  double last_x_, last_y_, width_, height_;
  double r_;
  std::int64_t misses_ = 0;  // in a row
  std::uint64_t next_ = 0;   // candidate
  bool has_list_ = false;
  int ahead_ = 1, ahead_left_ = 0;  // shrinkings for which a list is made, and for which it still holds
  std::size_t patience_, wasted_ = 0;
  std::array<double, kBlock> u_, v_;
  std::array<std::size_t, kBlock> pick_;
  std::array<std::int64_t, kBlock> skipped_;
  double *x_, *y_;
};

}  // namespace moire
