// What defines an image, as JSON text.
#include "app/definition.h"

#include <span>

#include "core/args.h"
#include "reports/json.h"

namespace moire {
namespace {

// The object without its closing brace.
std::string open_object(const Row& row) {
  std::string text = json_row(row, "");
  text.pop_back();
  return text;
}

std::string args_json(std::string_view name, std::span<const Param> params, const Args& args) {
  Row row;
  row.set("name", std::string(name));
  for (const Param& p : params) {
    const Value* value = args.find(p.name);
    if (value == nullptr) continue;
    row.set(p.name, value->is_text ? Cell(value->text) : Cell(value->numbers.at(0)));
  }
  return json_row(row, "");
}

}  // namespace

std::string scene_json(const NamedScene& scene) {
  const Grid grid = scene.image.grid();
  Row row;
  row.set("name", scene.name);
  row.set("kind", std::string(scene.image.info().name));
  row.set("width", std::int64_t{grid.width});
  row.set("height", std::int64_t{grid.height});
  std::string text = open_object(row);
  for (const auto& [name, numbers] : scene.image.stored()) {
    text += ",\"" + name + "\":[";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i > 0) text += ',';
      text += shortest(numbers[i]);
    }
    text += ']';
  }
  return text + "}";
}

std::string params_json(const PatternChoice* pattern, const Filter& filter) {
  std::string text = "{";
  if (pattern != nullptr) {
    text += "\"pattern\":" + args_json(pattern->info().name, pattern->info().params, pattern->args()) + ",";
  }
  return text + "\"filter\":" + args_json(filter.info().name, filter.info().params, filter.args()) + "}";
}

}  // namespace moire
