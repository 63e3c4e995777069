// One pixel of a scene under one filter: the program's exact value against the oracle's. What the families edges, disks
// and boards share.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/exact.h"
#include "filters/filter.h"
#include "oracle/kernel.h"
#include "oracle/rings.h"
#include "stress/chance.h"
#include "stress/family.h"
#include "testimages/testimage.h"

namespace moire::stress {

// A filter and the oracle's own kernel for it.
struct CheckedFilter {
  explicit CheckedFilter(const std::string& text);

  Filter filter;
  bool is_box;                              // the oracle then has closed forms
  std::optional<oracle::Kernel> kernel;     // of a separable filter
  std::optional<oracle::RingKernel> rings;  // of a radial one
  // Places of the axis, from the pixel's centre, where the kernel changes its formula: ascending; of a radial filter
  // radii of both signs.
  std::vector<double> knots() const;
};
using FilterPtr = std::shared_ptr<const CheckedFilter>;

// The plain box in half of the cases; else a box of some other width, now and then, or one of all that the catalogue
// has (filter_variants()). `radial`: those, too. The oracle's kernels are made once in a run of the program.
FilterPtr pick_filter(Chance& chance, bool radial = true);
// By its text, for kinds of cases that need one in particular.
FilterPtr checked_filter(const std::string& text);

struct ExactCase {
  TestImage image;
  Pixel pixel;
  FilterPtr filter;
  double severity = 1;  // of a board: the condition of its homography
  // The truth where the oracle knows it better than by true_value(), and what is to be added to the error it states.
  std::function<oracle::Value()> truth = {};
  double oracle_doubt = 0;
  std::string fault = {};  // of what the scene made of its arguments; "": none
  // The textbook formula's value; NaN: none.
  double naive = std::numeric_limits<double>::quiet_NaN();
};

// The oracle's value by the method that suits the scene: closed forms for the box, sections for separable kernels,
// rings for radial ones, units of the radius for tiny disks. `image` is an edge, a disk or a checkerboard.
oracle::Value true_value(const TestImage& image, const CheckedFilter& filter, Pixel pixel);

// The largest bound that the program may claim of the case; infinite: no promise is made, any bound will do that is
// kept. Without this a claim of 1/2 give or take 1/2 would pass everywhere.
double promised_bound(const ExactCase& c);

// Compares what the program got; no error of its own beyond the truth's. A bound above the promised one is a fault.
Outcome judged(const ExactCase& c, const Exact& got, const oracle::Value& truth);
Outcome run(const ExactCase& c);

// A scene file on one line, the filter and the pixel: what `moire exact SCENE --filter F --pixels FILE` takes.
std::string describe(const ExactCase& c);

}  // namespace moire::stress
