// The images of a run in a page: read, encoded, and as many as its budget takes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "reports/page_image_list.h"

namespace moire {

struct PageImages {
  struct Item {
    PageImage image;
    std::string json;  // ReportImage of reports/web/src/schema.ts
  };
  std::vector<Item> kept;               // in order of rank; of errors, "row" counts the errors before
  std::vector<PageImage> left_out;      // there, but beyond the budget
  std::vector<std::string> unreadable;  // what is wrong with others, PATH: reason
  std::size_t bytes = 0;                // of those that are kept, with kRowBytes for the row of each error
};

// Where a run's files are, on disk and seen from the page, and what it is called there.
struct RunPlace {
  std::string folder;  // on disk
  std::string link;    // from the page to that folder, "" or with "/" at its end
  std::string id;      // of the run
};

// Tries the images in their order, on all threads; which ones are kept does not depend on them. An image that does not
// fit into what is left of the budget, in bytes of JSON with its row, is left out, and the next are still tried, until
// kMostMisses did not fit. None of more than kMaxPagePixels is read.
inline constexpr int kMostMisses = 16;
inline constexpr std::size_t kRowBytes = 700;  // a row of results, packed, takes 350 to 500
inline constexpr double kMaxPagePixels = 0x1p22;
PageImages page_images(std::span<const PageImage> images, const RunPlace& place, std::size_t budget);

}  // namespace moire
