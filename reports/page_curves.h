// The curves of a page: filters, radial spectra, and the points of patterns, as JSON.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "reports/page_image_list.h"
#include "reports/page_images.h"
#include "study/results.h"

namespace moire {

// A JSON array of what a page draws, perhaps packed, and what could not be drawn, PLACE: reason.
struct PageCurves {
  std::string json;
  std::vector<std::string> faults;
  std::vector<PageImage> left_out;  // spectra beyond the budget
};

// FilterCurves of reports/web/src/schema.ts, of each filter that the rows name. A filter that needs a file has none
// when the file is not found from here.
PageCurves page_filters(const Table& rows);

// PointSet: 16, 64 and 256 points, where it can have them, of each pattern that the rows name: the set of trial 0 and
// the rows' seed, with times where it has them.
PageCurves page_points(const Table& rows);

// RadialSpectrum of the spectra among `images`, in their order, from the .spectrum.csv beside them; those beyond the
// budget, in bytes of packed JSON, are left out.
PageCurves page_spectra(std::span<const PageImage> images, const RunPlace& place, std::size_t budget);

}  // namespace moire
