// Which images of a run a page shows first, when not all of them fit.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "study/results.h"

namespace moire {

// One image file of a run. `row` is the row that names it; of an exact image the first one, of a spectrum the one with
// the case's spectrum columns.
struct PageImage {
  enum class Kind : std::uint8_t { exact, error, spectrum, structured, noise };
  Kind kind = Kind::error;
  std::string file;   // relative to the run's folder
  std::string exact;  // of an error: the file of its exact image
  const Row* row = nullptr;
};

// "exact", "error", ...
std::string_view name_of(PageImage::Kind kind);

// What a person reads: "error: edge, jittered, 16 samples per pixel, box".
std::string label_of(const PageImage& image);

// The images that the rows name, those that say most first; `rows` must outlive the list. Errors take turns by scene,
// filter and estimator; in each of these first trial 0 at the middle one of the sample counts: the pattern with the
// largest error, the smallest, the median one, then the others as they come; then the other counts, nearer ones first;
// then the other trials. Each error comes with its exact image before it, unless that came already, and with the
// spectra of its case behind it.
std::vector<PageImage> images_by_rank(const Table& rows);

// The stem of the files of a case's spectra, relative to the run's folder: that of its error image without the trial.
std::string spectra_stem(const Row& row_with_image);

// What all trials of a case share, as one text.
std::string case_key(const Row& row);

}  // namespace moire
