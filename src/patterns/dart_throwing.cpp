// Dart-throwing: uniform random candidates on the unit torus, each kept if no kept point is nearer than r.
// R. L. Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986; D. P. Mitchell, "Generating antialiased
// images at low sampling densities", SIGGRAPH 1987.
//
// Both leave r open. Here it starts at the largest distance that N points on the torus could all have, that of the
// hexagonal lattice, sqrt(2 / (sqrt(3) N)) (A. Lagae and P. Dutre, "A comparison of methods for generating Poisson disk
// distributions", Computer Graphics Forum 27(1), 2008), and shrinks by 1% after k misses in a row (after M. McCool and
// E. Fiume, "Hierarchical Poisson disk sampling distributions", Graphics Interface 1992), until N points are kept.
//
// ms per set with k = 5000, g++ 12 -O3 (every candidate thrown, in the same run): n = 16: 0.09 (1.5), 256: 0.52 (4.1),
// 1600: 2.2 (13), 4096: 6.0 (30).
#include <fmt/format.h>

#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "patterns/area.h"
#include "patterns/dart_process.h"
#include "patterns/pattern.h"
#include "patterns/placed_grid.h"
#include "patterns/point_grid.h"
#include "patterns/torus.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    integer("k", 5000, 1, 1e6, "misses in a row after which the radius shrinks by 1%"),
    integer("bank", 64, 0, 4096,
            "sets per seed and trial, of which a pixel takes one, shifted on the torus; 0 makes a "
            "new set in every pixel")};

// Most points that the sets of a bank may have together: 2^24, which is 256 MiB, and as much again where they are
// sorted into cells.
constexpr std::int64_t kMaxBankPoints = std::int64_t{1} << 24;

// Most boxes to a side of the torus: 12 MiB for each thread, 768 MiB for an area.
constexpr int kMostBoxes = 2048, kMostAreaBoxes = 16384;

double first_radius(int n) { return std::sqrt(2 / (std::sqrt(3.0) * n)); }

// Working memory for making sets, so that fill() never allocates: one piece for each thread that may ask at a time.
// Who finds none free waits for one.
class Workshop {
 public:
  Workshop(int n, int pieces) {
    pieces_.reserve(static_cast<std::size_t>(pieces));
    for (int i = 0; i < pieces; ++i) {
      pieces_.emplace_back(n, first_radius(n), 1.0, 1.0, kMostBoxes);
      free_.push_back(&pieces_.back());
    }
  }

  template <class Use>
  void borrow(const Use& use) {
    std::unique_lock lock(mutex_);
    returned_.wait(lock, [&] { return !free_.empty(); });
    DartProcess::Memory* const piece = free_.back();
    free_.pop_back();
    lock.unlock();
    use(*piece);
    lock.lock();
    free_.push_back(piece);
    lock.unlock();
    returned_.notify_one();
  }

 private:
  std::vector<DartProcess::Memory> pieces_;
  std::vector<DartProcess::Memory*> free_;  // never grows beyond its first size: no allocation in borrow()
  std::mutex mutex_;
  std::condition_variable returned_;
};

// Sets of the bank are made when a pixel first takes them.
class DartThrowing {
 public:
  DartThrowing(const Args& args, int n, Draw draw)
      : n_(n),
        k_(args.integer("k")),
        bank_(args.integer("bank")),
        draw_(draw_hash(draw.seed, draw.trial)),
        made_(std::make_unique<std::once_flag[]>(static_cast<std::size_t>(bank_))),
        workshop_(n, std::max(1, thread_count())) {
    if (bank_ * n > kMaxBankPoints)
      throw Error(args.place(),
                  fmt::format("pattern \"dart-throwing\" cannot keep a bank of {} sets of {} points; bank times points "
                              "is at most {}, so here bank={} or less, but not 0, which keeps none",
                              bank_, n, kMaxBankPoints, kMaxBankPoints / n));
    bank_points_ = std::make_unique_for_overwrite<double[]>(2 * static_cast<std::size_t>(bank_ * n));
    if (n < kLeastForCells) return;
    sorted_ = std::make_unique<std::once_flag[]>(static_cast<std::size_t>(bank_));
    grids_.reserve(static_cast<std::size_t>(bank_));
    for (std::int64_t s = 0; s < bank_; ++s) grids_.emplace_back(static_cast<std::size_t>(n));
  }

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    double *x = out.x.data(), *y = out.y.data();
    for (const Pixel& pixel : run) {
      const Key key = pixel_key(draw_, pixel);
      if (bank_ == 0) {
        make_set(key, Axis::dart, x, y);
      } else {
        const Set set = from_bank(pick(key));
        const Words w = hash(key, 0, Axis::shift);
        shift_into(set.x, unit(w.a, w.b), x);
        shift_into(set.y, unit(w.c, w.d), y);
      }
      x += n_;
      y += n_;
    }
  }

  // See HasCells (pattern.h). Sets that are made anew in each pixel have none.
  static constexpr int kLeastForCells = kLeastPlacedCells;
  CellGrid cells(Pixel pixel) const noexcept { return grids_.empty() ? CellGrid{} : shifted(pixel).cells(); }
  CellPoints take_cells(Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept {
    return shifted(pixel).take(counted, filled, out);
  }

  static constexpr auto area_count = any_area_count;
  // One set on the torus of the area, distances in pixels.
  static void fill_area(const Args& args, Grid area, Draw d, Points out) {
    const auto n = static_cast<int>(out.x.size());
    const double r = first_radius(n) * std::sqrt(static_cast<double>(area.width) * area.height);
    DartProcess::Memory memory(n, r, area.width, area.height, kMostAreaBoxes);
    const Key key = pixel_key(draw_hash(d.seed, d.trial), {});
    DartProcess(key, Axis::area, args.integer("k"), memory, out.x.data(), out.y.data()).run(n);
  }

  void fill_set(Points out) const noexcept { make_set(pixel_key(draw_, {}), Axis::set, out.x.data(), out.y.data()); }

 private:
  void make_set(const Key& key, Axis axis, double* x, double* y) const noexcept {
    workshop_.borrow([&](DartProcess::Memory& memory) { DartProcess(key, axis, k_, memory, x, y).run(n_); });
  }

  struct Set {
    std::span<const double> x, y;
  };

  // Which set of the bank a pixel takes: all have the same probability to 2^-32.
  std::size_t pick(const Key& key) const noexcept {
    const Words random = hash(key, 0, Axis::pick);
    return static_cast<std::size_t>((std::uint64_t{random.a} * static_cast<std::uint64_t>(bank_)) >> 32);
  }

  Set from_bank(std::size_t s) const noexcept {
    const auto n = static_cast<std::size_t>(n_);
    double* const x = bank_points_.get() + 2 * s * n;
    std::call_once(made_[s], [&] {
      make_set(pixel_key(draw_, {static_cast<std::int64_t>(s), 0}), Axis::bank, x, x + n);
    });
    return {{x, n}, {x + n, n}};
  }

  ShiftedGrid shifted(Pixel pixel) const noexcept {
    const Key key = pixel_key(draw_, pixel);
    const std::size_t s = pick(key);
    std::call_once(sorted_[s], [&] {
      const Set set = from_bank(s);
      grids_[s].sort(set.x, set.y);
    });
    const Words w = hash(key, 0, Axis::shift);
    return {grids_[s], unit(w.a, w.b), unit(w.c, w.d)};
  }

  int n_;
  std::int64_t k_, bank_;
  std::uint64_t draw_;
  std::unique_ptr<std::once_flag[]> made_;    // one per set
  std::unique_ptr<double[]> bank_points_;     // 2 n per set, untouched until the set is made
  std::unique_ptr<std::once_flag[]> sorted_;  // one per set, where there are grids
  mutable std::vector<PointGrid> grids_;      // likewise; written once, behind the flag
  mutable Workshop workshop_;
};

}  // namespace

extern const PatternInfo dart_throwing_pattern;
constinit const PatternInfo dart_throwing_pattern =
    describe<DartThrowing>({.name = "dart-throwing",
                            .title = "Random points kept apart by a shrinking distance",
                            .cite = "Cook 1986; Mitchell 1987; Lagae and Dutre 2008",
                            .varies = [](const Args&) { return Varies::by_trial; },
                            .counts = any_count,
                            .params = kParams});

}  // namespace moire
