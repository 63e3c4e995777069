// Ctrl-C ends a run between two cases, so that what is finished is kept.
#include "app/interrupt.h"

#include <csignal>

namespace moire {
namespace {

// The one mutable variable of the program that outlives a function: a signal handler can reach nothing else.
volatile std::sig_atomic_t g_interrupted = 0;

void note_interrupt(int) { g_interrupted = 1; }

}  // namespace

void watch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = note_interrupt;
  // RESETHAND: the second signal finds the default handler. RESTART: a write that is under way goes on.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
}

bool interrupted() { return g_interrupted != 0; }

}  // namespace moire
