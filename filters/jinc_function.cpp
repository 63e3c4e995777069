// The jinc by a mean over a turn, and its zeros.
#include "filters/jinc_function.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "core/dd_math.h"

namespace moire {

// The zeros of J1 over pi (Abramowitz and Stegun, 1964, table 9.5, to more digits by Newton's method).
double jinc_zero(int number) {
  assert(number >= 1 && number <= kJincZeros);
  constexpr double kZeros[kJincZeros] = {
      1.219669891266504455, 2.233130594381528632, 3.238315484166236208, 4.241062863796069882,
      5.242764376870181658, 6.243921689864487733, 7.244759868719957028, 8.245394913952042673,
      9.245892684949467278, 10.24629334875491545, 11.24662279487788292, 12.24689846113810517,
      13.24713252218106129, 14.24733373580684925, 15.2475085630373002,  16.24766187470096186};
  return kZeros[number - 1];
}

// What is missed of jinc = J1(y) / (y / 2): less than 3 (y / 2)^(N - 2) / (N - 1)! where N > y.
JincFunction::JincFunction(double reach) {
  const double half = std::numbers::pi * reach / 2;
  double log_missed = std::log2(3.0);  // of 3 half^(n - 2) / (n - 1)!
  int n = 2;
  while (n % 4 != 0 || n < 2 * half || log_missed > -100) log_missed += std::log2(half / n++);
  for (int j = 0; j < n / 4; ++j) sines_.push_back(dd_cos_pi(n / 2 - 2 * j - 1, n));
}

// J1(y) / (y / 2) = 2 mean of s^2 sinc(x s), s = sin t, y = pi x. Each term is right to 2^-97 and at most 1.
Dd JincFunction::operator()(Dd x) const {
  Dd sum = 0.0;
  for (const Dd s : sines_) sum = sum + s * s * dd_sinc(x * s);
  return Dd(2.0) * sum / Dd(static_cast<double>(sines_.size()));
}

}  // namespace moire
