// What `moire spectrum` prints and writes.
#pragma once

#include <string>
#include <vector>

#include "core/geometry.h"
#include "reports/images.h"
#include "reports/spectrum_preview.h"
#include "study/results.h"

namespace moire {

// A column of the radial table for a person.
struct RadialColumn {
  std::string cell;       // its name
  std::string format;     // of a double (fmt); integers need none
  std::string meaning;    // a line below the table
  double zero_below = 0;  // smaller numbers are rounding, and written as 0
};

struct SpectrumOutput {
  std::string title;                  // one line for a person
  Row head;                           // what it is a spectrum of, and single numbers
  Table radial;                       // a row per ring; all rows have the same cells
  std::vector<RadialColumn> columns;  // those that a person sees
  Grid grid;
  std::vector<double> power;  // row-major, zero frequency at column width / 2 and row height / 2
  PowerScale scale = PowerScale::linear;
  std::vector<Attribute> attributes;  // of the EXR file, beside schema and kind
};

// A line with the title, a table of the rings, and what its columns mean.
std::string spectrum_text(const SpectrumOutput& output);

// One object: the cells of the head, then for each column of the radial table an array of its cells, null where there
// is none.
std::string spectrum_json(const SpectrumOutput& output);

// DIR/spectrum.exr (float32), DIR/spectrum.png and DIR/radial.csv; DIR is there. Throws Error (Exit::io).
void write_spectrum(const std::string& folder, const SpectrumOutput& output);

}  // namespace moire
