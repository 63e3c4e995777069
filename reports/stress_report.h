// What a hunt for the worst errors found: as tables, for a terminal, as Markdown and as a plot.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "reports/log_plot.h"
#include "reports/provenance.h"
#include "stress/hunt.h"
#include "study/results.h"

namespace moire {

// One row per family: family, title, quantity, claim, severity, seed, cases, failures, pass; the largest error and its
// case; the largest error relative to the value, the same in units in the last place, and its case; the case whose
// error is the largest part of what it may be, with its bound, the oracle's own error, both values and the case in
// words; and the largest error of naive arithmetic.
Table stress_rows(std::span<const stress::Findings> findings, std::uint64_t seed);

// One row per family and half decade of severity: cases, the largest error, bound and error of naive arithmetic.
Table growth_rows(std::span<const stress::Findings> findings);

// One row per failed case that was kept: family, case, error, bound, oracle_error, fault, and the case in words.
Table failure_rows(std::span<const stress::Findings> findings, std::uint64_t seed);

// One case of a family in full, for a terminal.
std::string stress_case_text(const stress::Family& family, stress::CaseKey key, const stress::Outcome& outcome);

// Tables of stress_rows() and failure_rows().
std::string stress_text(const Table& rows, const Table& failures);
// The table of the README: Markdown.
std::string stress_table(const Table& rows);

// One panel per family: the largest error, naive error and bound against severity.
LogPlot stress_plot(std::span<const stress::Findings> findings);

// report.md; `plot` is the file of the plot, relative to the report.
std::string stress_markdown(const Table& rows, const Table& failures, const Tool& tool, const Host& host,
                            std::string_view plot);

}  // namespace moire
