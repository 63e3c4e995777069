// The integral over y from 0 to infinity of exp(i omega y) (1 + y)^-p dy, the exponential integral E_p(z) times e^z on
// the imaginary axis, z = -i omega (Digital Library of Mathematical Functions, 8.19).
#pragma once

namespace moire {

// The true value is within `error` of re + i im, by absolute value.
struct OscillatingTail {
  double re, im, error;
};

// 2 <= p <= 40. |result| <= min(1 / (p - 1), 1 / |omega|): the weight (1 + y)^-p is a mixture of exp(-s y), so that the
// result is a mean of 1 / (s - i omega).
OscillatingTail oscillating_tail(int p, double omega);

}  // namespace moire
