// Pieces of a page's JSON (reports/web/src/schema.ts says what they mean): objects, tables by columns, packed text.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "study/results.h"

namespace moire {

// An object under construction; values are JSON already.
class JsonObject {
 public:
  void add(std::string_view name, std::string_view json);
  void add_text(std::string_view name, std::string_view text);
  std::size_t size() const { return text_.size(); }
  // The object; nothing may be added afterwards.
  std::string text() && { return std::move(text_) + "}"; }

 private:
  std::string text_ = "{";
};

// [a,b,...]; the items are JSON already.
std::string json_array(std::span<const std::string> items);

// Numbers for drawing: so many significant digits, null for what is not finite.
std::string drawn_numbers(std::span<const double> values, int digits);

// A table by columns, each in the order in which it is first seen; a cell that a row does not have is null.
std::string columns_json(const Table& table);

// The JSON with each < as \u003c: inside an HTML element nothing then ends that element. A < in JSON is always in a
// text.
std::string script_safe(std::string_view json);

// {"gz":"..."} where that is smaller than the JSON itself, else the JSON.
std::string packed_json(std::string json);

}  // namespace moire
