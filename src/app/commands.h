// The commands of the program and their options. Each writes its data to standard output, returns the exit code and
// throws Error for everything that is wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "measure/contrast_sensitivity.h"
#include "measure/spectrum.h"
#include "testimages/testimage.h"

namespace moire {

// Text that was asked for by --help or --version.
struct TextOptions {
  std::string text;
};

struct ListOptions {
  std::string what;  // patterns, filters, scenes, studies or measures
  bool json = false;
};

struct RunOptions {
  std::string study;   // a file, or the name of a built-in study
  std::string folder;  // of the results
  int threads = 0;     // 0: as many as there are cores
  bool resume = false;
  bool dry_run = false;
};

struct RenderOptions {
  std::string scene, pattern, layout, filter, estimator;
  std::int64_t spp = 0;
  std::uint64_t seed = 1;
  std::uint32_t trial = 0;
  std::string out, error;  // paths of the images, "": none
  bool exhaustive = false, json = false;
};

struct ExactOptions {
  std::string scene, filter;
  std::string out;     // path of the image, or
  std::string pixels;  // path of a list of pixels
  WeightAim aim;
};

struct PointsOptions {
  std::string pattern;
  std::int64_t n = 0;
  int dims = 2;
  std::uint64_t seed = 1;
  std::uint32_t trial = 0;
};

struct FiltersOptions {
  std::vector<std::string> filters;  // none: all of the catalogue
  bool json = false;
};

struct SpectrumOptions {
  std::string what;       // a pattern, or an image (is_image_name() in image_spectrum.h); "" with points
  std::string points;     // a file of point sets, "-" for standard input, or ""
  std::string reference;  // with an image: what to subtract, or ""
  SpectrumWindow window = SpectrumWindow::none;  // with an image
  double pixels_per_degree = kPixelsPerDegree;   // with an image
  std::int64_t n = 0;                            // with a pattern
  std::optional<std::int64_t> trials;            // with a pattern
  std::uint64_t seed = 1;
  int frequencies = 0;  // along each axis, even; 0: by the number of points
  std::string folder;   // of the files, "": none
  bool json = false;
};

struct DiscrepancyOptions {
  std::vector<std::string> patterns;  // at least one, or
  std::string points;                 // a file of point sets, "-" for standard input
  std::vector<int> n;                 // with patterns
  std::vector<std::string> measures;
  int dims = 0;  // 2 or 3; 0: 2 of patterns, and as many as a file has
  int trials = 16;
  std::uint64_t seed = 1;
  std::string method, lines, radius;  // "": as the measures themselves say
  int threads = 0;                    // 0: as many as there are cores
  bool json = false;
};

struct BenchOptions {
  std::string study;   // a file, or the name of a built-in study
  std::string folder;  // of the files, "": none
  int repeats = 5;
  int threads = 0;  // the most that are tried; 0: as many as there are cores
  bool json = false;
};

struct StressOptions {
  std::vector<std::string> families;       // none: all
  std::uint64_t cases = 2000;              // of each family, before its share
  std::optional<std::uint64_t> only_case;  // with one family: this case alone, in full
  std::uint64_t seed = 1;
  std::string folder;  // of the files, "": none
  int threads = 0;     // 0: as many as there are cores
  bool json = false;
};

struct ReportOptions {
  std::vector<std::string> runs;  // folders or .jsonl files, at least one
  std::string out;                // path of the page; "": index.html in the folder of the first run
  std::string figures;            // folder for its charts as SVG, "": none
  std::size_t budget = 0;         // bytes of the page
};

using Command =
    std::variant<TextOptions, ListOptions, RunOptions, RenderOptions, ExactOptions, PointsOptions, FiltersOptions,
                 SpectrumOptions, DiscrepancyOptions, BenchOptions, StressOptions, ReportOptions>;

Exit execute(const TextOptions& options);
Exit execute(const ListOptions& options);
Exit execute(const RunOptions& options);
Exit execute(const RenderOptions& options);
Exit execute(const ExactOptions& options);
Exit execute(const PointsOptions& options);
Exit execute(const FiltersOptions& options);
Exit execute(const SpectrumOptions& options);
Exit execute(const DiscrepancyOptions& options);
Exit execute(const BenchOptions& options);
Exit execute(const StressOptions& options);
Exit execute(const ReportOptions& options);

}  // namespace moire
