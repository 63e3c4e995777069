// Kernels that users bring: what a table means, what is refused and where, and that uneven ones point the right way.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "engine/exact.h"
#include "engine/render.h"
#include "filters/filter.h"
#include "scenes.h"
#include "test_folder.h"

using namespace moire;

namespace {

const test::TestFolder& folder() {
  static const test::TestFolder folder("tabulated_test");
  return folder;
}

// The filter whose table is `text`.
Filter table(const std::string& text, const std::string& more = "") {
  return Filter(parse_spec("tabulated:path=" + folder().write("k.csv", text) + more, "--filter"));
}

std::string refusal(const std::string& text) {
  try {
    table(text);
  } catch (const Error& e) {
    CHECK(e.code() == Exit::usage);
    std::string message = e.what();
    // The folder has a number of this run.
    const std::size_t at = message.find(folder().file(""));
    return at == std::string::npos ? message : message.erase(at, folder().file("").size());
  }
  return "accepted";
}

void check_same(const Filter& a, const std::string& text) {
  const Filter b(parse_spec(text, "test"));
  const Kernel &ka = a.kernel(), &kb = b.kernel();
  CAPTURE(text);
  CHECK(ka.radius() == kb.radius());
  for (int i = -500; i <= 500; ++i) {
    const double x = kb.radius() * i / 499.5;
    CHECK(std::fabs(ka.k(x) - kb.k(x)) <= ka.k_error() + kb.k_error());
    CHECK(std::fabs(ka.K(x) - kb.K(x)) <= ka.K_error() + kb.K_error());
  }
}

// Uneven, with a jump at 1/2; steps of 1/8, like the cells of a regular pattern of 64.
const std::string kUneven = "-0.75,0\n-0.25,1\n0.5,0.5\n0.5,1.25\n1.375,-0.25\n1.625,0\n";
constexpr double kUnevenRows[][2] = {{-0.75, 0}, {-0.25, 1}, {0.5, 0.5}, {0.5, 1.25}, {1.375, -0.25}, {1.625, 0}};

// Straight lines between the rows, and their integral from the left end: apart from the program's own.
double uneven(double x) {
  for (std::size_t i = 0; i + 1 < std::size(kUnevenRows); ++i) {
    const auto &a = kUnevenRows[i], &b = kUnevenRows[i + 1];
    if (x >= a[0] && x < b[0]) return a[1] + (x - a[0]) * (b[1] - a[1]) / (b[0] - a[0]);
  }
  return 0;
}
double uneven_integral(double x) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < std::size(kUnevenRows); ++i) {
    const auto &a = kUnevenRows[i], &b = kUnevenRows[i + 1];
    if (a[0] == b[0] || x <= a[0]) continue;
    const double to = std::min(x, b[0]), at_to = a[1] + (to - a[0]) * (b[1] - a[1]) / (b[0] - a[0]);
    sum += (to - a[0]) * (a[1] + at_to) / 2;
  }
  return sum;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a table of a kernel that is straight between its rows is that kernel") {
    check_same(table("-1,0\n0,1\n1,0\n"), "tent");
    check_same(table("-2,0\n-1,5\n0,10\n0.5,7.5\n2,0\n"), "tent:radius=2");
  }

  TEST_CASE("rows without negative x are the right half of an even kernel") {
    check_same(table("0,1\n1,0\n"), "tent");
    check_same(table("0,3\n0.25,2.25\n1,0\n"), "tent");
    check_same(table("0,1\n0.5,1\n"), "box");
    check_same(table("0,1\n0.75,1\n0.75,0\n"), "box:width=1.5");
    check_same(table("0.25,1\n0.75,1\n"), "box:width=1.5");  // the innermost rows are joined
    const Filter ring = table("1,0\n1,1\n2,1\n");
    CHECK(ring.kernel().k(0) == 0);
    CHECK(ring.kernel().k(1.5) == doctest::Approx(0.5).epsilon(1e-15));
    CHECK(ring.kernel().k(-1.5) == doctest::Approx(0.5).epsilon(1e-15));
  }

  TEST_CASE("two rows of one x are a jump, also at the ends") {
    check_same(table("-0.5,0\n-0.5,1\n0.5,1\n0.5,0\n"), "box");
    check_same(table("-0.5,1\n0.5,1\n"), "box");
    check_same(table("-0.5,1\n0.5,1\n", ",between=cubic"), "box");
    const Filter step = table("-1,1\n0,1\n0,3\n1,3\n");
    CHECK(step.kernel().k(-0.5) == doctest::Approx(0.25).epsilon(1e-15));
    CHECK(step.kernel().k(0) == doctest::Approx(0.75).epsilon(1e-15));
    CHECK(step.kernel().jump_max() == doctest::Approx(0.75).epsilon(1e-14));
  }

  TEST_CASE("a natural cubic spline through its own values is found again, up to each jump") {
    // The cubic B-spline has no second derivative at its ends: it is the natural spline through its five knots.
    const std::string sixth = shortest(1.0 / 6), two_thirds = shortest(2.0 / 3);
    const Filter whole =
        table("-2,0\n-1," + sixth + "\n0," + two_thirds + "\n1," + sixth + "\n2,0\n", ",between=cubic");
    const Filter half = table("0," + two_thirds + "\n1," + sixth + "\n2,0\n", ",between=cubic");
    const Filter bspline(parse_spec("bspline", "test"));
    const Kernel& spline = bspline.kernel();
    for (int i = -200; i < 200; ++i) {
      const double x = i / 100.0;
      // The rows are rounded to double: 2^-53 of them, and the spline through errors of at most that is below 3 times.
      CHECK(std::fabs(whole.kernel().k(x) - spline.k(x)) <= whole.kernel().k_error() + spline.k_error() + 4 * 0x1p-53);
      CHECK(std::fabs(half.kernel().k(x) - whole.kernel().k(x)) <= 2 * whole.kernel().k_error());
    }
    // Straight on both sides of a jump: splines of two rows are lines.
    const Filter jump = table("-1,0\n0,1\n0,2\n1,0\n", ",between=cubic"), lines = table("-1,0\n0,1\n0,2\n1,0\n");
    for (int i = -10; i <= 10; ++i) {
      CHECK(std::fabs(jump.kernel().k(i / 10.0) - lines.kernel().k(i / 10.0)) <= 2 * jump.kernel().k_error());
    }
    // Uneven steps: the tridiagonal system of the three rows 0, 1, 3 with k = 0, 1, 0 has the one unknown
    // 2 (1 + 2) m = 6 (-1/2 - 1), so m = -3/2, and at x = 1/2 the spline is 1/2 + (1/8 - 1/2) m / 6 = 0.59375.
    const Filter three = table("-0.5,0\n0.5,1\n2.5,0\n", ",between=cubic");
    CHECK(three.kernel().k(0) * three.kernel().integral() == doctest::Approx(0.59375).epsilon(1e-14));
  }

  TEST_CASE("headers, comments, blank lines, blanks and line ends of any system do not count") {
    check_same(table("x,k\n-1,0\n0,1\n1,0\n"), "tent");
    check_same(table("\xef\xbb\xbf# mine\r\n\r\n\"distance\",\"weight\"\r\n -1 ,\t0\r\n# middle\r\n0, 1\r\n+1,0"),
               "tent");
    check_same(table("# no header\n0,1e0\n\n1,-0\n"), "tent");
  }

  TEST_CASE("what is wrong with a table is said where it stands") {
    CHECK(refusal("-1,0\n0,\n1,0\n") == "k.csv:2:3: k is missing; give a number");
    CHECK(refusal("-1,0\n ,1\n1,0\n") == "k.csv:2:2: x is missing; give a number");
    CHECK(refusal("x,k\n-1,0\n0,one\n") == "k.csv:3:3: k is not a number: \"one\"; give a finite number");
    CHECK(refusal("-1,0\n0,inf\n") == "k.csv:2:3: k is not finite: \"inf\"; give a finite number");
    CHECK(refusal("nan,nan\n0,1\n1,0\n") == "k.csv:1:1: x is not finite: \"nan\"; give a finite number");
    CHECK(refusal("-1,0\n0,1e999\n") == "k.csv:2:3: k is not finite: \"1e999\"; give a finite number");
    CHECK(refusal("x,1\n0,1\n").starts_with("k.csv:1:1: x is not a number: \"x\""));
    CHECK(refusal("x,k\nx,k\n0,1\n").starts_with("k.csv:2:1: x is not a number: \"x\""));
    CHECK(refusal("-1,0\n0 1\n") == "k.csv:2:1: the row has 1 fields; give two, x,k");
    CHECK(refusal("-1,0\n0,1, 2\n") == "k.csv:2:6: the row has 3 fields; give two, x,k");
    CHECK(refusal("-1,0\n1,1\n 0,1\n") == "k.csv:3:2: x falls from 1 to 0; sort the rows by x");
    CHECK(refusal("-1,0\n0,1\n0,2\n0,3\n1,0\n") == "k.csv:4:1: x is 0 a third time; two rows make a jump");
    CHECK(refusal("-1,0\n0,1\n0.0000001,2\n1,0\n").starts_with("k.csv:3:1: x is only 1e-07 pixels after"));
    CHECK(refusal("0,1\n0,2\n1,0\n").starts_with("k.csv:2:1: a second row for x = 0 where no x is negative"));
    CHECK(refusal("1e-8,1\n1,0\n") == "k.csv: x begins at 1e-08 pixels, too near to 0; give 0");
    CHECK(refusal("-1,0\n17,0\n") == "k.csv:2:1: x is 17 pixels; it must be -16 to 16");
    CHECK(refusal("-0.05,1\n0.05,1\n").starts_with("k.csv: the kernel ends at 0.05 pixels"));
    CHECK(refusal("") == "k.csv: the kernel has 0 rows; give at least two, of different x");
    CHECK(refusal("0,1\n").starts_with("k.csv: the kernel has 1 row;"));
    CHECK(refusal("1,1\n1,2\n").starts_with("k.csv: the kernel has 2 rows; give at least two, of different x"));
    CHECK(refusal("-1,0\n1,0\n").starts_with("k.csv: the largest |k| is 0"));
    CHECK(refusal("-1,1e200\n1,0\n").starts_with("k.csv: the largest |k| is 1e+200"));
    std::string rows;
    for (int i = 0; i <= 4096; ++i) rows += shortest(i * 0x1p-10) + ",1\n";
    CHECK(refusal(rows) == "k.csv:4097:1: the kernel has more than 4096 rows; give fewer");
  }

  TEST_CASE("files that cannot be read are named with the reason") {
    const std::string long_file = folder().write("long.csv", std::string(2000000, '1'));
    for (const std::string& path : {folder().file("none.csv"), folder().file(""), long_file}) {
      CAPTURE(path);
      try {
        const Filter f(parse_spec("tabulated:path=" + path, "--filter"));
        FAIL("accepted");
      } catch (const Error& e) {
        CHECK(e.code() == Exit::io);
        CHECK(std::string(e.what()).starts_with("--filter: " + path + ": the file cannot be read ("));
      }
    }
  }

  TEST_CASE("kernels whose lobes cancel are refused, whose negative lobes are deep are not") {
    const std::string why =
        "pixels are divided by it, so it must be positive and at least 0.01 of the integral of "
        "the kernel's absolute value";
    for (const char* text : {"-1,-1\n0,0\n1,1\n", "-1,-1\n1,-1\n", "-1,1\n0,1\n0,-0.99\n1,-0.99\n"}) {
      const std::string message = refusal(text);
      CAPTURE(message);
      CHECK(message.starts_with("--filter: filter \"tabulated:path="));
      CHECK(message.ends_with(why));
    }
    CHECK(refusal("-1,1\n0,1\n0,-0.97\n1,-0.97\n") == "accepted");
  }

  TEST_CASE("a table as long as may be is still the kernel") {
    // Half a tent in 4096 rows makes 8190 pieces.
    std::string rows;
    for (int i = 0; i < 4096; ++i) rows += shortest(i * 0x1p-12) + "," + shortest(4095 - i) + "\n";
    const Filter f = table(rows);
    CHECK(f.kernel().pieces() == 8190);
    check_same(f, "tent:radius=" + shortest(4095 * 0x1p-12));
  }

  TEST_CASE("an uneven kernel is what its table says, its support padded to be even") {
    const Filter f = table(kUneven);
    const Kernel& k = f.kernel();
    CHECK(k.radius() == 1.625);
    CHECK(f.apron() == 2);
    const double integral = uneven_integral(2);
    CHECK(k.integral() == doctest::Approx(integral).epsilon(1e-15));
    for (int i = -170; i <= 170; ++i) {
      const double x = i / 100.0 + 0.003;
      CHECK(std::fabs(k.k(x) - uneven(x) / integral) <= k.k_error() + 0x1p-50);
      CHECK(std::fabs(k.K(x) - uneven_integral(x) / integral) <= k.K_error() + 0x1p-50);
    }
    CHECK(k.k(-1) == 0);
    // Mirrored, to the left.
    const Filter left = table("-1.625,0\n-1.375,-0.25\n-0.5,1.25\n-0.5,0.5\n0.25,1\n0.75,0\n");
    for (int i = -170; i <= 170; ++i) {
      const double x = i / 100.0 + 0.003;
      CHECK(std::fabs(left.kernel().k(-x) - k.k(x)) <= 2 * k.k_error());
    }
  }

  TEST_CASE("exact values weigh the scene at p by k(p - c), c the pixel's centre, in both coordinates") {
    const Filter f = table(kUneven);
    const double integral = uneven_integral(2);
    const auto K = [&](double x) { return uneven_integral(std::min(x, 1.625)) / integral; };
    for (const double offset : {-1.2, -0.4, 0.1, 0.7, 1.3}) {
      CAPTURE(offset);
      // Half-planes to the right of and below a line at `offset` from the centre of pixel (5, 5).
      const Exact right = exact_pixel(scenes::edge({5.5 + offset, 0}, {1, 0}), f, {5, 5});
      const Exact below = exact_pixel(scenes::edge({0, 5.5 + offset}, {0, 1}), f, {5, 5});
      CHECK(std::fabs(right.value - (1 - K(offset))) <= right.bound + 0x1p-50);
      CHECK(std::fabs(below.value - (1 - K(offset))) <= below.bound + 0x1p-50);
      // The kernel turned around would give something quite different.
      CHECK(std::fabs(right.value - K(-offset)) > 0.02);
    }
    // An oblique half-plane, x cos + y sin >= offset, by midpoints in y of what 1 - K makes of x.
    for (const double degrees : {30.0, 130.0, -75.0}) {
      const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
      const double offset = 0.2;
      constexpr int n = 100000;
      double sum = 0;
      for (int i = 0; i < n; ++i) {
        const double y = -1.625 + 3.25 * (i + 0.5) / n, x = (offset - y * s) / c;
        sum += uneven(y) / integral * (c > 0 ? 1 - K(x) : K(x)) * 3.25 / n;
      }
      const Exact value = exact_pixel(scenes::edge({5.5 + offset * c, 5.5 + offset * s}, {c, s}), f, {5, 5});
      CAPTURE(degrees);
      // One midpoint beside the jump of k, at most k_max h / 2, is the largest error.
      CHECK(std::fabs(value.value - sum) <= value.bound + f.kernel().k_max() * 3.25 / n);
    }
  }

  TEST_CASE("samples are weighed the same way as the exact values") {
    // Kernel and edges change on a grid of 1/8 pixel and are straight between: the mean of an 8 x 8 grid of cell
    // centres is the integral itself. Weights are right to k_error, 25 cells of 64 add up to rounding.
    const Filter f = table(kUneven);
    const Pattern pattern(PatternChoice(parse_spec("regular", "test")), 64, {});
    for (const Vec2 normal : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
      const TestImage scene = scenes::edge({4.375, 4.375}, normal, {9, 9});
      const ActiveRows rows = enumerate(scene, f.radius());
      const Reference truth = exact(scene, f, rows);
      REQUIRE(truth.value.size() > 9);
      for (const Estimator e : {Estimator::ratio, Estimator::unnormalised, Estimator::control_variate}) {
        const Rendered got = render(scene, pattern, f, e, rows, true);
        std::size_t active = 0;
        for_each_rendered(rows, got, [&](int x, int y, Cover cover, double value) {
          if (cover != Cover::partial) return;
          CAPTURE(x);
          CAPTURE(y);
          CHECK(std::fabs(value - truth.value[active++]) <= 1e-13);
        });
      }
    }
  }
}
