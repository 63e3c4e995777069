// The program's kernels against the oracle's, which share no code: closed forms against Chebyshev series.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "filter_list.h"
#include "oracle/kernel.h"
#include "oracle/rings.h"

namespace moire {
namespace {

// k and K at 1999 points, each within the error that the program states; the ends exactly.
void compare(const std::string& text) {
  CAPTURE(text);
  const Filter filter(parse_spec(text, "test"));
  const Kernel& product = filter.kernel();
  const oracle::Kernel truth(text);
  REQUIRE(product.radius() == static_cast<double>(truth.radius()));
  const double r = product.radius();
  const auto k_error = static_cast<long double>(product.k_error()),
             K_error = static_cast<long double>(product.K_error());
  for (int i = -999; i <= 999; ++i) {
    const double x = r * i / 1000;
    CAPTURE(x);
    const auto at = static_cast<long double>(x);
    const long double right = std::nextafter(at, 99.0L);  // kernels are half-open: of a jump, the right side
    const auto k = static_cast<long double>(product.k(x)), K = static_cast<long double>(product.K(x));
    CHECK(std::fabs(k - truth(right)) <= k_error);
    CHECK(std::fabs(K - truth.over(-truth.radius(), at)) <= K_error);
  }
  CHECK(product.k(r) == 0);
  CHECK(std::fabs(static_cast<long double>(product.k(-r)) - truth(truth.radius())) <= k_error);
  CHECK(product.K(-r) == 0);
  CHECK(product.K(r) == 1);
}

// k, q and G of a radial filter at 400 distances, each within the error that the program states.
void compare_radial(const std::string& text) {
  CAPTURE(text);
  const Filter filter(parse_spec(text, "test"));
  const RadialKernel& product = filter.radial_kernel();
  const oracle::RingKernel truth(text);
  REQUIRE(product.radius() == static_cast<double>(truth.radius()));
  const double r = product.radius();
  const auto k_error = static_cast<long double>(product.k_error()),
             q_error = static_cast<long double>(product.q_error()),
             G_error = static_cast<long double>(product.G_error());
  for (int i = 0; i < 400; ++i) {
    const double x = i < 340 ? r * i / 340 : r * std::pow(0.5, i - 339);
    CAPTURE(x);
    const auto at = static_cast<long double>(x);
    const long double right = std::nextafter(at, 99.0L), moment = truth.moment(at);
    // The oracle's own digits: a few of its 64 bits.
    const long double rounding = 0x1p-60L * static_cast<long double>(product.k_max());
    CHECK(std::fabs(static_cast<long double>(product.k(x)) - truth(right)) <= k_error + rounding);
    CHECK(std::fabs(static_cast<long double>(product.G(x)) - moment) <= G_error + rounding);
    const auto q = static_cast<long double>(product.q(x));
    CHECK(std::fabs(q - (x > 0 ? moment / (at * at) : truth(0) / 2)) <= q_error + rounding);
  }
  CHECK(product.k(r) == 0);
  CHECK(product.G(r) == RadialKernel::kWhole);
  CHECK(product.q(2 * r) == doctest::Approx(RadialKernel::kWhole / (4 * r * r)).epsilon(1e-15));
  CHECK(product.k_error() < 1e-14 * std::max(1.0, product.k_max()));
  CHECK(product.q_error() < 1e-14 * std::max(1.0, product.k_max()));
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("k, q and G of every radial filter are within their stated errors of the oracle's quadrature") {
    for (const std::string& text : test::radial_texts()) compare_radial(text);
  }

  TEST_CASE("k, q and G are within their stated errors at the ends of every radial parameter's range") {
    for (const char* text :
         {"disk:radius=0.0625", "disk:radius=16", "cone:radius=0.0625", "cone:radius=16",
          "radial-gaussian:sigma=16,radius=0.0625", "radial-gaussian:sigma=16", "radial-gaussian:sigma=0.05",
          "radial-gaussian:sigma=1,radius=16", "radial-bc:b=8,c=8", "radial-bc:radius=0.125", "radial-bc:radius=16",
          "radial-lanczos:a=16", "radial-blackman-harris:width=0.125", "radial-blackman-harris:width=32",
          "jinc:lobes=16", "jinc:blur=0.5", "jinc:blur=2,lobes=16"}) {
      compare_radial(text);
    }
  }

  TEST_CASE("k and K of every filter are within their stated errors of the oracle's quadrature") {
    for (const std::string& text : test::separable_texts()) {
      compare(text);
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      CHECK(filter.kernel().k_error() < 1e-14);
      CHECK(filter.kernel().K_error() < 1e-14);
    }
  }

  TEST_CASE("k and K are within their stated errors at the ends of every parameter's range") {
    for (const char* text : {"box:width=0.0625",
                             "box:width=16",
                             "tent:radius=0.0625",
                             "tent:radius=16",
                             "mitchell:b=-8,c=8,radius=0.125",
                             "mitchell:b=0,c=0,radius=16",
                             "mitchell:b=1,c=0",
                             "keys:a=-8",
                             "keys:a=0",
                             "keys:a=1",
                             "lagrange:order=1",
                             "lagrange:order=8",
                             "lagrange:order=9",
                             "gaussian:sigma=0.05,radius=16",
                             "gaussian:sigma=0.05,radius=16,cut=cut",
                             "gaussian:sigma=16,radius=0.0625",
                             "gaussian:sigma=16,radius=0.0625,cut=cut",
                             "gaussian:sigma=16,radius=16",
                             "blackman-harris:width=0.125",
                             "blackman-harris:width=32",
                             "lanczos:a=1",
                             "lanczos:a=16",
                             "lanczos:a=1,blur=0.5",
                             "lanczos:a=8,blur=2",
                             "pbrt-sinc:radius=0.5,tau=1024",
                             "pbrt-sinc:radius=16,tau=1",
                             "windowed-sinc:window=kaiser,radius=1,beta=32",
                             "windowed-sinc:window=kaiser,radius=1,beta=0",
                             "windowed-sinc:window=kaiser,radius=16,beta=32",
                             "windowed-sinc:window=blackman-harris,radius=1",
                             "windowed-sinc:window=blackman-harris,radius=16",
                             "windowed-sinc:window=bohman,radius=15.9",
                             "windowed-sinc:window=parzen,radius=1",
                             "windowed-sinc:window=bartlett,radius=7.3",
                             "sinc:radius=0.5",
                             "sinc:radius=16"}) {
      compare(text);
    }
  }
}

}  // namespace moire
