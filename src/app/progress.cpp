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

Progress::Progress(std::size_t cases)
    : cases_(cases), shown_(::isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_(start_ - kRefresh) {}

Progress::~Progress() {
  if (shown_ && done_ > 0) std::fputs(kClearLine, stderr);
}

void Progress::step(double share) {
  ++done_;
  const auto now = Clock::now();
  if (!shown_ || now - last_ < kRefresh) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const auto left = static_cast<std::int64_t>(elapsed * (1 - share) / share + 0.5);
  const std::string line = fmt::format("{}{:3.0f}%  {} of {} cases, {}:{:02} left", kClearLine, 100 * share, done_,
                                       cases_, left / 60, left % 60);
  std::fputs(line.c_str(), stderr);
}

}  // namespace moire
