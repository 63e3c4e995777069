// The report of a study of discrepancies.
#include "reports/discrepancy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/markdown_table.h"
#include "reports/text_table.h"

namespace moire {
namespace {

constexpr const char kNone[] = "-";

// The rows of one measure and number of dimensions.
struct Section {
  std::string measure;
  double dims = 2;
  std::vector<const Row*> rows;
  bool is_exact = false;                                     // D_N, not T_N
  std::string name() const { return is_exact ? "D" : "T"; }  // of the values
  std::string space() const { return dims == 3 ? "x, y, t" : ""; }
};

std::vector<std::string> patterns_of(const Section& section) {
  std::vector<std::string> patterns;
  for (const Row* row : section.rows) {
    const std::string pattern(row->text("pattern"));
    if (std::find(patterns.begin(), patterns.end(), pattern) == patterns.end()) patterns.push_back(pattern);
  }
  return patterns;
}

std::vector<Section> sections(const Table& rows) {
  std::vector<Section> all;
  for (const Row& row : rows) {
    const auto same = [&](const Section& s) {
      return s.measure == row.text("measure") && s.dims == row.number("dims");
    };
    auto at = std::find_if(all.begin(), all.end(), same);
    if (at == all.end()) {
      all.push_back({std::string(row.text("measure")), row.number("dims"), {}, row.text("method") == "exact"});
      at = all.end() - 1;
    }
    at->rows.push_back(&row);
  }
  // Pattern by pattern, in order of appearance, and by size.
  for (Section& section : all) {
    const auto patterns = patterns_of(section);
    const auto key = [&](const Row* row) {
      const auto at = std::find(patterns.begin(), patterns.end(), row->text("pattern"));
      return std::pair(at - patterns.begin(), row->number("n"));
    };
    std::stable_sort(section.rows.begin(), section.rows.end(),
                     [&](const Row* a, const Row* b) { return key(a) < key(b); });
  }
  return all;
}

std::string number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : kNone;
}

std::string interval(const Row& row, const char* lo, const char* hi, const char* format) {
  if (!std::isfinite(row.number(lo))) return "";
  return " [" + number(row.number(lo), format) + ", " + number(row.number(hi), format) + "]";
}

// "1 of the paper" where the rows have values of a table.
std::string table_name(const Section& section) {
  for (const Row* row : section.rows) {
    if (std::isfinite(row->number("table"))) return fmt::format("table {:.0f} of the paper", row->number("table"));
  }
  return "";
}

std::string heading(const Section& section) {
  std::string text = "`" + section.measure + "`";
  if (section.dims == 3) text += ", points in " + section.space();
  const std::string table = table_name(section);
  if (!table.empty()) text += ": " + table;
  return text;
}

std::string agreement(const Row& row) {
  if (const Cell* same = row.find("paper_as_printed"); same != nullptr && std::holds_alternative<bool>(*same)) {
    return std::get<bool>(*same) ? "as printed" : "not as printed";
  }
  return number(row.number("paper_z"), "{:+.1f}");
}

// What is doubtful of all cells of the paper's table alike; "" when they differ.
std::string common_doubt(const Section& section) {
  std::string doubt;
  for (const Row* row : section.rows) {
    if (!std::isfinite(row->number("paper"))) continue;
    if (doubt.empty()) doubt = row->text("paper_doubt");
    if (doubt != row->text("paper_doubt")) return "";
  }
  return doubt;
}

void add_section(std::string& out, const Section& section) {
  out += "### " + heading(section) + "\n\n";
  const std::string doubt = common_doubt(section);
  if (!doubt.empty()) out += "The printed values: " + doubt + ".\n\n";
  const bool paper = !table_name(section).empty();
  const auto has = [&](const char* cell) {
    return std::any_of(section.rows.begin(), section.rows.end(),
                       [&](const Row* row) { return std::isfinite(row->number(cell)); });
  };
  const bool theory = has("expected_rms"), sets = has("stderr");
  const bool doubts = paper && doubt.empty() &&
                      std::any_of(section.rows.begin(), section.rows.end(),
                                  [](const Row* row) { return !row->text("paper_doubt").empty(); });
  std::vector<std::string> head{"pattern", "N"};
  if (paper) head.push_back("paper");
  head.push_back((section.is_exact ? "D" : "mean T") + std::string(sets ? " [95%]" : ""));
  if (!section.is_exact) head.push_back("RMS T");
  if (sets) head.push_back("standard error");
  if (theory) head.insert(head.end(), {"RMS by theory", "z"});
  if (paper) head.push_back("z of the paper");
  if (doubts) head.push_back("doubt");
  std::vector<std::vector<std::string>> lines{head};
  for (const Row* row : section.rows) {
    std::vector<std::string> line{markdown_code(row->text("pattern")), number(row->number("n"), "{:.0f}")};
    if (paper) line.push_back(number(row->number("paper"), "{:.3g}"));
    line.push_back(number(row->number("mean"), "{:.5g}") + interval(*row, "mean_lo", "mean_hi", "{:.3g}"));
    if (!section.is_exact) line.push_back(number(row->number("rms"), "{:.5g}"));
    if (sets) line.push_back(number(row->number("stderr"), "{:.2g}"));
    if (theory) {
      line.push_back(number(row->number("expected_rms"), "{:.5g}"));
      line.push_back(number(row->number("expected_z"), "{:+.1f}"));
    }
    if (paper) line.push_back(agreement(*row));
    if (doubts) line.emplace_back(row->text("paper_doubt"));
    lines.push_back(std::move(line));
  }
  out += markdown_table(lines);
  if (!paper) return;
  double sum = 0;
  int cells = 0;
  for (const Row* row : section.rows) {
    const double z = row->number("paper_z");
    if (!std::isfinite(z)) continue;
    sum += z * z;
    ++cells;
  }
  if (cells > 1) out += fmt::format("Sum of z^2 of the paper over {} cells: {:.0f}.\n\n", cells, sum);
}

void add_slopes(std::string& out, const Table& slopes) {
  if (slopes.empty()) return;
  out +=
      "## How fast they fall\n\nSlope of log RMS T against log N, with its 95% interval over sets. Where sizes have "
      "different numbers of sets, the "
      "slope is of as many of each size.\n\n";
  std::vector<std::vector<std::string>> lines{{"measure", "dimensions", "pattern", "N", "sets", "slope", "theory", ""}};
  for (const Row& row : slopes) {
    lines.push_back({markdown_code(row.text("measure")), number(row.number("dims"), "{:.0f}"),
                     markdown_code(row.text("pattern")),
                     fmt::format("{:.0f} to {:.0f}", row.number("n_min"), row.number("n_max")),
                     number(row.number("trials"), "{:.0f}"),
                     number(row.number("slope"), "{:.3f}") + interval(row, "slope_lo", "slope_hi", "{:.3f}"),
                     number(row.number("known"), "{:.2f}") + (row.text("known_is") == "at best" ? " at best" : ""),
                     std::string(row.text("why"))});
  }
  out += markdown_table(lines);
}

void add_notes(std::string& out, const std::vector<Section>& all) {
  out += "## How to read this\n\n";
  out +=
      "- T is the root of the mean over all tests (boxes, half-planes, disks) of (fraction of points inside - area)^2; "
      "D is the largest difference. Of a pattern that varies, the mean and the root mean square over its sets are "
      "given: they differ by a few per cent.\n"
      "- z: the difference over its standard error; of theory, by the mean of T^2. T^2 is skewed, so that z below -2 "
      "is "
      "commoner than above 2 with few sets; patterns and sizes share random numbers, so that their z are not "
      "independent. Patterns that do not vary are one set, without an interval.\n";
  const bool paper = std::any_of(all.begin(), all.end(), [](const Section& s) { return !table_name(s).empty(); });
  if (!paper) return;
  out +=
      "- The paper: D. P. Mitchell, \"Ray tracing and irregularities of distribution\", 1992. Its tables hold means of "
      "T over 100 sets; z of the paper counts the errors of both, and the rounding of its digits.\n"
      "- Tables 1 and 2: the rows of random points are the formula sqrt((2^-k - 3^-k) / N), an RMS, among rows of "
      "means.\n"
      "- Table 3: the paper does not say how its disks are drawn. Its row of random points needs a mean A (1 - A) of "
      "about .16, and its jittered row more boundary than one disk on the torus can have: probably each test was a set "
      "of some tens of small disks. Here: one disk, centre uniform, radius uniform from 0 to 1/2. The paper's ranking "
      "of Zaremba's points behind dart-throwing and jitter does not come out so.\n"
      "- Table 4: with one point of each set left out of the count, but N in the division, the sum of z^2 comes near "
      "the number of cells; with all points it is far above, and worst at N = 16. (`counted=without-first` is that "
      "mode.)\n"
      "- Table 4's lines: the printed generator favours lines near 45 degrees (density sec^2 where isotropic lines "
      "have |cos| + |sin|). `edge-l2` has isotropic lines; the two differ by a few per cent.\n";
}

}  // namespace

std::string discrepancy_markdown(std::string_view study_name, const DiscrepancySummary& summary,
                                 const std::vector<Picture>& pictures) {
  std::string out = "# " + std::string(study_name) + "\n\n## The answer\n\n";
  const std::vector<Section> all = sections(summary.rows);
  for (const Section& section : all) add_section(out, section);
  add_slopes(out, summary.slopes);
  if (!pictures.empty()) {
    out += "## Pictures\n\n";
    for (const auto& [what, file] : pictures) out += fmt::format("### {}\n\n![{}]({})\n\n", what, what, file);
  }
  add_notes(out, all);
  return out;
}

std::string discrepancy_text(const DiscrepancySummary& summary, bool bold) {
  std::string out;
  for (const Section& section : sections(summary.rows)) {
    const bool paper = !table_name(section).empty();
    std::map<double, bool> sizes;  // and whether the paper has them
    for (const Row* row : section.rows) sizes[row->number("n")] |= std::isfinite(row->number("paper"));
    TextLines lines{{{"pattern", std::nan("")}}};
    for (const auto& [n, printed] : sizes) {
      lines[0].push_back({fmt::format("N = {:.0f}", n), std::nan("")});
      if (printed) lines[0].push_back({"paper", std::nan("")});
    }
    for (const std::string& pattern : patterns_of(section)) {
      lines.push_back({{pattern, std::nan("")}});
      for (const auto& [n, printed] : sizes) {
        const auto at = std::find_if(section.rows.begin(), section.rows.end(), [&, size = n](const Row* row) {
          return row->text("pattern") == pattern && row->number("n") == size;
        });
        const Row* row = at == section.rows.end() ? nullptr : *at;
        const bool as_rms = row != nullptr && row->text("paper_is") == "rms";
        const double mean = row == nullptr ? std::nan("") : row->number(as_rms ? "rms" : "mean");
        const double competes = patterns_of(section).size() > 1 ? mean : std::nan("");
        lines.back().push_back({number(mean, "{:.3g}") + (as_rms ? " rms" : ""), competes});
        if (!printed) continue;
        const double value = row == nullptr ? std::nan("") : row->number("paper");
        lines.back().push_back({number(value, "{:.3g}"), std::nan("")});
      }
    }
    out += fmt::format("{}{}{}: {}\n", section.measure, section.dims == 3 ? ", points in " + section.space() : "",
                       paper ? ", " + table_name(section) : "",
                       section.is_exact ? "D, mean over sets" : "T, mean over sets");
    out += text_table(lines, bold) + "\n";
  }
  return out;
}

}  // namespace moire
