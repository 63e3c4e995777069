// Gives a fuzz target the seeds of a folder, and variations of each that are the same in every run: where there is no
// libFuzzer, the bounded part of what it does.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz.h"

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCuts = 24, kChanges = 40;  // of each seed
constexpr double kMaxSeconds = 20;        // for one input; the aim is one, sanitizers and busy machines take longer

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The input stands in `last` until it is done: what is there after a crash or a timeout is to blame.
void give(const std::string& input, const std::string& name, const std::string& last) {
  std::ofstream(last, std::ios::binary) << input;
  const auto start = Clock::now();
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (seconds > 1) std::fprintf(stderr, "a variation of %s took %.1f s\n", name.c_str(), seconds);
  moire::fuzz::require(seconds < kMaxSeconds, "an input takes little time");
}

// One to four edits: a byte changed, removed or doubled, a stretch repeated, a character that grammars care about.
std::string changed(std::string text, std::mt19937& random) {
  static constexpr std::string_view kMarks = "\"'[]{}=,.:#-+eE0919\n\0\xff";
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % std::max<std::size_t>(n, 1); };
  for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        if (!text.empty()) text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, 1);
        break;
      case 2:
        text.insert(at, 1, kMarks[below(kMarks.size())]);
        break;
      case 3:
        text.insert(at, text.substr(at, below(16)));
        break;
      default:
        if (!text.empty()) text[at] = kMarks[below(kMarks.size())];
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> seeds;
  for (int i = 1; i < argc; ++i) {
    const std::filesystem::path path = argv[i];
    if (!std::filesystem::is_directory(path)) {
      seeds.push_back(path);  // a single input, such as one that libFuzzer found
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(path)) seeds.push_back(entry.path());
  }
  std::sort(seeds.begin(), seeds.end());
  moire::fuzz::require(!seeds.empty(), "there are seeds: give their folder");
  const std::string last = std::filesystem::path(argv[0]).filename().string() + ".input";
  give("", "no bytes", last);
  for (const std::filesystem::path& path : seeds) {
    const std::string seed = bytes_of(path), name = path.filename().string();
    give(seed, name, last);
    for (int i = 0; i < kCuts; ++i) give(seed.substr(0, seed.size() * static_cast<std::size_t>(i) / kCuts), name, last);
    std::mt19937 random(1);
    for (int i = 0; i < kChanges; ++i) give(changed(seed, random), name, last);
  }
  std::filesystem::remove(last);
  std::printf("%zu seeds, %d inputs of each\n", seeds.size(), 1 + kCuts + kChanges);
}
