// Coverage as textbooks have it, in plain doubles and in the image's coordinates: what the table of errors shows beside
// the program's values.
#pragma once

#include "oracle/scene.h"

namespace moire::stress {

// Share of the square of that width around the pixel's centre. Edge: signed distances (p - through) . n, Sutherland and
// Hodgman's clipping and the shoelace formula. Disk: quarter-planes cut from the circle, by sqrt(r^2 - x^2) and asin.
double naive_coverage(const oracle::Edge& edge, Pixel pixel, double width);
double naive_coverage(const oracle::Disk& disk, Pixel pixel, double width);
// Squares projected by the inverse homography and clipped to the window. NaN where a corner of the window looks past
// the horizon, or where it holds more than some thousand squares.
double naive_coverage(const oracle::Board& board, Pixel pixel, double width);

}  // namespace moire::stress
