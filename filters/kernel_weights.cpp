// Weights of many samples at once: what rendering with any filter but a box spends its time on.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/instruction_sets.h"
#include "core/lanes.h"
#include "filters/kernel.h"

namespace moire {

struct KernelWeights {
  using Loop = void (*)(const Kernel&, std::span<const double>, std::span<double>) noexcept;

  // The smallest and the largest; of nothing, a range of nothing.
  [[gnu::always_inline]] static inline std::pair<double, double> range(std::span<const double> x) noexcept {
    double low[kLanes], high[kLanes];  // four at a time, which do not wait for each other
    std::fill_n(low, kLanes, HUGE_VAL);
    std::fill_n(high, kLanes, -HUGE_VAL);
    for (std::size_t i = 0; i < x.size(); ++i) {
      low[i % kLanes] = std::min(low[i % kLanes], x[i]);
      high[i % kLanes] = std::max(high[i % kLanes], x[i]);
    }
    return {*std::min_element(low, low + kLanes), *std::max_element(high, high + kLanes)};
  }

  // Every lane does what evaluate() does. Where all samples are close together, the pieces between them are evaluated
  // for all; else each has a piece of its own.
  [[gnu::always_inline]] static inline void loop(const Kernel& kernel, std::span<const double> x,
                                                 std::span<double> out) noexcept {
    constexpr int kFewPieces = 4;
    const auto [low, high] = range(x);
    const int begin = std::max(kernel.piece_of(low), 0), last = std::min(kernel.piece_of(high), kernel.pieces() - 1);
    if (last - begin >= kFewPieces) return kernel.weights_apart(x, out, begin, last);
    for (std::size_t first = 0; first < x.size(); first += kLanes) {
      const std::size_t n = std::min(kLanes, x.size() - first);
      double padded[kLanes];
      const double* at = x.data() + first;
      if (n < kLanes) {
        for (std::size_t i = 0; i < kLanes; ++i) padded[i] = at[std::min(i, n - 1)];
        at = padded;
      }
      Lanes places, values = {};
      load(at, places);
      for (int p = begin; p <= last; ++p) {
        const Kernel::Piece& piece = kernel.pieces_[static_cast<std::size_t>(p)];
        const double left = kernel.knots_[static_cast<std::size_t>(p)],
                     right = kernel.knots_[static_cast<std::size_t>(p) + 1];
        const double* c = kernel.coefficients_.data() + piece.k_first;
        const Lanes t = (places - piece.mid) * piece.inverse_half, twice = t + t;
        Lanes b1 = {}, b2 = {};
        for (int j = kernel.degree_; j >= 1; --j) {
          const Lanes b = c[j] + (twice * b1 - b2);
          b2 = b1;
          b1 = b;
        }
        const Lanes k = c[0] + (t * b1 - b2);
        values = ((places >= left) & (places < right)) ? k : values;
      }
      if (n < kLanes) {
        store(values, padded);
        std::copy_n(padded, n, out.begin() + static_cast<std::ptrdiff_t>(first));
      } else {
        store(values, out.data() + first);
      }
    }
  }

  static void plain(const Kernel& kernel, std::span<const double> x, std::span<double> out) noexcept {
    loop(kernel, x, out);
  }
#if MOIRE_HAS_AVX
  [[MOIRE_AVX2]] static void avx2(const Kernel& kernel, std::span<const double> x, std::span<double> out) noexcept {
    loop(kernel, x, out);
  }
  [[MOIRE_AVX512]] static void avx512(const Kernel& kernel, std::span<const double> x, std::span<double> out) noexcept {
    loop(kernel, x, out);
  }
  static constexpr Loop kLoops[] = {plain, avx2, avx512};
#else
  static constexpr Loop kLoops[] = {plain};
#endif
};

void Kernel::weights(std::span<const double> x, std::span<double> out) const noexcept {
  static const KernelWeights::Loop best = KernelWeights::kLoops[usable_sets() - 1];
  best(*this, x, out);
}

// Points on pieces from `begin` to `last` or outside the support, eight at a time: their recurrences overlap.
void Kernel::weights_apart(std::span<const double> x, std::span<double> out, int begin, int last) const noexcept {
  constexpr std::size_t kTogether = 8;
  const auto inner = knots_.begin() + begin + 1, end = knots_.begin() + last + 1;
  for (std::size_t first = 0; first < x.size(); first += kTogether) {
    const std::size_t n = std::min(kTogether, x.size() - first);
    const double* at = x.data() + first;
    const double* c[kTogether];
    double t[kTogether], b1[kTogether] = {}, b2[kTogether] = {};
    for (std::size_t i = 0; i < n; ++i) {
      const Piece& piece = pieces_[static_cast<std::size_t>(std::upper_bound(inner, end, at[i]) - inner + begin)];
      c[i] = coefficients_.data() + piece.k_first;
      t[i] = (at[i] - piece.mid) * piece.inverse_half;
    }
    for (int j = degree_; j >= 1; --j) {
      for (std::size_t i = 0; i < n; ++i) {
        const double b = c[i][j] + ((t[i] + t[i]) * b1[i] - b2[i]);
        b2[i] = b1[i];
        b1[i] = b;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double k = c[i][0] + (t[i] * b1[i] - b2[i]);
      out[first + i] = at[i] >= knots_.front() && at[i] < knots_.back() ? k : 0.0;
    }
  }
}

}  // namespace moire
