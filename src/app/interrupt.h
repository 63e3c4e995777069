// Ctrl-C ends a run between two cases, so that what is finished is kept.
#pragma once

namespace moire {

// Lets the first SIGINT only be noted; a second one ends the program at once.
void watch_interrupts();

// Whether SIGINT has come.
bool interrupted();

}  // namespace moire
