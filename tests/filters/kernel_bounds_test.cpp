// The bounds of each piece of each kernel, against what many points of it show.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "filter_list.h"
#include "reports/folder.h"

namespace moire {

TEST_SUITE("unit") {
  TEST_CASE("bounds on k, K and the slope hold on every piece and are tight") {
    for (const std::string& text : test::separable_texts()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const Kernel& kernel = filter.kernel();
      for (int p = 0; p < kernel.pieces(); ++p) {
        CAPTURE(p);
        const Kernel::PieceBounds& b = kernel.bounds(p);
        const auto i = static_cast<std::size_t>(p);
        const double left = kernel.knots()[i], right = kernel.knots()[i + 1];
        double k = 0, K = 0, slope = 0, before = 0;
        constexpr int kPoints = 4000;
        for (int j = 0; j <= kPoints; ++j) {
          const double x = left + (right - left) * j / kPoints;
          const double here = kernel.k_piece(p, x);
          k = std::max(k, std::fabs(here));
          K = std::max(K, std::fabs(kernel.K_piece(p, x)));
          if (j > 0) slope = std::max(slope, std::fabs(here - before) * kPoints / (right - left));
          before = here;
        }
        CHECK(k <= b.k);
        CHECK(K <= b.K);
        // A difference quotient is a slope in between, but for the rounding of two values.
        CHECK(slope <= b.slope + 2 * b.k_error_at_x * kPoints / (right - left));
        // Half a percent for what lies between the angles looked at, and room for what lies between these points.
        CHECK(b.k <= 1.01 * k + 1e-14 * kernel.k_max());
        CHECK(b.K <= 1.01 * K + 1e-14);
        CHECK(b.slope <= 1.01 * slope + 1e-9 * kernel.slope_max());
        CHECK(std::max(b.k_error, b.k_error_at_x) <= kernel.k_error());
        CHECK(std::max(b.K_error, b.K_error_at_x) <= kernel.K_error());
      }
      CHECK(kernel.bounds(-1).k == 0);
      CHECK(kernel.bounds(kernel.pieces()).K == 1);
    }
  }

  TEST_CASE("weights have the same bits as k, near together and far apart, also where pieces are many") {
    const Folder folder;
    {
      std::ofstream table(folder.file("long.csv"));
      table.precision(17);
      for (int i = 0; i < 1000; ++i) table << i / 250.0 << ',' << std::cos(0.003 * i) << '\n';
    }
    std::vector<std::string> texts = test::separable_texts();
    for (const char* between : {"linear", "cubic"}) {
      texts.push_back("tabulated:path=" + folder.file("long.csv") + ",between=" + between);
    }
    for (const std::string& text : texts) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const Kernel& kernel = filter.kernel();
      std::vector<double> x(kernel.knots().begin(), kernel.knots().end());
      const double r = 1.25 * kernel.radius();
      // Blocks of eight neighbours; then strides that are coprime to 997 and carry each block over the support.
      for (int stride : {1, 2, 40, 311})
        for (int i = 0; i < 997; ++i) x.push_back(r * (2.0 * (i * stride % 997) / 996 - 1));
      std::vector<double> out(x.size());
      kernel.weights(x, out);
      int different = 0;
      for (std::size_t i = 0; i < x.size(); ++i) different += out[i] != kernel.k(x[i]);
      CHECK(different == 0);
    }
  }

  TEST_CASE("many points at once have the same bits as one by one") {
    for (const std::string& text : test::separable_texts()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const Kernel& kernel = filter.kernel();
      for (const std::size_t n : {1u, 3u, 4u, 7u, 8u, 13u}) {
        std::vector<double> x, t, k(n), K(n);
        const int p = kernel.pieces() / 2;
        const auto i = static_cast<std::size_t>(p);
        for (std::size_t j = 0; j < n; ++j) {
          const double share = (static_cast<double>(j) + 0.3) / static_cast<double>(n);
          x.push_back(kernel.knots()[i] + share * (kernel.knots()[i + 1] - kernel.knots()[i]));
          t.push_back(kernel.t_of(p, x.back()));
        }
        kernel.k_at(p, t, k.data());
        kernel.K_at(p, t, K.data());
        for (std::size_t j = 0; j < n; ++j) {
          CHECK(k[j] == kernel.k_piece(p, x[j]));
          CHECK(K[j] == kernel.K_piece(p, x[j]));
        }
      }
    }
  }
}

}  // namespace moire
