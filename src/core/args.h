// Parameters of plug-ins: what they accept (Param), what was given (Value) and the checked result (Args).
// One table per plug-in feeds the parser, `moire list` and the error messages, so that they cannot drift apart.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace moire {

// One parameter of a plug-in.
struct Param {
  enum class Kind : std::uint8_t { number, integer, choice, path, numbers };
  std::string_view name;
  Kind kind = Kind::number;
  double fallback = 0, min = 0, max = 0;  // number, integer
  std::string_view text = {};             // choice: the default; numbers: the default in words
  std::string_view choices = {};          // choice: "a|b|c"
  bool required = false;
  std::string_view help = {};
};

constexpr Param number(std::string_view name, double fallback, double min, double max, std::string_view help) {
  return {name, Param::Kind::number, fallback, min, max, {}, {}, false, help};
}
constexpr Param integer(std::string_view name, double fallback, double min, double max, std::string_view help) {
  return {name, Param::Kind::integer, fallback, min, max, {}, {}, false, help};
}
constexpr Param choice(std::string_view name, std::string_view fallback, std::string_view choices,
                       std::string_view help) {
  return {name, Param::Kind::choice, 0, 0, 0, fallback, choices, false, help};
}
// A number, a list or a table of numbers; the plug-in itself checks the shape. `fallback` says in words what holds
// when it is not given ("" and required = true: it must be).
constexpr Param numbers(std::string_view name, bool required, std::string_view fallback, std::string_view help) {
  return {name, Param::Kind::numbers, 0, 0, 0, fallback, {}, required, help};
}

// A file's path, which must be given.
constexpr Param path(std::string_view name, std::string_view help) {
  return {name, Param::Kind::path, 0, 0, 0, {}, {}, true, help};
}

// A value as given by a person: either text (from a command line, or a TOML string) or numbers.
struct Value {
  std::string text;             // as written, when it came as text
  std::vector<double> numbers;  // row-major, when it came as numbers
  int rank = 0;                 // 0: one number, 1: a list, 2: rows of equal length
  std::size_t columns = 0;      // length of each row when rank == 2
  bool is_text = true;
  std::string place;        // where it stands, for messages
  std::string folder = {};  // where a relative path starts; "": the working directory
};

using Given = std::vector<std::pair<std::string, Value>>;

// Checked parameters of one plug-in: every parameter of its table is there, in range, defaults filled in.
class Args {
 public:
  // Throws Error for unknown, repeated, missing, mistyped or out-of-range parameters. `owner` is for messages,
  // e.g. `pattern "jittered"`; `place` is used where a value has none of its own.
  Args(std::string_view owner, std::span<const Param> params, const Given& given, std::string_view place);
  Args() = default;

  double number(std::string_view name) const;          // number or integer
  std::int64_t integer(std::string_view name) const;   // integer
  std::string_view text(std::string_view name) const;  // choice or path
  std::string path(std::string_view name) const;       // path, from where its file can be opened
  // The value, or the default of a number, integer or choice; null for others that were not given.
  const Value* find(std::string_view name) const;
  bool given(std::string_view name) const;
  const std::string& place() const { return place_; }  // where the plug-in was named

 private:
  Given values_;
  std::vector<std::string> given_;
  std::string place_;
};

// "name" or "name:key=value,key=value" taken apart.
struct Spec {
  std::string text;  // as written
  std::string name;
  Given given;
  std::string place;
};

// Parameters of a spec: each key is compared with all others, and a spec may come from a large file.
inline constexpr std::size_t kMaxSpecKeys = 64;

// Throws Error for an empty name, a parameter without "=", an empty key, a key given twice or more than kMaxSpecKeys. A
// value ends at a comma.
Spec parse_spec(std::string_view text, std::string_view place);

// The whole of `text` as a finite double; false when it is not one. Locale-free.
bool parse_number(std::string_view text, double& out);

// The shortest decimal that reads back as the same double ("nan", "inf" for those).
std::string shortest(double value);

}  // namespace moire
