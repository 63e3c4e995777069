// Exact values of kernels that come from a file, even ones, against the oracle's own reading of the file.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "engine/exact_compare.h"
#include "engine/random_scenes.h"
#include "reports/folder.h"

namespace moire {
namespace {

// A plateau, a jump down and a roof; a jump to zero at the end.
constexpr const char* kHouse = "0,1\n0.375,1\n0.375,0.75\n1.25,0.25\n1.7,0.125\n";

// A sinc under a cosine at rows that are no multiples of each other, 0 at its end.
std::string lobes() {
  std::string rows;
  for (int i = 0; i <= 17; ++i) {
    const double x = 2.5 * i / 17, k = i == 0 ? 1 : std::sin(3.1 * x) / (3.1 * x) * std::cos(0.6 * x);
    rows += shortest(x) + ',' + shortest(i == 17 ? 0 : k) + '\n';
  }
  return rows;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("tabulated kernels, straight and cubic between rows, are exact on edges, disks and boards") {
    const Folder folder;
    std::ofstream(folder.file("house.csv")) << kHouse;
    std::ofstream(folder.file("lobes.csv")) << lobes();
    Draw draw(51);
    for (const char* file : {"house.csv", "lobes.csv"})
      for (const char* between : {"linear", "cubic"}) {
        const std::string text = "tabulated:path=" + folder.file(file) + ",between=" + between;
        CAPTURE(text);
        const Filter filter(parse_spec(text, "test"));
        const Kernel& product = filter.kernel();
        const oracle::Kernel truth(text);
        for (int i = -499; i < 500; ++i) {
          const double x = product.radius() * i / 500;
          const auto at = static_cast<long double>(x), right = std::nextafter(at, 99.0L);
          CHECK(std::fabs(static_cast<long double>(product.k(x)) - truth(right)) <=
                static_cast<long double>(product.k_error()));
          CHECK(std::fabs(static_cast<long double>(product.K(x)) - truth.over(-truth.radius(), at)) <=
                static_cast<long double>(product.K_error()));
        }
        ExactComparison compare(text, 1e-12);  // the promise of moire for filters other than the box
        for (int i = 0; i < 200; ++i) {
          const RandomCase edge = random_edge(draw, compare.radius()), disk = random_disk(draw, compare.radius());
          compare(edge.image, edge.pixel);
          compare(disk.image, disk.pixel);
          const RandomCase board = random_board(draw, compare.radius(), 20);
          if (i % 4 == 0) compare(board.image, board.pixel);
        }
        MESSAGE(compare.summary());
      }
  }
}

}  // namespace moire
