// Definitions: Mitchell and Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988, eq. 8; Keys,
// "Cubic Convolution Interpolation for Digital Image Processing", 1981; Blu, Thevenaz and Unser, "MOMS: Maximal-Order
// Interpolation of Minimal Support", 2001; Costella, "Solving the mystery of Magic Kernel Sharp", 2021; Harris, "On the
// Use of Windows for Harmonic Analysis with the Discrete Fourier Transform", 1978; presets as FilterText says.
// Where a kernel is usually printed as a table of polynomials, it is made here from what the table was made from.
#include "oracle/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "oracle/spec_values.h"

namespace moire::oracle {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

// A constant of a system, which is the double that its source text gives.
constexpr long double stored(double value) { return static_cast<long double>(value); }

// 0, first, first + 1, ... up to and with the radius.
std::vector<long double> unit_steps(long double first, long double radius) {
  std::vector<long double> breaks{0};
  for (long double x = first; x <= radius; ++x)
    if (x > 0) breaks.push_back(x);
  return breaks;
}

HalfKernel stretched(HalfKernel k, long double factor) {
  for (long double& x : k.breaks) x *= factor;
  k.type /= factor;
  k.shape = [shape = std::move(k.shape), factor](long double x) { return shape(x / factor); };
  return k;
}

// --- Piecewise polynomials ---

HalfKernel box(const Spec& spec) {
  return {{0, number_of(spec, "width", 1) / 2}, [](long double) { return 1.0L; }, 0};
}

HalfKernel tent(const Spec& spec) {
  const long double r = text_of(spec, "preset", "none") == "pbrt" ? 2 : number_of(spec, "radius", 1);
  return {{0, r}, [r](long double x) { return r - x; }, 1};
}

// B-spline of that degree on integer knots by the recurrence of de Boor and Cox, degree by degree: no truncated powers.
long double bspline_value(int degree, long double x) {
  const long double r = (static_cast<long double>(degree) + 1) / 2;
  const long double s = r - std::fabs(x);  // from the right end, by symmetry
  if (s < 0) return 0;
  const int cell = std::min(static_cast<int>(std::floor(s)), degree);
  std::vector<long double> b(static_cast<std::size_t>(degree) + 2, 0);
  b[static_cast<std::size_t>(cell)] = 1;
  for (int d = 1; d <= degree; ++d)
    for (int i = 0; i <= degree - d; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const long double left = s - static_cast<long double>(i), right = static_cast<long double>(i + d + 1) - s;
      b[at] = (left * b[at] + right * b[at + 1]) / static_cast<long double>(d);
    }
  return b[0];
}

HalfKernel bspline(const Spec& spec) {
  const int degree = static_cast<int>(number_of(spec, "order", 3));
  const long double r = (static_cast<long double>(degree) + 1) / 2;
  return {unit_steps(degree % 2 == 0 ? 0.5L : 1, r), [degree](long double x) { return bspline_value(degree, x); },
          degree};
}

HalfKernel bc_cubic(long double b, long double c) {
  const auto shape = [b, c](long double x) {
    if (x < 1) return (((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b)) / 6;
    return ((((-b - 6 * c) * x + (6 * b + 30 * c)) * x + (-12 * b - 48 * c)) * x + (8 * b + 24 * c)) / 6;
  };
  return {{0, 1, 2}, shape, 3};
}

HalfKernel mitchell(const Spec& spec) {
  const long double third = 1.0L / 3;
  return stretched(bc_cubic(number_of(spec, "b", third), number_of(spec, "c", third)),
                   number_of(spec, "radius", 2) / 2);
}

HalfKernel keys(long double a) {
  const auto shape = [a](long double x) {
    return x < 1 ? ((a + 2) * x - (a + 3)) * x * x + 1 : a * (((x - 5) * x + 8) * x - 4);
  };
  return {{0, 1, 2}, shape, 3};
}

HalfKernel hermite(const Spec&) {
  return {{0, 1}, [](long double x) { return (1 - x) * (1 - x) * (1 + 2 * x); }, 3};
}

// The polynomial of degree n through the n + 1 data next to x, 1 at 0 and 0 at the other integers.
HalfKernel lagrange(const Spec& spec) {
  const int n = static_cast<int>(number_of(spec, "order", 3));
  const long double r = (static_cast<long double>(n) + 1) / 2;
  const auto shape = [n, r](long double x) {
    const bool odd = n % 2 != 0;
    const int last = static_cast<int>(odd ? r : r - 0.5L) - (odd ? 1 : 0);  // the outermost cell
    const int cell = std::min(static_cast<int>(std::floor(odd ? x : x + 0.5L)), last);
    const int first = cell - (odd ? (n - 1) / 2 : n / 2);
    long double product = 1;
    for (int node = first; node <= first + n; ++node)
      if (node != 0) product *= (x - static_cast<long double>(node)) / -static_cast<long double>(node);
    return product;
  };
  return {unit_steps(n % 2 == 0 ? 0.5L : 1, r), shape, n};
}

// The cubic of maximal order and least asymptotic constant: beta + beta'' / 42, beta the cubic B-spline.
HalfKernel o_moms(const Spec&) {
  const auto shape = [](long double x) {
    const long double bend = bspline_value(1, x - 1) - 2 * bspline_value(1, x) + bspline_value(1, x + 1);
    return bspline_value(3, x) + bend / 42;
  };
  return {{0, 1, 2}, shape, 3};
}

// Interpolation by the natural cubic spline through the 2 n data next to x, seen between its middle two. What the datum
// at 0 contributes: the second derivatives of the spline through it and zeros, by elimination.
HalfKernel cubic_spline(const Spec& spec) {
  const int n = static_cast<int>(number_of(spec, "lobes", 2));
  const auto shape = [n](long double x) {
    const int cell = std::min(static_cast<int>(std::floor(x)), n - 1);
    const int first = cell - n + 1, inner = 2 * n - 2;  // data at first .. first + inner + 1
    const auto datum = [first](int i) { return first + i == 0 ? 1.0L : 0.0L; };
    std::vector<long double> diagonal(static_cast<std::size_t>(inner), 4), bend(diagonal.size());
    for (int i = 0; i < inner; ++i)
      bend[static_cast<std::size_t>(i)] = 6 * (datum(i) - 2 * datum(i + 1) + datum(i + 2));
    for (std::size_t i = 1; i < diagonal.size(); ++i) {
      diagonal[i] -= 1 / diagonal[i - 1];
      bend[i] -= bend[i - 1] / diagonal[i - 1];
    }
    for (std::size_t i = diagonal.size(); i-- > 0;)
      bend[i] = (bend[i] - (i + 1 < bend.size() ? bend[i + 1] : 0)) / diagonal[i];
    // Between data n - 1 and n, whose second derivatives are bend[n - 2] and bend[n - 1].
    const auto left = static_cast<std::size_t>(n) - 2;
    const long double s = x - static_cast<long double>(cell), t = 1 - s;
    return datum(n - 1) * t + datum(n) * s + (bend[left] * (t * t - 1) * t + bend[left + 1] * (s * s - 1) * s) / 6;
  };
  return {unit_steps(1, static_cast<long double>(n)), shape, 3};
}

// The quadratic B-spline sharpened by a short symmetric row of weights, the middle one first.
HalfKernel magic_kernel_sharp(const Spec& spec) {
  const bool newer = text_of(spec, "version", "2021") == "2021";
  const std::vector<long double> weights =
      newer ? std::vector<long double>{204 / 144.0L, -35 / 144.0L, 6 / 144.0L, -1 / 144.0L}
            : std::vector<long double>{6 / 4.0L, -1 / 4.0L};
  const auto shape = [weights](long double x) {
    long double sum = weights[0] * bspline_value(2, x);
    for (std::size_t i = 1; i < weights.size(); ++i) {
      const auto shift = static_cast<long double>(i);
      sum += weights[i] * (bspline_value(2, x - shift) + bspline_value(2, x + shift));
    }
    return sum;
  };
  return {unit_steps(0.5L, newer ? 4.5L : 2.5L), shape, 2};
}

// --- Bells ---

HalfKernel gaussian(const Spec& spec) {
  long double sigma = number_of(spec, "sigma", 0.5L), r = number_of(spec, "radius", 1.5L);
  bool lowered = text_of(spec, "cut", "offset") == "offset";
  struct Preset {
    std::string_view name;
    long double sigma, radius;
    bool lowered;
  };
  // The table of presets in the filter's documentation, as w / 4 and such where a system gives it so.
  for (const Preset& p : {Preset{"mitsuba", 0.5L, 2, true},
                          {"imagemagick", 0.5L, 2, false},
                          {"ospray", 0.5L, 1.5L, false},
                          {"renderman", 0.5L, 1, false},
                          {"arnold", 0.5L, 1, false},
                          {"cycles", 0.375L, 2.25L, false},
                          {"oiio", 0.75L, 1.5L, false},
                          {"oiio-sharp", stored(std::sqrt(0.125)), 1, false}})
    if (text_of(spec, "preset", "none") == p.name) {
      sigma = p.sigma;
      r = p.radius;
      lowered = p.lowered;
    }
  const long double w = 2 * sigma * sigma;
  const auto bell = [w](long double x) { return std::exp(-x * x / w); };
  const auto over_foot = [w, r](long double x) { return std::expm1((r - x) * (r + x) / w); };  // flat: no difference
  std::function<long double(long double)> shape = bell;
  if (lowered && r < sigma)
    shape = over_foot;
  else if (lowered)
    shape = [bell, foot = bell(r)](long double x) { return bell(x) - foot; };
  // Of no exponential type; this one makes pieces of 1.5 sigma and less, where 12 nodes leave less than 1e-21 of the
  // integral (oracle_test compares with the error function).
  return {{0, r}, shape, -1, 2.9L / sigma};
}

// Four terms of Harris's table. t = |x| / radius; the coefficients are the doubles nearest to the published ones.
long double blackman_harris_window(long double t) {
  const long double c = std::cos(kPi * t);  // cos 2 x = 2 c^2 - 1, cos 3 x = 4 c^3 - 3 c
  return stored(0.35875) + stored(0.48829) * c + stored(0.14128) * (2 * c * c - 1) +
         stored(0.01168) * (4 * c * c - 3) * c;
}

HalfKernel blackman_harris(const Spec& spec) {
  const bool three = text_of(spec, "preset", "none") != "none";  // oiio and cycles both come to a width of 3
  const long double r = (three ? 3 : number_of(spec, "width", 4)) / 2;
  return {{0, r}, [r](long double x) { return blackman_harris_window(x / r); }, -1, 3 * kPi / r};
}

// --- Windowed sincs ---

long double sinc(long double x) { return x == 0 ? 1 : std::sin(kPi * x) / (kPi * x); }

HalfKernel lanczos(const Spec& spec) {
  const std::string_view preset = text_of(spec, "preset", "none");
  long double a = number_of(spec, "a", 3), blur = number_of(spec, "blur", 1);
  if (preset != "none") {
    a = preset == "imagemagick-sharp" ? 3 : 2;
    blur = preset == "imagemagick-sharp"    ? stored(0.9812505644269356)
           : preset == "imagemagick2-sharp" ? stored(0.9549963639785485)
                                            : 1;
  }
  return stretched({{0, a}, [a](long double x) { return sinc(x) * sinc(x / a); }, -1, kPi * (1 + 1 / a)}, blur);
}

HalfKernel pbrt_sinc(const Spec& spec) {
  const long double r = number_of(spec, "radius", 4), tau = number_of(spec, "tau", 3);
  return {{0, r}, [tau](long double x) { return sinc(x) * sinc(x / tau); }, -1, kPi * (1 + 1 / tau)};
}

HalfKernel raw_sinc(const Spec& spec) {
  const std::string_view preset = text_of(spec, "preset", "none");
  // The RenderMan specification prints sin(x) / x, without pi.
  if (preset == "renderman") return {{0, 2}, [](long double x) { return x == 0 ? 1 : std::sin(x) / x; }, -1, 1};
  const long double r = preset == "imagemagick" ? 4 : preset == "oiio" ? 2 : number_of(spec, "radius", 2);
  return {{0, r}, sinc, -1, kPi};
}

// The modified Bessel function of order 0 as a function of (x / 2)^2, by its power series: all terms positive.
long double bessel_i0(long double quarter_square) {
  long double sum = 1, term = 1;
  for (int n = 1; term > 0x1p-70L * sum; ++n) {
    const auto m = static_cast<long double>(n);
    term *= quarter_square / (m * m);
    sum += term;
  }
  return sum;
}

// A window on [-1, 1] as a function of t >= 0. `type` as HalfKernel's, per t.
struct Window {
  std::function<long double(long double)> shape;
  long double type = 0;
  std::vector<long double> breaks = {};  // between 0 and 1
};

Window window_of(std::string_view name, long double beta) {
  if (name == "hann") return {[](long double t) { return 0.5L + 0.5L * std::cos(kPi * t); }, kPi};
  if (name == "hamming") return {[](long double t) { return stored(0.54) + stored(0.46) * std::cos(kPi * t); }, kPi};
  if (name == "blackman")
    return {[](long double t) {
              return stored(0.42) + stored(0.5) * std::cos(kPi * t) + stored(0.08) * std::cos(2 * kPi * t);
            },
            2 * kPi};
  if (name == "kaiser")
    return {[beta, top = bessel_i0(beta * beta / 4)](long double t) {
              return bessel_i0(beta * beta / 4 * std::max(0.0L, (1 - t) * (1 + t))) / top;
            },
            beta};
  if (name == "welch") return {[](long double t) { return (1 - t) * (1 + t); }};
  if (name == "bohman")
    return {[](long double t) { return (1 - t) * std::cos(kPi * t) + std::sin(kPi * t) / kPi; }, kPi};
  if (name == "cosine") return {[](long double t) { return std::cos(kPi * t / 2); }, kPi / 2};
  if (name == "blackman-harris") return {blackman_harris_window, 3 * kPi};
  if (name == "bartlett") return {[](long double t) { return 1 - t; }};
  if (name == "parzen") return {[](long double t) { return bspline_value(3, 2 * t); }, 0, {0.5L}};
  throw std::invalid_argument("the oracle has no window " + std::string(name));
}

HalfKernel windowed_sinc(const Spec& spec) {
  const std::string_view name = text_of(spec, "window", "hann");
  const bool imagemagick = text_of(spec, "preset", "none") == "imagemagick";
  const long double r = !imagemagick ? number_of(spec, "radius", 3) : name == "welch" || name == "cosine" ? 3 : 4;
  const Window window = window_of(name, imagemagick ? 6.5L : number_of(spec, "beta", 6.5L));
  HalfKernel k{{0}, [window, r](long double x) { return sinc(x) * window.shape(x / r); }, -1, kPi + window.type / r};
  for (const long double t : window.breaks) k.breaks.push_back(t * r);
  k.breaks.push_back(r);
  return k;
}

struct Definition {
  std::string_view name;
  HalfKernel (*make)(const Spec&);
};

constexpr Definition kDefinitions[] = {
    {"box", box},
    {"tent", tent},
    {"bspline", bspline},
    {"mitchell", mitchell},
    {"catmull-rom", [](const Spec&) { return keys(-0.5L); }},
    {"hermite", hermite},
    {"notch", [](const Spec&) { return bc_cubic(1.5L, -0.25L); }},
    {"robidoux", [](const Spec&) { return bc_cubic(stored(0.37821575509399867), stored(0.31089212245300067)); }},
    {"robidoux-sharp", [](const Spec&) { return bc_cubic(stored(0.2620145123990142), stored(0.3689927438004929)); }},
    {"keys", [](const Spec& spec) { return keys(number_of(spec, "a", -0.5L)); }},
    {"simon", [](const Spec&) { return keys(-0.75L); }},
    {"rifman", [](const Spec&) { return keys(-1); }},
    {"lagrange", lagrange},
    {"o-moms", o_moms},
    {"cubic-spline", cubic_spline},
    {"magic-kernel-sharp", magic_kernel_sharp},
    {"gaussian", gaussian},
    {"blackman-harris", blackman_harris},
    {"lanczos", lanczos},
    {"pbrt-sinc", pbrt_sinc},
    {"windowed-sinc", windowed_sinc},
    {"sinc", raw_sinc},
    {"tabulated",
     [](const Spec& spec) {
       return tabulated(std::string(text_of(spec, "path", "")), text_of(spec, "between", "linear") == "cubic");
     }},
};

}  // namespace

HalfKernel half_kernel(const Spec& spec) {
  for (const Definition& d : kDefinitions)
    if (d.name == spec.name) return d.make(spec);
  throw std::invalid_argument("the oracle has no kernel " + spec.name);
}

}  // namespace moire::oracle
