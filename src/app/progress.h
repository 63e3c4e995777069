// A line on standard error that says how far a run is and how long it will take; nothing unless that is a terminal.
#pragma once

#include <chrono>
#include <cstddef>

namespace moire {

class Progress {
 public:
  explicit Progress(std::size_t cases);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // One more case is finished; `share` of the work is done, in (0, 1].
  void step(double share);

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t cases_, done_ = 0;
  bool shown_;
  Clock::time_point start_, last_;
};

}  // namespace moire
