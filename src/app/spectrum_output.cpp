// What `moire spectrum` prints and writes.
#include "app/spectrum_output.h"

#include <fmt/format.h>

#include <cmath>

#include "reports/csv.h"
#include "reports/file.h"
#include "reports/json.h"
#include "reports/text_table.h"

namespace moire {
namespace {

// A cell as JSON, taken from a row that has it alone: {"x":CELL}.
std::string cell_json(const Cell& cell) {
  Row row;
  row.set("x", cell);
  const std::string text = json_row(row, "");
  return text.substr(5, text.size() - 6);
}

std::string cell_text(const Row& row, const RadialColumn& column) {
  const Cell* cell = row.find(column.cell);
  if (cell == nullptr) return "-";
  if (const auto* integer = std::get_if<std::int64_t>(cell)) return std::to_string(*integer);
  const double value = row.number(column.cell);
  if (std::fabs(value) < column.zero_below) return "0";
  return std::isfinite(value) ? fmt::format(fmt::runtime(column.format), value) : "-";
}

}  // namespace

std::string spectrum_text(const SpectrumOutput& output) {
  TextLines lines(1);
  for (const RadialColumn& column : output.columns) lines[0].push_back({column.cell, std::nan("")});
  for (const Row& row : output.radial) {
    lines.emplace_back();
    for (const RadialColumn& column : output.columns) lines.back().push_back({cell_text(row, column), std::nan("")});
  }
  std::string text = output.title + "\n" + text_table(lines, false) + "\n";
  for (const RadialColumn& column : output.columns) text += fmt::format("  {:<14} {}\n", column.cell, column.meaning);
  return text;
}

std::string spectrum_json(const SpectrumOutput& output) {
  std::string text = json_row(output.head, "");
  text.pop_back();
  if (!output.radial.empty()) {
    for (const auto& [name, unused] : output.radial.front().cells()) {
      std::string values;
      for (const Row& row : output.radial) values += (values.empty() ? "" : ",") + cell_json(*row.find(name));
      text += fmt::format(",\n {}:[{}]", cell_json(name), values);
    }
  }
  return text + "}\n";
}

void write_spectrum(const std::string& folder, const SpectrumOutput& output) {
  std::vector<float> power;
  power.reserve(output.power.size());
  for (const double p : output.power) power.push_back(static_cast<float>(p) + 0.0F);  // zero is +0
  std::vector<Attribute> attributes = {{"moire:schema", "moire.image/1"}, {"moire:kind", "spectrum"}};
  attributes.insert(attributes.end(), output.attributes.begin(), output.attributes.end());
  write_exr(folder + "/spectrum.exr", output.grid, power, attributes);
  write_png(folder + "/spectrum.png", spectrum_preview(output.grid, power, output.scale));
  write_whole(folder + "/radial.csv", csv(output.radial));
}

}  // namespace moire
