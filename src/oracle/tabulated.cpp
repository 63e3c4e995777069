// Even kernels from a file of rows x,k: straight between rows, or the natural cubic spline of each stretch between
// jumps (de Boor, A Practical Guide to Splines, 1978, chapter IV), by second derivatives.
#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "oracle/shapes.h"

namespace moire::oracle {
namespace {

// Rows between two jumps, and the second derivatives of the curve through them; none of it outside.
struct Stretch {
  std::vector<long double> x, k, bend;

  void bend_naturally() {
    const std::size_t n = x.size();
    bend.assign(n, 0);
    if (n < 3) return;
    // h0 b0 + 2 (h0 + h1) b1 + h1 b2 = 6 (slope1 - slope0) at inner rows; bend 0 at the ends.
    std::vector<long double> diagonal(n, 1);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const long double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
      diagonal[i] = 2 * (h0 + h1);
      bend[i] = 6 * ((k[i + 1] - k[i]) / h1 - (k[i] - k[i - 1]) / h0);
      if (i > 1) {
        bend[i] -= bend[i - 1] * h0 / diagonal[i - 1];
        diagonal[i] -= h0 * h0 / diagonal[i - 1];
      }
    }
    for (std::size_t i = n - 2; i > 0; --i) bend[i] = (bend[i] - (x[i + 1] - x[i]) * bend[i + 1]) / diagonal[i];
  }

  long double at(long double p) const {
    const auto right = std::clamp<std::ptrdiff_t>(std::upper_bound(x.begin(), x.end(), p) - x.begin(), 1,
                                                  static_cast<std::ptrdiff_t>(x.size()) - 1);
    const auto j = static_cast<std::size_t>(right), i = j - 1;
    const long double h = x[j] - x[i], t = (p - x[i]) / h, s = 1 - t;
    return k[i] * s + k[j] * t + h * h / 6 * (bend[i] * (s * s - 1) * s + bend[j] * (t * t - 1) * t);
  }
};

}  // namespace

HalfKernel tabulated(const std::string& path, bool cubic) {
  std::vector<long double> x, k;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t comma = line.find(',');
    double a = 0, b = 0;
    if (comma == std::string::npos || !parse_number(line.substr(0, comma), a) ||
        !parse_number(line.substr(comma + 1), b))
      throw std::invalid_argument("the oracle reads rows x,k only: " + line);
    x.push_back(static_cast<long double>(a));
    k.push_back(static_cast<long double>(b));
  }
  if (x.size() < 2 || x.front() != 0) throw std::invalid_argument("the oracle reads halves of even kernels only");
  HalfKernel half{{x.front()}, {}, cubic ? 3 : 1};
  for (const long double at : x)
    if (at > half.breaks.back()) half.breaks.push_back(at);
  // The left half before it; the row at 0 is there once.
  for (std::size_t i = 0, n = x.size(); i + 1 < n; ++i) {
    x.insert(x.begin(), -x[2 * i + 1]);
    k.insert(k.begin(), k[2 * i + 1]);
  }
  std::vector<Stretch> stretches(1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i > 0 && x[i] == x[i - 1]) stretches.emplace_back();
    stretches.back().x.push_back(x[i]);
    stretches.back().k.push_back(k[i]);
  }
  for (Stretch& s : stretches) {
    s.bend.assign(s.x.size(), 0);
    if (cubic) s.bend_naturally();
  }
  half.shape = [stretches](long double p) {
    for (const Stretch& s : stretches)
      if (p < s.x.back() || &s == &stretches.back()) return s.at(p);
    return 0.0L;
  };
  return half;
}

}  // namespace moire::oracle
