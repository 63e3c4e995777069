// Ctrl-C and SIGTERM end a run between two cases, so that what is finished is kept.
#pragma once

namespace moire {

// Lets the first SIGINT or SIGTERM only be noted, and says so if standard error is a terminal; a second one ends the
// program at once, with the exit code of an interruption. What is finished is on disk in either case.
void watch_interrupts();

// Whether one has come.
bool interrupted();

}  // namespace moire
