// A kernel that a user brings as a table in a file (kernel_file.h), straight or a natural cubic spline between its
// rows.
//
// De Boor, "A Practical Guide to Splines", 1978, chapter 4. The kernel need not be even; where it is not, a pixel is
// still the integral of the scene at p times k(p.x - c.x) k(p.y - c.y), c the pixel's centre.
#include <algorithm>
#include <span>

#include "core/dd_math.h"
#include "filters/filter.h"
#include "filters/kernel_file.h"

namespace moire {
namespace {

constexpr Param kParams[] = {path("path",
                                  "a CSV file of rows x,k: pixels from the centre, rising; weight; the right "
                                  "half alone is mirrored"),
                             choice("between", "linear", "linear|cubic",
                                    "rows are joined by straight lines, or by a natural cubic spline up to each jump")};

// Second derivatives at the rows of one stretch, 0 at both ends: a diagonally dominant tridiagonal system, by
// elimination.
std::vector<Dd> natural_spline(std::span<const KernelRow> rows) {
  const std::size_t n = rows.size();
  std::vector<Dd> second(n), share(n);  // share: of the next unknown in this one
  const auto step = [&](std::size_t i) { return Dd(rows[i + 1].x) - Dd(rows[i].x); };
  const auto slope = [&](std::size_t i) { return (Dd(rows[i + 1].k) - Dd(rows[i].k)) / step(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Dd before = step(i - 1), after = step(i);
    const Dd pivot = Dd(2) * (before + after) - before * share[i - 1];
    share[i] = after / pivot;
    second[i] = (Dd(6) * (slope(i) - slope(i - 1)) - before * second[i - 1]) / pivot;
  }
  for (std::size_t i = n; i-- > 1;) second[i - 1] = second[i - 1] - share[i - 1] * second[i];
  return second;
}

class Tabulated {
 public:
  explicit Tabulated(const Args& a) : cubic_(a.text("between") == "cubic") {
    const std::vector<KernelRow> rows = read_kernel_file(a.path("path"), a.place());
    const double left = rows.front().x, right = rows.back().x;
    // The support is symmetric: zero where only the other side has rows.
    if (-left < right) add({-right, 0}, {left, 0}, 0.0, 0.0);
    for (std::size_t first = 0; first < rows.size();) {
      std::size_t end = first + 1;
      while (end < rows.size() && rows[end].x > rows[end - 1].x) ++end;
      add_stretch(std::span(rows).subspan(first, end - first));
      first = end;
    }
    if (-left > right) add({right, 0}, {-left, 0}, 0.0, 0.0);
    knots_.push_back(pieces_.back().b.x);
  }

  std::vector<double> knots() const { return knots_; }
  int degree() const { return cubic_ ? 3 : 1; }
  Dd shape(int piece, Dd x) const {
    const Piece& p = pieces_[static_cast<std::size_t>(piece)];
    const Dd h = Dd(p.b.x) - Dd(p.a.x);
    const Dd t = (x - Dd(p.a.x)) / h, s = (Dd(p.b.x) - x) / h;
    const Dd line = s * Dd(p.a.k) + t * Dd(p.b.k);
    return line + h * h / Dd(6) * ((s * s * s - s) * p.second_a + (t * t * t - t) * p.second_b);
  }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked

 private:
  struct Piece {
    KernelRow a, b;
    Dd second_a, second_b;  // second derivatives there; 0 on a straight piece
  };

  void add(KernelRow a, KernelRow b, Dd second_a, Dd second_b) {
    knots_.push_back(a.x);
    pieces_.push_back({a, b, second_a, second_b});
  }

  // Rows without a jump among them; one row alone adds nothing.
  void add_stretch(std::span<const KernelRow> rows) {
    const std::vector<Dd> second = cubic_ ? natural_spline(rows) : std::vector<Dd>(rows.size());
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) add(rows[i], rows[i + 1], second[i], second[i + 1]);
  }

  bool cubic_;
  std::vector<double> knots_;
  std::vector<Piece> pieces_;
};

}  // namespace

extern constinit const FilterInfo tabulated_filter;
constinit const FilterInfo tabulated_filter =
    describe<Tabulated>({.name = "tabulated",
                         .title = "Kernel from a file of your own",
                         .cite = "de Boor, \"A Practical Guide to Splines\", 1978",
                         .params = kParams});

}  // namespace moire
