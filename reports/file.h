// Files that appear whole: written under another name in the same folder, then renamed.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace moire {

// Replaces the file at `path` by `bytes`. Whoever looks sees the old file or the new one, never a part. A symbolic
// link stays one, and what is no regular file (/dev/stdout, a pipe) is written to as it stands. Throws Error
// (Exit::io) naming path and reason; the old file is then as it was.
void write_whole(const std::string& path, std::string_view bytes);

// The same for a writer that needs a path of its own: `write` fills the file that it is given, whose name ends as
// `path` does. What `write` throws passes through, with the unfinished file removed.
void write_renamed(const std::string& path, const std::function<void(const std::string&)>& write);

// Makes the folder and those above it; no complaint when it is there. Throws Error (Exit::io).
void make_folder(const std::string& path);

}  // namespace moire
