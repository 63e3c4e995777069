// From the words of a command line to a command.
#pragma once

#include "app/commands.h"

namespace moire {

// Throws Error (Exit::usage) for everything that is no command, with the nearest names for unknown ones.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace moire
