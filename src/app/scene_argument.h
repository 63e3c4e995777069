// The SCENE of a command line: a scene file.
#pragma once

#include <string>

#include "study/scene_file.h"

namespace moire {

// Reads the scene; its name is the file's, without .toml, when it gives none itself. Throws Error.
NamedScene load_scene(const std::string& path);

}  // namespace moire
