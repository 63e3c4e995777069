// The one exception of moire, thrown at the edges (files, options, command line) and caught once in main.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace moire {

// What the program tells its caller.
enum class Exit : int {
  ok = 0,
  failed = 1,        // a comparison or a stated bound failed
  usage = 2,         // usage or input error
  io = 3,            // a file could not be read or written
  interrupted = 130  // stopped by a signal; the results so far are kept
};

// "PLACE: what is wrong; what would be right". For files, PLACE is file:line:column.
class Error : public std::runtime_error {
 public:
  Error(const std::string& place, const std::string& what, Exit code = Exit::usage)
      : std::runtime_error(place.empty() ? what : place + ": " + what), code_(code) {}
  Exit code() const noexcept { return code_; }

 private:
  Exit code_;
};

}  // namespace moire
