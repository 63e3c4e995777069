// The SCENE of a command line: a scene file.
#include "app/scene_argument.h"

#include <filesystem>

#include "study/text_file.h"

namespace moire {

NamedScene load_scene(const std::string& path) {
  return parse_scene(read_bytes(path, kMaxTomlBytes), path, std::filesystem::path(path).stem().string());
}

}  // namespace moire
