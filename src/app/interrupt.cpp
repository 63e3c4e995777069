// Ctrl-C and SIGTERM end a run between two cases, so that what is finished is kept.
#include "app/interrupt.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "core/error.h"

namespace moire {
namespace {

// The mutable variables of the program that outlive a function: a signal handler can reach nothing else.
volatile std::sig_atomic_t g_interrupted = 0;
volatile std::sig_atomic_t g_terminal = 0;

// Calls only what POSIX lets a handler call.
void note_interrupt(int) {
  if (g_interrupted != 0) ::_exit(static_cast<int>(Exit::interrupted));
  g_interrupted = 1;
  constexpr char kText[] = "\nending after the running case; once more ends at once\n";
  const int before = errno;
  if (g_terminal != 0 && ::write(STDERR_FILENO, kText, sizeof kText - 1) < 0) errno = before;
}

}  // namespace

void watch_interrupts() {
  g_terminal = ::isatty(STDERR_FILENO);
  struct sigaction action = {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESTART;  // a write that is under way goes on
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return g_interrupted != 0; }

}  // namespace moire
