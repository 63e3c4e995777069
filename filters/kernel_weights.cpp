// Weights of many samples at once: what rendering with any filter but a box spends its time on.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/instruction_sets.h"
#include "core/lanes.h"
#include "filters/kernel_pieces.h"

namespace moire {

namespace {

// Points on pieces from `begin` to `last` or outside the support, eight at a time: their recurrences overlap.
void weights_apart(const KernelPieces& kernel, std::span<const double> x, std::span<double> out, int begin,
                   int last) noexcept {
  constexpr std::size_t kTogether = 8;
  const auto knots = kernel.knots;
  const auto inner = knots.begin() + begin + 1, end = knots.begin() + last + 1;
  for (std::size_t first = 0; first < x.size(); first += kTogether) {
    const std::size_t n = std::min(kTogether, x.size() - first);
    const double* at = x.data() + first;
    const double* c[kTogether];
    double t[kTogether], b1[kTogether] = {}, b2[kTogether] = {};
    for (std::size_t i = 0; i < n; ++i) {
      const SeriesPiece& piece =
          kernel.pieces[static_cast<std::size_t>(std::upper_bound(inner, end, at[i]) - inner + begin)];
      c[i] = kernel.coefficients + piece.k_first;
      t[i] = (at[i] - piece.mid) * piece.inverse_half;
    }
    for (int j = kernel.degree; j >= 1; --j) {
      for (std::size_t i = 0; i < n; ++i) {
        const double b = c[i][j] + ((t[i] + t[i]) * b1[i] - b2[i]);
        b2[i] = b1[i];
        b1[i] = b;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double k = c[i][0] + (t[i] * b1[i] - b2[i]);
      out[first + i] = at[i] >= knots.front() && at[i] < knots.back() ? k : 0.0;
    }
  }
}

struct KernelWeights {
  using Loop = void (*)(const KernelPieces&, std::span<const double>, std::span<double>) noexcept;

  static constexpr std::size_t kVectors = 4;  // evaluated together: their recurrences do not wait for each other

  // The smallest and the largest; of nothing, a range of nothing.
  [[gnu::always_inline]] static inline std::pair<double, double> range(std::span<const double> x) noexcept {
    Lanes low = Lanes{} + HUGE_VAL, high = -low, at;
    std::size_t i = 0;
    for (; i + kLanes <= x.size(); i += kLanes) {
      load(x.data() + i, at);
      low = at < low ? at : low;
      high = at > high ? at : high;
    }
    double least[kLanes], most[kLanes];
    store(low, least);
    store(high, most);
    for (; i < x.size(); ++i) {
      least[0] = std::min(least[0], x[i]);
      most[0] = std::max(most[0], x[i]);
    }
    return {*std::min_element(least, least + kLanes), *std::max_element(most, most + kLanes)};
  }

  // out[i] = k(x[i]) for `Vectors` vectors, where pieces from `begin` to `last` are evaluated for all: every lane does
  // what evaluate() does.
  template <std::size_t Vectors>
  [[gnu::always_inline]] static inline void block(const KernelPieces& kernel, const double* x, double* out, int begin,
                                                  int last) noexcept {
    Lanes places[Vectors], values[Vectors] = {};
    for (std::size_t v = 0; v < Vectors; ++v) load(x + v * kLanes, places[v]);
    for (int p = begin; p <= last; ++p) {
      const SeriesPiece& piece = kernel.pieces[static_cast<std::size_t>(p)];
      const double left = kernel.knots[static_cast<std::size_t>(p)],
                   right = kernel.knots[static_cast<std::size_t>(p) + 1];
      const double* c = kernel.coefficients + piece.k_first;
      Lanes t[Vectors], b1[Vectors] = {}, b2[Vectors] = {};
      for (std::size_t v = 0; v < Vectors; ++v) t[v] = (places[v] - piece.mid) * piece.inverse_half;
      for (int j = kernel.degree; j >= 1; --j) {
        for (std::size_t v = 0; v < Vectors; ++v) {
          const Lanes b = c[j] + ((t[v] + t[v]) * b1[v] - b2[v]);
          b2[v] = b1[v];
          b1[v] = b;
        }
      }
      for (std::size_t v = 0; v < Vectors; ++v) {
        const Lanes k = c[0] + (t[v] * b1[v] - b2[v]);
        values[v] = ((places[v] >= left) & (places[v] < right)) ? k : values[v];
      }
    }
    for (std::size_t v = 0; v < Vectors; ++v) store(values[v], out + v * kLanes);
  }

  // Where all samples are close together, the pieces between them are evaluated for all; else each has a piece of its
  // own.
  [[gnu::always_inline]] static inline void loop(const KernelPieces& kernel, std::span<const double> x,
                                                 std::span<double> out) noexcept {
    constexpr int kFewPieces = 4;
    const auto [low, high] = range(x);
    const int begin = std::max(piece_of(kernel.knots, low), 0),
              last = std::min(piece_of(kernel.knots, high), static_cast<int>(kernel.pieces.size()) - 1);
    if (last - begin >= kFewPieces) return weights_apart(kernel, x, out, begin, last);
    std::size_t first = 0;
    for (; first + kVectors * kLanes <= x.size(); first += kVectors * kLanes) {
      block<kVectors>(kernel, x.data() + first, out.data() + first, begin, last);
    }
    for (; first + kLanes <= x.size(); first += kLanes) {
      block<1>(kernel, x.data() + first, out.data() + first, begin, last);
    }
    if (first == x.size()) return;
    double padded[kLanes];  // the rest, filled up with its last
    const std::size_t n = x.size() - first;
    std::copy_n(x.data() + first, n, padded);
    std::fill(padded + n, padded + kLanes, x.back());
    block<1>(kernel, padded, padded, begin, last);
    std::copy_n(padded, n, out.data() + first);
  }

  static void plain(const KernelPieces& kernel, std::span<const double> x, std::span<double> out) noexcept {
    loop(kernel, x, out);
  }
#if MOIRE_HAS_AVX
  [[MOIRE_AVX2]] static void avx2(const KernelPieces& kernel, std::span<const double> x,
                                  std::span<double> out) noexcept {
    loop(kernel, x, out);
  }
  [[MOIRE_AVX512]] static void avx512(const KernelPieces& kernel, std::span<const double> x,
                                      std::span<double> out) noexcept {
    loop(kernel, x, out);
  }
  static constexpr Loop kLoops[] = {plain, avx2, avx512};
#else
  static constexpr Loop kLoops[] = {plain};
#endif
};

}  // namespace

void weights_of(const KernelPieces& kernel, std::span<const double> x, std::span<double> out) noexcept {
  static const KernelWeights::Loop best = KernelWeights::kLoops[usable_sets() - 1];
  best(kernel, x, out);
}

}  // namespace moire
