// The tables that a person reads: the terminal's and the Markdown report.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "reports/markdown.h"
#include "reports/terminal.h"

namespace moire {
namespace {

// Two patterns, one scene, two filters, spp 1 to 16, two trials; jittered is better from 4 on, equal at 1.
Table small_study() {
  Table rows;
  for (const std::string pattern : {"random", "jittered:amount=0.5"}) {
    for (const std::int64_t spp : {1, 4, 16}) {
      for (const std::string filter : {"box", "tent"}) {
        for (const std::int64_t trial : {0, 1}) {
          const double slope = pattern == "random" ? -0.5 : -0.75;
          const double rmse = (0.3 + 0.01 * static_cast<double>(trial)) * std::pow(static_cast<double>(spp), slope);
          Row row;
          row.set("scene", std::string("edge"));
          row.set("pattern", pattern);
          row.set("spp", spp);
          row.set("filter", filter);
          row.set("estimator", std::string("ratio"));
          row.set("trial", trial);
          row.set("width", std::int64_t{64});
          row.set("height", std::int64_t{48});
          row.set("seed", std::int64_t{1});
          row.set("time_render_ns", std::int64_t{12345});
          row.set("mse_active", rmse * rmse);
          row.set("rmse_active", rmse);
          row.set("max_abs_active", 2 * rmse);
          row.set("max_x_active", std::int64_t{10 + trial});
          row.set("max_y_active", std::int64_t{20});
          row.set("max_got_active", 0.5 + rmse);
          row.set("max_want_active", 0.5 - rmse);
          row.set("status", std::string("ok"));
          if (trial == 0) row.set("image_error_png", "images/edge_" + filter + std::to_string(spp) + ".error.png");
          rows.push_back(row);
        }
      }
    }
  }
  return rows;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST_SUITE("unit") {
  TEST_CASE("the terminal shows pattern by spp, and marks the best of each column, ties too") {
    const std::string text = terminal_tables(summarize(small_study()), false);
    CAPTURE(text);
    CHECK(count(text, "edge, box\n") == 1);
    CHECK(count(text, "edge, tent\n") == 1);
    // RMSE over trials is sqrt((0.3^2 + 0.31^2) / 2) = 0.30504 at 1 spp, alike for both patterns.
    CHECK(text.find("random               3.05e-01* 1.53e-01  7.63e-02  -0.50 +-0.00\n") != std::string::npos);
    CHECK(text.find("jittered:amount=0.5  3.05e-01* 1.08e-01* 3.81e-02* -0.75 +-0.00*\n") != std::string::npos);
    CHECK(text.find('\x1b') == std::string::npos);
    const std::string bold = terminal_tables(summarize(small_study()), true);
    CHECK(count(bold, "\x1b[1m") == count(text, "*") - 1);  // the legend's own star is plain
    CHECK(count(bold, "\x1b[1m") == count(bold, "\x1b[0m"));
    CHECK(terminal_tables({}, true).empty());
  }

  TEST_CASE("missing and reference-limited values show as such") {
    Table rows = small_study();
    for (Row& row : rows) {
      if (row.number("spp") == 16 && row.text("pattern") == "random") row.set("rmse_active", {});
      if (row.number("spp") == 4) row.set("reference_limited", true);
    }
    const std::string text = terminal_tables(summarize(rows), false);
    CAPTURE(text);
    CHECK(text.find(" 1.08e-01~*") != std::string::npos);
    CHECK(text.find(" - ") != std::string::npos);
    const std::string report = markdown_report("s", rows, summarize(rows));
    CHECK(report.find("1.08e-01 [") != std::string::npos);
    CHECK(report.find("4 (reference limited)") != std::string::npos);
  }

  TEST_CASE("the report gives the ranking first, then a section per pattern with interval, slope, worst pixel, image") {
    const Table rows = small_study();
    const std::string report = markdown_report("my study", rows, summarize(rows));
    CAPTURE(report);
    CHECK(report.rfind("# my study\n\n## The answer: patterns by error at 16 samples per pixel\n", 0) == 0);
    CHECK(report.find("| 1 | `jittered:amount=0.5` 3.81e-02 | `jittered:amount=0.5` 3.81e-02 |") != std::string::npos);
    CHECK(report.find("| 2 | `random` 7.63e-02 |") != std::string::npos);
    CHECK(count(report, "\n## `random`\n") == 1);
    CHECK(count(report, "\n## `jittered:amount=0.5`\n") == 1);
    CHECK(report.find("- scene `edge`: 64 x 48 pixels\n") != std::string::npos);
    CHECK(report.find("| 16 | 7.63e-02 [") != std::string::npos);
    CHECK(report.find("| slope | -0.500 [-0.500, -0.500] |") != std::string::npos);
    // The second trial is the worse one.
    CHECK(report.find("| worst pixel | (11, 20): got 0.577500, exact 0.422500 |") != std::string::npos);
    CHECK(report.find("![error](images/edge_box16.error.png)") != std::string::npos);
    CHECK(report.find("![image]") == std::string::npos);
    CHECK(report.find("12345") == std::string::npos);
    CHECK(markdown_report("none", {}, {}) == "# none\n\nNo rows.\n");
  }

  TEST_CASE("families of random lines are shown as groups, and a first paragraph compares their rates") {
    Table rows;
    for (const std::string family : {"tilted", "upright"}) {
      for (const int line : {0, 1, 2}) {
        for (Row row : small_study()) {
          if (row.text("filter") != "box" || row.number("trial") != 0) continue;
          row.set("scene", family + ":line=" + std::to_string(line));
          const bool steep = family == "upright" && row.text("pattern") == "random";
          const double rmse = row.number("rmse_active") * (steep ? std::pow(row.number("spp"), -0.5) : 1) * (1 + line);
          row.set("mse_active", rmse * rmse);
          row.set("rmse_active", rmse);
          row.set("max_abs_active", 2 * rmse);
          row.set("n_pixels_active", std::int64_t{50});
          rows.push_back(row);
        }
      }
    }
    const Summary summary = summarize(rows);
    const std::string report = markdown_report("edges", rows, summary), screen = terminal_tables(summary, false);
    CAPTURE(report);
    CAPTURE(screen);
    const std::string first =
        "Random edges, `box`: with N samples per pixel the error falls as N^s. On `tilted` / `upright` s is "
        "-0.50 / -1.00 for `random` (95% intervals apart); and -0.75 / -0.75 for `jittered:amount=0.5` (95% intervals "
        "meet).\n";
    CHECK(report.rfind("# edges\n\n" + first, 0) == 0);
    CHECK(report.find("| slope, `box` | `tilted` | `upright` |") != std::string::npos);
    CHECK(report.find("- scene `tilted`: 64 x 48 pixels, 3 random edges\n") != std::string::npos);
    CHECK(report.find("| worst pixel | (10, 20) of `tilted:line=2`: got ") != std::string::npos);
    CHECK(count(report, "### `upright`\n") == 1);
    CHECK(count(report, ":line=0") == 0);
    CHECK(screen.rfind("Random edges, box: with N samples", 0) == 0);
    CHECK(count(screen, "tilted, box\n") == 1);
    CHECK(count(screen, ":line=") == 0);
    std::size_t begin = 0;
    for (std::size_t end; begin < screen.find("\n\n"); begin = end + 1) {
      end = screen.find('\n', begin);
      CHECK(end - begin <= 110);
    }
    // One family alone has nothing to be compared with.
    std::erase_if(rows, [](const Row& row) { return row.text("scene").substr(0, 6) == "tilted"; });
    CHECK(markdown_report("edges", rows, summarize(rows)).rfind("# edges\n\n## The answer", 0) == 0);
  }

  TEST_CASE("every line of a table has as many bars as its header, whatever the names hold") {
    Table rows = small_study();
    for (Row& row : rows) {
      row.set("pattern", "a|b" + std::string(row.text("pattern")));
      if (row.text("filter") == "tent") row.set("estimator", std::string("control-variate"));
    }
    const std::string report = markdown_report("s", rows, summarize(rows));
    CHECK(report.find("`tent, control-variate`") != std::string::npos);
    std::size_t bars = 0;
    for (std::size_t begin = 0; begin < report.size();) {
      const std::size_t end = std::min(report.find('\n', begin), report.size());
      const std::string line = report.substr(begin, end - begin);
      begin = end + 1;
      if (line.empty() || line[0] != '|') {
        bars = 0;
        continue;
      }
      const std::size_t here = count(line, "|") - count(line, "\\|");
      if (bars != 0) CHECK(here == bars);
      bars = here;
    }
  }
}

}  // namespace
}  // namespace moire
