// What a benchmark says: time against error for a terminal, as Markdown and as a plot.
#pragma once

#include <string>
#include <string_view>

#include "reports/log_plot.h"
#include "reports/provenance.h"
#include "study/benchmark.h"

namespace moire {

// Per scene and filter one table of patterns by samples per pixel: time per active pixel and RMSE, `*` where the Pareto
// front runs, and the cost exponent. Then what skipping saves, and what threads bring.
std::string bench_text(const Benchmark& benchmark, const Host& host);

// One panel per scene, filter and estimator: RMSE over active pixels against render time per active pixel, one series
// per pattern. The panels of a scene stand in one line.
LogPlot bench_plot(std::string_view study_name, const Table& rows);

// report.md; `plot` is the file of the plot, relative to the report. It is made of times: no two runs give the same.
std::string bench_markdown(std::string_view study_name, const Benchmark& benchmark, const Tool& tool, const Host& host,
                           std::string_view plot);

}  // namespace moire
