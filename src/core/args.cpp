// Checking what was given against a plug-in's table of parameters.
#include "core/args.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/names.h"

namespace moire {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// What names in reports must not have; a path is part of a plug-in's name there.
bool breaks_names(char c) { return (c >= 0 && c < ' ') || c == '\x7f' || c == '`'; }

std::string range_of(const Param& p) { return shortest(p.min) + " to " + shortest(p.max); }

// The given value as the parameter's type, or Error.
Value checked(std::string_view owner, const Param& p, Value v, const std::string& place) {
  const std::string what = std::string(owner) + ": parameter \"" + std::string(p.name) + "\" ";
  switch (p.kind) {
    case Param::Kind::number:
    case Param::Kind::integer: {
      double x = 0;
      if (v.is_text) {
        if (!parse_number(v.text, x)) {
          throw Error(place, what + "is not a number: \"" + v.text + "\"; give a number, " + range_of(p));
        }
      } else if (v.rank == 0 && v.numbers.size() == 1) {
        x = v.numbers[0];
      } else {
        throw Error(place, what + "is a list; give one number, " + range_of(p));
      }
      if (p.kind == Param::Kind::integer && x != std::floor(x)) {
        throw Error(place, what + "is not a whole number: " + shortest(x) + "; give one, " + range_of(p));
      }
      if (!(x >= p.min && x <= p.max)) throw Error(place, what + "is " + shortest(x) + "; it must be " + range_of(p));
      v.numbers = {x};
      v.rank = 0;
      v.is_text = false;
      return v;
    }
    case Param::Kind::choice: {
      const auto names = split(p.choices, '|');
      if (!v.is_text) throw Error(place, what + "must be a word: " + join(names));
      if (std::find(names.begin(), names.end(), v.text) == names.end()) {
        throw Error(place, std::string(owner) + ": parameter \"" + std::string(p.name) +
                               "\": " + unknown_name("value", v.text, names));
      }
      return v;
    }
    case Param::Kind::path:
      if (!v.is_text || v.text.empty()) throw Error(place, what + "must be a file's path");
      if (std::any_of(v.text.begin(), v.text.end(), breaks_names)) {
        throw Error(place, what + "is a path with a line break, control character or backquote; rename the file");
      }
      return v;
    case Param::Kind::numbers:
      if (v.is_text) throw Error(place, what + "must be numbers, not text; " + std::string(p.help));
      for (const double x : v.numbers) {
        if (!std::isfinite(x)) throw Error(place, what + "has a value that is not finite: " + shortest(x));
      }
      return v;
  }
  return v;
}

const Value& require(const Args& args, std::string_view name) {
  const Value* v = args.find(name);
  if (v == nullptr) throw Error(args.place(), "parameter \"" + std::string(name) + "\" has no value");
  return *v;
}

}  // namespace

Args::Args(std::string_view owner, std::span<const Param> params, const Given& given, std::string_view place)
    : place_(place) {
  std::vector<std::string_view> known;
  for (const Param& p : params) known.push_back(p.name);
  const auto place_of = [&](const Value& v) { return v.place.empty() ? std::string(place) : v.place; };
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto& [key, value] = given[i];
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      if (known.empty()) {
        throw Error(place_of(value), std::string(owner) + " takes no parameters, but \"" + key + "\" is given");
      }
      throw Error(place_of(value), std::string(owner) + ": " + unknown_name("parameter", key, known));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (given[j].first == key) throw Error(place_of(value), std::string(owner) + ": \"" + key + "\" is given twice");
    }
  }
  for (const Param& p : params) {
    const auto it = std::find_if(given.begin(), given.end(), [&](const auto& g) { return g.first == p.name; });
    if (it != given.end()) {
      given_.emplace_back(p.name);
      values_.emplace_back(p.name, checked(owner, p, it->second, place_of(it->second)));
    } else if (p.required) {
      throw Error(std::string(place),
                  std::string(owner) + " needs \"" + std::string(p.name) + "\": " + std::string(p.help));
    } else if (p.kind == Param::Kind::number || p.kind == Param::Kind::integer) {
      Value v;
      v.numbers = {p.fallback};
      v.is_text = false;
      values_.emplace_back(p.name, v);
    } else if (p.kind == Param::Kind::choice) {
      Value v;
      v.text = std::string(p.text);
      values_.emplace_back(p.name, v);
    }
  }
}

const Value* Args::find(std::string_view name) const {
  for (const auto& [key, value] : values_) {
    if (key == name) return &value;
  }
  return nullptr;
}

bool Args::given(std::string_view name) const { return std::find(given_.begin(), given_.end(), name) != given_.end(); }

double Args::number(std::string_view name) const { return require(*this, name).numbers.at(0); }
std::int64_t Args::integer(std::string_view name) const { return static_cast<std::int64_t>(number(name)); }
std::string_view Args::text(std::string_view name) const { return require(*this, name).text; }
std::string Args::path(std::string_view name) const {
  const Value& v = require(*this, name);
  return (std::filesystem::path(v.folder) / v.text).string();
}

Spec parse_spec(std::string_view text, std::string_view place) {
  Spec spec;
  spec.text = std::string(text);
  spec.place = std::string(place);
  const std::size_t colon = std::min(text.find(':'), text.size());
  spec.name = std::string(text.substr(0, colon));
  if (spec.name.empty()) throw Error(spec.place, "a name is missing; write NAME or NAME:key=value,key=value");
  if (colon == text.size()) return spec;
  for (const std::string_view part : split(text.substr(colon + 1), ',')) {
    if (spec.given.size() == kMaxSpecKeys) {
      throw Error(spec.place, "\"" + spec.name.substr(0, 60) + "\" is given more than " + std::to_string(kMaxSpecKeys) +
                                  " parameters; leave some out");
    }
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      const bool after_path = !spec.given.empty() && spec.given.back().first == "path";
      throw Error(spec.place, "\"" + std::string(part) + "\" in \"" + spec.text + "\" is not key=value; write " +
                                  spec.name + ":key=value,key=value" +
                                  (after_path ? " (a path here cannot have a comma: rename the file)" : ""));
    }
    Value value;
    value.text = std::string(part.substr(equals + 1));
    const std::string key(part.substr(0, equals));
    for (const auto& [other, unused] : spec.given) {
      if (other == key) throw Error(spec.place, "\"" + key + "\" is given twice in \"" + spec.text + "\"");
    }
    spec.given.emplace_back(key, value);
  }
  return spec;
}

bool parse_number(std::string_view text, double& out) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double x = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(x)) return false;
  out = x;
  return true;
}

std::string shortest(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, result.ptr);
}

}  // namespace moire
