// A line on standard error that says how far a run is and how long it will take; nothing unless that is a terminal.
#pragma once

#include <chrono>
#include <cstddef>

namespace moire {

class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `done` of `due` cases are finished; `share` of the work is done, in (0, 1].
  void step(std::size_t done, std::size_t due, double share);

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_, drawn_ = false;
  Clock::time_point start_, last_;
};

}  // namespace moire
