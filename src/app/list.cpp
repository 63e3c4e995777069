// moire list: the catalogue, from the same records that check parameters.
#include <fmt/format.h>

#include <array>
#include <span>
#include <vector>

#include "app/commands.h"
#include "app/output.h"
#include "app/studies.h"
#include "core/args.h"
#include "core/names.h"
#include "filters/filter.h"
#include "patterns/pattern.h"
#include "reports/json.h"
#include "study/discrepancy_measure.h"
#include "study/measures.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

struct Entry {
  std::string_view name, title, cite;
  std::span<const Param> params;
  int dims = 0;  // of a pattern: 2, or 3 where its points have a time
};

template <class Infos>
std::vector<Entry> entries_of(const Infos& infos) {
  std::vector<Entry> entries;
  for (const auto* info : infos) entries.push_back({info->name, info->title, info->cite, info->params});
  return entries;
}

std::vector<Entry> pattern_entries() {
  std::vector<Entry> entries = entries_of(patterns());
  for (std::size_t i = 0; i < entries.size(); ++i) entries[i].dims = patterns()[i]->has_time ? 3 : 2;
  return entries;
}

std::vector<Entry> find_entries(std::string_view what) {
  if (what == "patterns") return pattern_entries();
  if (what == "filters") return entries_of(filters());
  if (what == "scenes") return entries_of(testimages());
  if (what == "measures") {
    std::vector<Entry> entries;
    for (const MeasureInfo& m : measures()) entries.push_back({m.name, m.title, m.cite, {}});
    for (const DiscrepancyInfo& d : discrepancies()) entries.push_back({d.name, d.title, d.cite, d.params});
    return entries;
  }
  if (what == "studies") {
    std::vector<Entry> entries;
    for (const BuiltinStudy& study : builtin_studies()) {
      entries.push_back({study.name, study_title(study.text), "", {}});
    }
    return entries;
  }
  constexpr std::string_view kKnown[] = {"patterns", "filters", "scenes", "studies", "measures"};
  throw Error("WHAT", unknown_name("catalogue", what, kKnown));
}

bool is_numeric(const Param& p) { return p.kind == Param::Kind::number || p.kind == Param::Kind::integer; }

// {"name":...} without its closing brace.
std::string open_object(const Row& row) {
  std::string text = json_row(row, "");
  text.pop_back();
  return text;
}

// Names are of letters, digits and hyphens: they need no escapes.
std::string param_json(const Param& p) {
  const auto cell = [&](double value) -> Cell {
    if (p.kind == Param::Kind::integer) return static_cast<std::int64_t>(value);
    if (p.kind == Param::Kind::number) return value;
    return {};
  };
  Row row;
  row.set("name", std::string(p.name));
  if (p.required) {
    row.set("default", {});
  } else {
    row.set("default", p.kind == Param::Kind::choice ? Cell(std::string(p.text)) : cell(p.fallback));
  }
  row.set("min", cell(p.min));
  row.set("max", cell(p.max));
  std::string choices;
  for (const char c : p.choices) choices += c == '|' ? std::string("\",\"") : std::string(1, c);
  if (!choices.empty()) choices = "\"" + choices + "\"";
  return fmt::format("{},\"choices\":[{}],\"required\":{}}}", open_object(row), choices, p.required);
}

std::string entry_json(const Entry& entry) {
  Row row;
  row.set("name", std::string(entry.name));
  row.set("title", std::string(entry.title));
  row.set("cite", std::string(entry.cite));
  std::string params;
  for (const Param& p : entry.params) {
    if (!params.empty()) params += ',';
    params += param_json(p);
  }
  const std::string_view dims = entry.dims == 3 ? ",\"dims\":[2,3]" : entry.dims == 2 ? ",\"dims\":[2]" : "";
  return fmt::format("{}{},\"params\":[{}]}}", open_object(row), dims, params);
}

std::string param_text(const Param& p) {
  std::string text = fmt::format("    {:<17} ", p.name);
  if (p.required) text += "required; ";
  if (is_numeric(p)) text += fmt::format("{}, {} to {}; ", shortest(p.fallback), shortest(p.min), shortest(p.max));
  if (p.kind == Param::Kind::choice) text += fmt::format("{}, one of {}; ", p.text, p.choices);
  if (p.kind == Param::Kind::numbers && !p.required && !p.text.empty()) text += fmt::format("default {}; ", p.text);
  return text + std::string(p.help) + "\n";
}

std::string entry_text(const Entry& entry) {
  std::string text = fmt::format("{:<20} {}", entry.name, entry.title);
  if (!entry.cite.empty()) text += fmt::format(" [{}]", entry.cite);
  if (entry.dims == 3) text += "; with a time";
  text += "\n";
  for (const Param& p : entry.params) text += param_text(p);
  return text;
}

}  // namespace

Exit execute(const TextOptions& options) {
  print(options.text);
  return Exit::ok;
}

Exit execute(const ListOptions& options) {
  const std::vector<Entry> entries = find_entries(options.what);
  std::string text;
  for (const Entry& entry : entries) {
    if (options.json) {
      text += text.empty() ? "[" : ",\n ";
      text += entry_json(entry);
    } else {
      text += entry_text(entry);
    }
  }
  print(options.json ? text + "]\n" : text);
  return Exit::ok;
}

}  // namespace moire
