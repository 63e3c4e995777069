// A checkerboard in perspective under a reconstruction filter, where a window holds many squares or the horizon: the
// squares near the camera one by one, those behind them by the series of checker_series.h.
#pragma once

#include <optional>

#include "testimages/board_lines.h"
#include "testimages/testimage.h"

namespace moire {

// Under the weight k(x) k(y) on the window that the pieces of k span, twice. The sum of the result and of what is
// appended to `rest` is the integral. No answer where the window holds few squares.
//
// Each rectangle between the weight's knots is cut where W is as large as the series' remainder allows: in front of
// that line squares are clipped, at most so many as are worth the time, behind it the series knows all of them at once.
std::optional<WeightIntegral> board_weight(const LocalHomography& local, const Extent& extent,
                                           std::span<const PieceWeight> pieces, const WeightAim& aim, Boundary& rest);

}  // namespace moire
