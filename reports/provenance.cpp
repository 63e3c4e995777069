// Where results come from.
#include "reports/provenance.h"

#include <openssl/evp.h>

#include <fstream>
#include <thread>

#include "core/error.h"
#include "reports/build_info.h"

namespace moire {
namespace {

// The rest of the first line of `path` that begins with `key`, after the separator and without quotes.
std::string field(const char* path, std::string_view key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const std::size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
    const std::size_t end = line.find_last_not_of(" \t\"");
    if (begin != std::string::npos && end >= begin) return line.substr(begin, end - begin + 1);
  }
  return "unknown";
}

}  // namespace

Tool tool() { return {build::kVersion, build::kCommit, build::kBuildType, build::kCompiler, build::kFlags, "off"}; }

Host host() {
  const unsigned cores = std::thread::hardware_concurrency();
  return {field("/proc/cpuinfo", "model name", ':'), cores == 0 ? 1 : static_cast<int>(cores),
          field("/etc/os-release", "PRETTY_NAME", '=')};
}

std::string sha256(std::string_view bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr) != 1) {
    throw Error("SHA-256", "libcrypto does not offer it", Exit::io);
  }
  constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) {
    hex += kDigits[digest[i] >> 4];
    hex += kDigits[digest[i] & 15];
  }
  return hex;
}

}  // namespace moire
