// A run of the program that must succeed without a word on standard error.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "program.h"

namespace moire::cli {

inline Outcome run_ok(const std::vector<std::string>& args) {
  Outcome outcome = run_program(args);
  CHECK(outcome.err.empty());
  CHECK(outcome.code == 0);
  return outcome;
}

}  // namespace moire::cli
