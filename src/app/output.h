// Standard output, where a short write is an error, notes to a person, and checks of paths before long work.
#pragma once

#include <string>
#include <string_view>

namespace moire {

// Writes to standard output. Throws Error (Exit::io) when it does not take the bytes: a full disk, a closed pipe.
void print(std::string_view text);

// One line to standard error, "note: PLACE: WHAT", for a person.
void say(const std::string& place, const std::string& what);

// Empties the buffer of standard output; throws as print() does.
void flush_output();

// Throws Error (Exit::usage) for a path that does not end in .exr and Error (Exit::io) when its folder is missing or
// cannot be written. `option` names the option for the message.
void check_image_path(const std::string& option, const std::string& path);

}  // namespace moire
