// A line on standard error that says how far a run is and how long it will take.
#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>

namespace moire {
namespace {

constexpr std::chrono::milliseconds kRefresh{100};
constexpr const char* kClearLine = "\r\x1b[K";

}  // namespace

Progress::Progress() : shown_(::isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_(start_ - kRefresh) {}

Progress::~Progress() {
  if (drawn_) std::fputs(kClearLine, stderr);
}

void Progress::step(std::size_t done, std::size_t due, double share) {
  const auto now = Clock::now();
  if (!shown_ || now - last_ < kRefresh) return;
  last_ = now;
  drawn_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const auto left = static_cast<std::int64_t>(elapsed * (1 - share) / share + 0.5);
  const std::string line = fmt::format("{}{:3.0f}%  {} of {} cases, {}:{:02} left", kClearLine, 100 * share, done, due,
                                       left / 60, left % 60);
  std::fputs(line.c_str(), stderr);
}

}  // namespace moire
