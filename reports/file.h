// Files that appear whole: written under another name in the same folder, then renamed.
#pragma once

#include <string>
#include <string_view>

namespace moire {

// Replaces the file at `path` by `bytes`. Whoever looks sees the old file or the new one, never a part. A symbolic
// link stays one, and what is no regular file (/dev/stdout, a pipe) is written to as it stands. Throws Error
// (Exit::io) naming path and reason; the old file is then as it was.
void write_whole(const std::string& path, std::string_view bytes);

// Makes the folder and those above it; no complaint when it is there. Throws Error (Exit::io).
void make_folder(const std::string& path);

}  // namespace moire
