// Point sets that hurt discrepancies: a few places, each of which may hold many points.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "measure/discrepancy/point_view.h"
#include "stress/chance.h"

namespace moire::stress {

// Place i holds count[i] >= 1 points. Sums over pairs of points are sums over pairs of places.
struct WeightedPoints {
  std::vector<double> x, y, t;  // in [0, 1)
  std::vector<std::uint64_t> count;

  std::size_t places() const { return x.size(); }
  std::uint64_t points() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t c : count) sum += c;
    return sum;
  }
};

// One entry per point, in random order.
struct PlainPoints {
  std::vector<double> x, y, t;
  PointView view(int dims) const { return {x, y, dims == 3 ? std::span<const double>(t) : std::span<const double>()}; }
};

inline PlainPoints spread(const WeightedPoints& w, Chance& chance) {
  std::vector<std::uint32_t> place;
  for (std::size_t i = 0; i < w.places(); ++i) place.insert(place.end(), w.count[i], static_cast<std::uint32_t>(i));
  for (std::size_t i = place.size() - 1; i > 0; --i) std::swap(place[i], place[chance.below(i + 1)]);
  PlainPoints p;
  for (const std::uint32_t i : place) {
    p.x.push_back(w.x[i]);
    p.y.push_back(w.y[i]);
    p.t.push_back(w.t[i]);
  }
  return p;
}

inline constexpr std::array<std::string_view, 7> kPointKinds = {"random",  "clustered", "collinear",   "coincident",
                                                                "borders", "grid",      "two clusters"};
inline constexpr double kLastBelowOne = 1 - 0x1p-53;

inline double into_unit(double v) { return std::clamp(v, 0.0, kLastBelowOne); }

// `most` places at most, of the kind of that number.
inline WeightedPoints hard_points(Chance& chance, std::size_t kind, std::uint64_t most) {
  WeightedPoints w;
  const auto add = [&](double x, double y, std::uint64_t count = 1) {
    w.x.push_back(into_unit(x));
    w.y.push_back(into_unit(y));
    w.t.push_back(kind == 4 ? w.y[chance.below(w.y.size())] : into_unit(chance.unit()));
    w.count.push_back(count);
  };
  const std::uint64_t n = 1 + chance.below(most);
  const auto border = [&] {
    constexpr double kBorders[] = {0, 0, kLastBelowOne, 0x1p-900, 0x1p-53, 0.5, 0.5 - 0x1p-54, 0.5 + 0x1p-53, 0.25};
    return chance.pick(kBorders);
  };
  const double spread = chance.decades(1e-17, 0.1), x0 = chance.unit(), y0 = chance.unit();
  switch (kind) {
    case 1:
      for (std::uint64_t i = 0; i < n; ++i)
        add(x0 + spread * chance.between(-1, 1), y0 + spread * chance.between(-1, 1));
      break;
    case 2: {
      // Exactly on a line, in whole multiples of 2^-20; or on one parallel to a side.
      const auto which = chance.below(4);
      for (std::uint64_t i = 0; i < n; ++i) {
        const double s = static_cast<double>(chance.below(1 << 18)) * 0x1p-20;
        if (which == 0) add(s, y0);
        if (which == 1) add(x0, s);
        if (which == 2) add(s, 3 * s);
        if (which == 3) add(s, 0.75 - s);
      }
      break;
    }
    case 3:
      for (std::uint64_t i = 0; i < std::min<std::uint64_t>(n, 4); ++i)
        add(chance.unit(), chance.unit(), 1 + chance.below(50));
      break;
    case 4:
      for (std::uint64_t i = 0; i < n; ++i) add(border(), chance.coin() ? border() : chance.unit());
      break;
    case 5: {
      const auto side = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(most)));
      const std::uint64_t m = 1 + chance.below(side);
      const double offset = chance.coin() ? 0.5 : 0;
      for (std::uint64_t i = 0; i < m * m; ++i) {
        add((static_cast<double>(i % m) + offset) / static_cast<double>(m),
            (static_cast<double>(i / m) + offset) / static_cast<double>(m));
      }
      break;
    }
    case 6:
      for (std::uint64_t i = 0; i < n; ++i) {
        const double side = i % 2 == 0 ? 0.2 : 0.8;
        add(side + spread * chance.unit(), side + spread * chance.unit(), 1 + chance.below(3));
      }
      break;
    default:
      for (std::uint64_t i = 0; i < n; ++i) add(chance.unit(), chance.unit());
  }
  return w;
}

// So many points on the whole, as many more in each place.
inline void multiply(WeightedPoints& w, std::uint64_t points) {
  const std::uint64_t factor = std::max<std::uint64_t>(1, points / w.points());
  for (std::uint64_t& c : w.count) c *= factor;
}

}  // namespace moire::stress
