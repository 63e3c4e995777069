// What a refused input says.
#pragma once

#include <string>

#include "core/error.h"

namespace moire {

// The message of the Error that `f` throws, "" when it throws none.
template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace moire
