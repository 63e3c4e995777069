// A study of discrepancies: its results, pictures and report.
#include "app/run_discrepancies.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/interrupt.h"
#include "app/output.h"
#include "app/page.h"
#include "app/progress.h"
#include "app/run_folder.h"
#include "core/error.h"
#include "core/parallel.h"
#include "measure/discrepancy/test_lines.h"
#include "reports/csv.h"
#include "reports/discrepancy_report.h"
#include "reports/file.h"
#include "reports/point_plot.h"
#include "study/discrepancy_run.h"
#include "study/discrepancy_summary.h"
#include "study/file_names.h"
#include "study/row_keys.h"

namespace moire {
namespace {

constexpr auto kReports =
    std::to_array<std::string_view>({"results.csv", "summary.csv", "slopes.csv", "report.md", "index.html"});

// Larger sets are no dots any more.
constexpr int kMostDrawn = 2048;
// Pictures of sets in a report.
constexpr std::size_t kMostPictures = 100;
// Bytes of a picture's name; file systems take 255, with the ending of a temporary file.
constexpr std::size_t kMaxPictureName = 240;
// Lines of a picture, as in the paper.
constexpr int kDrawnLines = 100;

std::string points_file(const DiscrepancyStudy& study, const DiscrepancyGroup& group) {
  const DiscrepancyBlock& block = study.blocks[group.block];
  return fmt::format("images/points_{}_{}{}.png", file_part(block.patterns[group.pattern].text()), block.n[group.n],
                     block.dims[group.dims] == 3 ? "_t" : "");
}

// The sets that are drawn, in the order of the plan: what they show, their file and the group.
struct Drawn {
  std::string what, file;
  std::size_t first_row;  // of the group
};

std::vector<Drawn> drawn_sets(const DiscrepancyStudy& study, const DiscrepancyPlan& plan) {
  std::vector<Drawn> drawn;
  std::set<std::string> files;
  for (const DiscrepancyGroup& group : plan.groups) {
    const DiscrepancyBlock& block = study.blocks[group.block];
    if (!study.images || block.n[group.n] > kMostDrawn || drawn.size() >= kMostPictures) continue;
    std::string file = points_file(study, group);
    if (!files.insert(file).second) continue;
    if (file.size() > kMaxPictureName) {
      throw Error("images",
                  fmt::format("the pattern \"{}...\" makes a file name above {} bytes; shorten it, or set images "
                              "= \"none\"",
                              block.patterns[group.pattern].text().substr(0, 60), kMaxPictureName));
    }
    drawn.push_back({fmt::format("`{}`, {} points{}", block.patterns[group.pattern].text(), block.n[group.n],
                                 block.dims[group.dims] == 3 ? ", time from blue to red" : ""),
                     std::move(file), group.first_row});
  }
  return drawn;
}

// Lines as the study's edge discrepancies draw them, and their duals.
std::vector<Picture> draw_lines(const DiscrepancyStudy& study, const RunFolder& folder) {
  std::vector<Picture> pictures;
  if (!study.images) return pictures;
  const auto names = [&](std::string_view name) {
    for (const DiscrepancyBlock& block : study.blocks)
      for (const DiscrepancyChoice& measure : block.measures)
        if (measure.info().name == name) return true;
    return false;
  };
  const auto draw = [&](std::string_view measure, LineLaw law, const char* what, const char* file) {
    if (!names(measure)) return;
    std::vector<PlotLine> lines;
    const Key key = pixel_key(draw_hash(study.seed, 0), {});
    for (std::uint64_t i = 0; i < kDrawnLines; ++i) {
      const TestLine line = test_line(law, key, i);
      lines.push_back({line.nx, line.ny, line.c});
    }
    write_png(folder.file(file), line_plot(lines));
    pictures.emplace_back(
        fmt::format("{} {} lines, and each line y = m x + b as the point (m, b), m to the right, b upwards, "
                    "both from -4 to 5 with their axes; steeper lines are beyond",
                    kDrawnLines, what),
        file);
  };
  draw("edge-l2", LineLaw::isotropic, "isotropic", "images/lines_isotropic.png");
  draw("edge-l2-printed", LineLaw::printed, "of the paper's", "images/lines_printed.png");
  return pictures;
}

}  // namespace

Exit run_study(const RunOptions& options, const DiscrepancyStudy& study) {
  const DiscrepancyPlan planned = plan(study);
  const std::vector<Drawn> drawn = drawn_sets(study, planned);
  PlannedRows rows{study.seed, row_keys(study, planned), set_row_key};
  if (options.dry_run) {
    print(fmt::format("# {} rows: pattern n dims measure trial\n", planned.rows));
    for (const std::string& key : rows.keys) print(key + "\n");
    return Exit::ok;
  }
  const ThreadLimit limit(options.threads);
  RunFolder folder(options, {study.name, study.text}, rows, kReports, study.images);

  watch_interrupts();
  Results outcome;
  {
    Progress progress;
    DiscrepancyObserver observer;
    observer.row = [&](const Row& row) { folder.append(row); };
    const auto file_of = [&](const DiscrepancyGroup& group) {
      const auto at =
          std::find_if(drawn.begin(), drawn.end(), [&](const Drawn& d) { return d.first_row == group.first_row; });
      return at == drawn.end() ? std::string() : folder.file(at->file);
    };
    observer.wants_first_set = [&](const DiscrepancyGroup& group) {
      const std::string file = file_of(group);
      return !file.empty() && !(folder.goes_on() && std::filesystem::exists(file));
    };
    observer.first_set = [&](const DiscrepancyGroup& group, const PointView& set) {
      write_png(file_of(group), point_plot(set.x, set.y, set.t));
    };
    observer.progress = [&](std::size_t done, std::size_t due) {
      progress.step(done, due, static_cast<double>(done) / static_cast<double>(due));
    };
    observer.stop = interrupted;
    outcome = run(study, planned, observer, folder.take_rows());
  }
  folder.finish(outcome.rows, outcome.complete);

  const DiscrepancySummary summary = summarize(study, planned, outcome.rows);
  write_whole(folder.file("results.csv"), csv(outcome.rows));
  write_whole(folder.file("summary.csv"), csv(summary.rows));
  write_whole(folder.file("slopes.csv"), csv(summary.slopes));
  std::vector<Picture> pictures;
  for (const Drawn& d : drawn) pictures.emplace_back(d.what, d.file);
  for (Picture& picture : draw_lines(study, folder)) pictures.push_back(std::move(picture));
  const std::string report = folder.file("report.md");
  write_whole(report, discrepancy_markdown(study.name, summary, pictures));
  print(discrepancy_text(summary, ::isatty(STDOUT_FILENO) != 0));
  print("report: " + report + "\n");
  write_run_page({folder.header(), folder.path(), std::move(outcome.rows), page_tables(summary)});
  return Exit::ok;
}

}  // namespace moire
