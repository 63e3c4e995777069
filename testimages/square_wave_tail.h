// Integrals over a ray that ends on a checkerboard's horizon, where the lines of both families pass without end: what
// lies beyond the last line that somebody wants to count, with a bound far below its size.
//
// With t = 1/W both coordinates on the board run linearly along a straight line of the image, so that the integrals of
// the Euler-polynomial series (checker_series.h) over its last stretch are
//
//   I = integral over t from T to infinity of E_q(u(t)) s(v(t)) t^-p dt,   |I| <= sup|E_q| T^(1-p) / (p - 1).
//
// Nothing is assumed of cancellation: where both families pass in step the mean of the product is not zero.
//
// Two steps. (1) Integration by parts along the family that passes faster, at b lines where the other passes a <= b
// (slopes times T). What is differentiated is a polynomial in the slower coordinate times a power of t; its last
// derivatives jump at the slower family's lines. There are left: terms at T, a sum over those lines (jump_sum.h), and a
// remainder, smaller by about p / (pi b) with every step. (2) The sum over the lines, whose terms sample a smooth
// periodic function at equal steps: the first ones as they are, the rest by its Fourier series, in which every harmonic
// is an integral of exp(i omega t) t^-p and an Euler-Maclaurin expansion. Harmonics in step with the lines (resonances)
// are as large as they can be and need no other treatment than the rest; those left out are bounded one by one or, from
// the last on, together.
#pragma once

namespace moire {

// t >= T > 0: u(t) = u + du (t - T), v(t) = v + dv (t - T). u and v are wanted modulo 2 alone and best given in [0, 2).
// The errors are bounds on what the four numbers may be off by.
struct TailLine {
  double T;
  double u, v, du, dv;
  double u_error = 0, v_error = 0, du_error = 0, dv_error = 0;
};

struct Tail {
  double value = 0, bound = 0;
};

// The integral I above, q >= 1, p >= 2; T^(1-p) is to be within the range of doubles. |value - I| <= bound for every
// line within the errors, and bound is never above sup|E_q| T^(1-p) / (p - 1): that is the answer, with the value 0,
// for q > 10, p > 16, errors near the size of a square, and where it is below `goal`.
//
// Works until bound <= goal, at most some milliseconds: some 10^5 lines and 10^4 harmonics. Where the goal is not
// reached the bound says so. A share of 1e-9 of the simple bound takes well below a millisecond, whatever the slopes.
Tail square_wave_tail(int q, int p, const TailLine& line, double goal);

}  // namespace moire
