// Sets of points from a file or from standard input: how anybody's sampler is measured.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace moire {

// Points of the unit square or cube, in the order of the file; all coordinates in [0, 1).
struct PointSet {
  std::vector<double> x, y;
  std::vector<double> t;  // as long as x and y, or empty for points without a time
};

// Most points that all sets of an input may have together; an end to what never ends.
inline constexpr std::size_t kMaxSetPoints = std::size_t{1} << 26;
// Sets of a file: a set of one point takes a hundred times its memory.
inline constexpr std::size_t kMaxPointSets = 1'000'000;

// Sets of points, at least one, each with at least one point and all with the same number of coordinates; their sizes
// may differ. `path` "-" is standard input. A line has a point: x,y or x,y,t, as many on all lines, with commas, blanks
// or tabs between them, in decimal. The first line of a set may be a header, x,y or x,y,t. A line that begins with #
// ends a set, so that several of them, or one before the first set or after the last, make no empty set; empty lines
// count for nothing. Lines may end with CR LF, and a file may begin with the byte order mark of UTF-8. 10^7 points take
// about 2 s.
//
// Throws Error at FILE:LINE:COLUMN for what is no point, at FILE for no points or more than the limits above, and
// (Exit::io) for a file that cannot be read.
std::vector<PointSet> read_point_sets(const std::string& path);

// The same from any source: `read` fills at most `size` bytes and returns their number, 0 at the end. `file` is the
// name for messages.
std::vector<PointSet> parse_point_sets(const std::function<std::size_t(char* bytes, std::size_t size)>& read,
                                       const std::string& file);

}  // namespace moire
