// The curves of a page.
#include "reports/page_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/args.h"
#include "core/error.h"
#include "core/parallel.h"
#include "filters/filter.h"
#include "measure/filter_curves.h"
#include "patterns/pattern.h"
#include "reports/json.h"
#include "reports/page_json.h"
#include "study/text_file.h"

namespace moire {
namespace {

// Significant digits: of curves whose overshoot and ringing are looked at closely, and of means over rings, each of
// them uncertain by percents.
constexpr int kCurveDigits = 7, kRingDigits = 5;
constexpr std::array kSetSizes = {16, 64, 256};
// Of a table of rings: some tens of kilobytes.
constexpr std::size_t kMaxRingBytes = std::size_t{16} << 20;

std::vector<std::string> names_in(const Table& rows, std::string_view column) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    const std::string_view name = row.text(column);
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
  }
  return names;
}

std::string curve_json(const Curve& curve, std::string_view x, std::string_view y) {
  JsonObject object;
  object.add(x, drawn_numbers(curve.x, kCurveDigits));
  object.add(y, drawn_numbers(curve.y, kCurveDigits));
  return std::move(object).text();
}

std::string filter_json(const Filter& filter) {
  const FilterCurves curves = filter_curves(filter);
  JsonObject object;
  object.add_text("filter", filter.text());
  object.add("radial", filter.is_radial() ? "true" : "false");
  object.add("radius", shortest(filter.radius()));
  object.add("kernel", curve_json(curves.kernel, "x", "k"));
  object.add("response", curve_json(curves.response, "f", "gain"));
  object.add("edge", curve_json(curves.edge, "x", "value"));
  return std::move(object).text();
}

// All digits: they are data.
std::string coordinates(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double v : values) texts.push_back(shortest(v));
  return json_array(texts);
}

std::string set_json(const PatternChoice& choice, int n, Draw draw) {
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> x(size), y(size), t(choice.has_time() ? size : 0);
  Pattern(choice, n, draw).fill_set({x, y, t});
  JsonObject object;
  object.add_text("pattern", choice.text());
  object.add("n", std::to_string(n));
  object.add("x", coordinates(x));
  object.add("y", coordinates(y));
  if (!t.empty()) object.add("t", coordinates(t));
  return std::move(object).text();
}

// Numbers with commas between them under a line of names: what csv() writes of a table of numbers. Throws Error.
std::string rings_json(const std::string& path) {
  const std::string text = read_bytes(path, kMaxRingBytes);
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  std::string_view rest = text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    for (std::size_t column = 0;; ++column) {
      const std::string_view field = line.substr(0, line.find(','));
      double value = std::nan("");
      if (number == 1) {
        names.emplace_back(field);
        columns.emplace_back();
      } else if (column >= names.size() || (!field.empty() && !parse_number(field, value))) {
        throw Error(path + ":" + std::to_string(number), "is no line of a table of rings");
      } else {
        columns[column].push_back(value);
      }
      if (field.size() == line.size()) break;
      line.remove_prefix(field.size() + 1);
    }
  }
  const std::size_t length = columns.empty() ? 0 : columns[0].size();
  JsonObject object;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].size() != length) throw Error(path, "is no table of rings: its lines differ in length");
    const bool none = std::all_of(columns[i].begin(), columns[i].end(), [](double v) { return std::isnan(v); });
    object.add(names[i], none ? "{\"all\":null}" : drawn_numbers(columns[i], kRingDigits));
  }
  return "{\"length\":" + std::to_string(length) + ",\"columns\":" + std::move(object).text() + "}";
}

// The radial means of a spectrum, beside its image.
std::string rings_file(const PageImage& image) { return image.file.substr(0, image.file.size() - 4) + ".csv"; }

std::string spectrum_json(const PageImage& image, const RunPlace& place) {
  const Row& row = *image.row;
  JsonObject object;
  for (const char* key : {"scene", "pattern", "layout", "filter", "estimator"}) object.add_text(key, row.text(key));
  object.add("spp", json_cell(*row.find("spp")));
  object.add("table", rings_json(place.folder + "/" + rings_file(image)));
  if (std::isfinite(row.number("peak_fx"))) {
    JsonObject peak;
    for (const char* name : {"fx", "fy", "height_db", "p"}) {
      peak.add(name, json_cell(finite_cell(row.number(std::string("peak_") + name))));
    }
    peak.add("significant", row.flag("peak_significant") ? "true" : "false");
    object.add("peak", std::move(peak).text());
  }
  return std::move(object).text();
}

}  // namespace

PageCurves page_filters(const Table& rows) {
  const std::vector<std::string> names = names_in(rows, "filter");
  std::vector<std::string> json(names.size()), faults(names.size());
  parallel_for(names.size(), [&](std::size_t i) {
    try {
      json[i] = filter_json(Filter(parse_spec(names[i], "filter \"" + names[i] + "\"")));
    } catch (const Error& e) {
      faults[i] = e.what();
    }
  });
  const auto is_empty = [](const std::string& text) { return text.empty(); };
  json.erase(std::remove_if(json.begin(), json.end(), is_empty), json.end());
  faults.erase(std::remove_if(faults.begin(), faults.end(), is_empty), faults.end());
  return {packed_json(json_array(json)), faults, {}};
}

PageCurves page_points(const Table& rows) {
  PageCurves curves;
  if (rows.empty()) return {"[]", {}, {}};
  const Cell* cell = rows.front().find("seed");
  const auto* known = cell == nullptr ? nullptr : std::get_if<std::int64_t>(cell);
  const std::uint64_t seed = known == nullptr ? 1 : static_cast<std::uint64_t>(*known);
  std::vector<std::string> sets;
  for (const std::string& name : names_in(rows, "pattern")) {
    try {
      const PatternChoice choice(parse_spec(name, "pattern \"" + name + "\""));
      for (const int n : kSetSizes) {
        if (choice.info().counts(choice.args(), n).below != n) continue;
        sets.push_back(set_json(choice, n, {seed, 0}));
      }
    } catch (const Error& e) {
      curves.faults.push_back(e.what());
    }
  }
  curves.json = packed_json(json_array(sets));
  return curves;
}

PageCurves page_spectra(std::span<const PageImage> images, const RunPlace& place, std::size_t budget) {
  PageCurves curves;
  std::vector<std::string> json;
  std::vector<const PageImage*> drawn;
  for (const PageImage& image : images) {
    if (image.kind != PageImage::Kind::spectrum) continue;
    try {
      json.push_back(spectrum_json(image, place));
      drawn.push_back(&image);
    } catch (const Error& e) {
      curves.faults.push_back(e.what());
    }
  }
  // What a spectrum takes differs little: the share that fits is near the budget's, and is cut until it does fit.
  for (std::size_t count = json.size();;) {
    curves.json = packed_json(json_array(std::span(json).first(count)));
    if (curves.json.size() <= budget || count == 0) {
      for (std::size_t i = count; i < drawn.size(); ++i)
        curves.left_out.push_back({drawn[i]->kind, rings_file(*drawn[i]), "", drawn[i]->row});
      return curves;
    }
    const double share = static_cast<double>(budget) / static_cast<double>(curves.json.size());
    count = std::min(count - 1, static_cast<std::size_t>(0.98 * share * static_cast<double>(count)));
  }
}

}  // namespace moire
