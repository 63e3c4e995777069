// What a hunt for the worst errors found.
#include "reports/stress_report.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "reports/markdown_table.h"
#include "reports/text_table.h"

namespace moire {
namespace {

using stress::CaseKey;
using stress::Findings;
using stress::Found;
using stress::GrowthBin;
using stress::Outcome;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// The error in units in the last place of the value.
double ulps(const Outcome& outcome) {
  const double size = std::abs(outcome.wanted);
  if (std::isnan(stress::relative_error(outcome)) || std::isinf(size)) return kNone;
  return outcome.error / (std::nextafter(size, std::numeric_limits<double>::infinity()) - size);
}

Cell integer(std::uint64_t value) { return static_cast<std::int64_t>(value); }

std::string short_text(double value) {
  if (value == 0) return "0";
  return std::isfinite(value) ? fmt::format("{:.1e}", value) : "-";
}

std::string part_text(const Row& row) {
  if (!row.text("fault").empty()) return "fault";
  const double part = row.number("error_over_bound");
  return std::isfinite(part) ? fmt::format("{:.2g}", part) : "-";
}

std::string verdict(const Row& row) { return row.flag("pass") ? "pass" : "FAIL"; }

// The cells of a family's line, the same for a terminal and for Markdown.
std::vector<std::string> line_of(const Row& row) {
  return {fmt::format("{:.0f}", row.number("cases")),
          short_text(row.number("largest_error")),
          short_text(row.number("largest_relative")),
          std::isfinite(row.number("largest_ulps")) ? fmt::format("{:.2g}", row.number("largest_ulps")) : "-",
          short_text(row.number("bound")),
          part_text(row),
          short_text(row.number("naive_error")),
          verdict(row)};
}

const std::vector<std::string> kColumns = {"cases",       "worst error", "relative", "ulps",
                                           "bound there", "of bound",    "naive",    ""};

std::string failure_line(const Row& row) {
  const std::string what = row.text("fault").empty()
                               ? fmt::format("error {:.3g}, bound {:.3g}, oracle's own {:.1g}", row.number("error"),
                                             row.number("bound"), row.number("oracle_error"))
                               : std::string(row.text("fault"));
  return fmt::format("{} case {:.0f}: {}: {}", row.text("family"), row.number("case"), what, row.text("words"));
}

}  // namespace

Table stress_rows(std::span<const Findings> findings, std::uint64_t seed) {
  Table table;
  for (const Findings& f : findings) {
    const Outcome& closest = f.closest.outcome;
    Row row;
    row.set("family", std::string(f.family->name));
    row.set("title", std::string(f.family->title));
    row.set("quantity", std::string(f.family->quantity));
    row.set("claim", std::string(f.family->claim));
    row.set("severity", std::string(f.family->severity));
    row.set("seed", integer(seed));
    row.set("cases", integer(f.cases));
    row.set("failures", integer(f.failures));
    row.set("pass", f.failures == 0);
    row.set("largest_error", finite_cell(f.largest.outcome.error));
    row.set("largest_case", integer(f.largest.index));
    row.set("largest_relative", finite_cell(stress::relative_error(f.relative.outcome)));
    row.set("largest_ulps", finite_cell(ulps(f.relative.outcome)));
    row.set("relative_case", integer(f.relative.index));
    row.set("error_over_bound", finite_cell(stress::part_of_bound(closest)));
    row.set("error", finite_cell(closest.error));
    row.set("bound", finite_cell(closest.bound));
    row.set("oracle_error", finite_cell(closest.oracle_error));
    row.set("computed", finite_cell(closest.computed));
    row.set("wanted", finite_cell(closest.wanted));
    row.set("case", integer(f.closest.index));
    row.set("words", f.family->describe({seed, f.closest.index}));
    row.set("fault", closest.fault);
    row.set("naive_error", finite_cell(f.naive_error));
    table.push_back(std::move(row));
  }
  return table;
}

Table growth_rows(std::span<const Findings> findings) {
  Table table;
  for (const Findings& f : findings) {
    for (const GrowthBin& bin : f.growth) {
      Row row;
      row.set("family", std::string(f.family->name));
      row.set("severity_lo", finite_cell(bin.severity_lo));
      row.set("severity_hi", finite_cell(bin.severity_hi));
      row.set("cases", integer(bin.cases));
      row.set("error", finite_cell(bin.error));
      row.set("bound", finite_cell(bin.bound));
      row.set("naive_error", finite_cell(bin.naive_error));
      table.push_back(std::move(row));
    }
  }
  return table;
}

Table failure_rows(std::span<const Findings> findings, std::uint64_t seed) {
  Table table;
  for (const Findings& f : findings) {
    for (const Found& found : f.failed) {
      Row row;
      row.set("family", std::string(f.family->name));
      row.set("seed", integer(seed));
      row.set("case", integer(found.index));
      row.set("error", finite_cell(found.outcome.error));
      row.set("bound", finite_cell(found.outcome.bound));
      row.set("oracle_error", finite_cell(found.outcome.oracle_error));
      row.set("computed", finite_cell(found.outcome.computed));
      row.set("wanted", finite_cell(found.outcome.wanted));
      row.set("fault", found.outcome.fault);
      row.set("words", f.family->describe({seed, found.index}));
      table.push_back(std::move(row));
    }
  }
  return table;
}

std::string stress_case_text(const stress::Family& family, CaseKey key, const Outcome& o) {
  std::string text = fmt::format("{} case {}, seed {}: {}\n{}\n", family.name, key.index, key.seed,
                                 stress::passes(o) ? "pass" : "FAIL", family.describe(key));
  if (!o.fault.empty()) text += fmt::format("  fault         {}\n", o.fault);
  text += fmt::format(
      "  computed      {:.17g}\n  oracle        {:.17g} (its own error at most {:.2g})\n  error         {:.3g}\n"
      "  bound         {:.3g}: {}\n",
      o.computed, o.wanted, o.oracle_error, o.error, o.bound, family.claim);
  if (std::isfinite(o.naive_error)) text += fmt::format("  naive error   {:.3g}\n", o.naive_error);
  return text + fmt::format("  severity      {:.3g}: {}\n", o.severity, family.severity);
}

std::string stress_text(const Table& rows, const Table& failures) {
  TextLines lines{{{"family", kNone}}};
  for (const std::string& name : kColumns) lines[0].push_back({name, kNone});
  for (const Row& row : rows) {
    lines.push_back({{std::string(row.text("family")), kNone}});
    for (const std::string& cell : line_of(row)) lines.back().push_back({cell, kNone});
  }
  std::string text = text_table(lines, false);
  text +=
      "\nworst error, absolute and relative to the value where that is above 1/1000, against an oracle in higher "
      "precision;\nof bound: the largest part of its bound that any error is, and that bound; naive: the worst of "
      "textbook formulas in double\n\n"
      "The cases that came closest to their bounds (moire stress --family NAME --case NUMBER shows one in full):\n";
  for (const Row& row : rows) {
    text += fmt::format("  {} {:.0f}: {}\n", row.text("family"), row.number("case"), row.text("words"));
  }
  for (const Row& row : failures) text += "FAIL " + failure_line(row) + "\n";
  return text;
}

std::string stress_table(const Table& rows) {
  std::vector<std::vector<std::string>> lines{{"family"}};
  lines[0].insert(lines[0].end(), kColumns.begin(), kColumns.end());
  lines[0].back() = "verdict";
  for (const Row& row : rows) {
    lines.push_back({markdown_code(row.text("family"))});
    for (const std::string& cell : line_of(row)) lines.back().push_back(cell);
  }
  return markdown_table(lines);
}

LogPlot stress_plot(std::span<const Findings> findings) {
  LogPlot plot{"error against severity", "severity of the cases, by family", "error", 3, {}};
  for (const Findings& f : findings) {
    PlotPanel panel{std::string(f.family->name) + ": " + std::string(f.family->severity),
                    {{"error", {}}, {"naive arithmetic", {}}, {"bound", {}}}};
    for (const GrowthBin& bin : f.growth) {
      const double severity = std::sqrt(bin.severity_lo * bin.severity_hi);
      panel.series[0].points.push_back({severity, bin.error, 0, 0, false});
      panel.series[1].points.push_back({severity, bin.naive_error, 0, 0, false});
      panel.series[2].points.push_back({severity, bin.bound, 0, 0, false});
    }
    plot.panels.push_back(std::move(panel));
  }
  return plot;
}

std::string stress_markdown(const Table& rows, const Table& failures, const Tool& tool, const Host& host,
                            std::string_view plot) {
  std::string out = "# How far to trust the numbers\n\n";
  out += fmt::format("{}; {}, {}, {}.\n\n", host.cpu, tool.compiler, tool.build_type, tool.flags);
  out +=
      "Every case is computed twice: by the program, and by an oracle that shares no method with it, in higher "
      "precision. A case passes when its error is within the bound that the program claims; where the oracle itself "
      "may err, by so much more.\n\n" +
      stress_table(rows) +
      "*of bound*: the largest part of its bound that any error is, and the bound there. *naive*: the worst error of "
      "the textbook formula in plain double arithmetic over the same cases.\n\n";
  if (!failures.empty()) {
    out += "## Failures\n\n";
    for (const Row& row : failures) out += "- " + failure_line(row) + "\n";
    out += "\n";
  }
  out += fmt::format("## How errors grow\n\n![largest error, naive error and bound against severity]({})\n\n", plot);
  out += "## The families\n\n";
  for (const Row& row : rows) {
    out += fmt::format(
        "### {}\n\n{}. Value: {}. Bound: {}. Severity: {}.\n\nClosest to its bound, `moire stress --family {} --case "
        "{:.0f} --seed {:.0f}`: computed {:.17g}, oracle {:.17g}.\n\n`{}`\n\n",
        row.text("family"), row.text("title"), row.text("quantity"), row.text("claim"), row.text("severity"),
        row.text("family"), row.number("case"), row.number("seed"), row.number("computed"), row.number("wanted"),
        row.text("words"));
  }
  return out;
}

}  // namespace moire
