// moire exact --accuracy: bounds as asked, and refusals.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "program.h"

using namespace moire::cli;

namespace {

// The camera of kBoard over the whole plane: the horizon is at row 0.4, where W = 0.
const std::string kPlane =
    "kind = \"checkerboard\"\nwidth = 32\nheight = 24\n[camera]\nfocal = 32\nheight = 1.5\npitch = 20\nyaw = 10\n";

struct Answer {
  double value = 0, bound = 0;
};

Answer answer(const Outcome& outcome) {
  const std::vector<std::string> lines = lines_of(outcome.out);
  if (lines.size() != 2) return {-1, HUGE_VAL};
  const std::string& line = lines[1];
  const std::size_t comma = line.rfind(','), before = line.rfind(',', comma - 1);
  return {std::strtod(line.c_str() + before + 1, nullptr), std::strtod(line.c_str() + comma + 1, nullptr)};
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("exact --accuracy asks for larger or smaller bounds of the same values") {
    const Folder folder;
    const std::string scene = folder.write("plane.toml", kPlane), pixels = folder.write("pixels.txt", "20,0\n");
    const auto run = [&](std::vector<std::string> more) {
      std::vector<std::string> args{"exact", scene, "--filter", "mitchell", "--pixels", pixels};
      args.insert(args.end(), more.begin(), more.end());
      const Outcome outcome = run_program(args);
      CHECK(outcome.code == 0);
      return answer(outcome);
    };
    const Answer usual = run({}), rough = run({"--accuracy", "0.001"}), fine = run({"--accuracy", "1e-13"});
    CHECK(usual.bound <= 1e-9);
    CHECK(rough.bound <= 1e-3);
    CHECK(fine.bound < usual.bound);
    CHECK(usual.bound < rough.bound);
    CHECK(std::fabs(usual.value - rough.value) <= usual.bound + rough.bound);
    CHECK(std::fabs(usual.value - fine.value) <= usual.bound + fine.bound);
  }

  TEST_CASE("exact --accuracy takes numbers from 1e-15 to 0.1") {
    const Folder folder;
    const std::string scene = folder.write("plane.toml", kPlane), pixels = folder.write("pixels.txt", "20,0\n");
    for (const char* wrong : {"0", "-1e-9", "1", "1e-16", "fine", "nan"}) {
      const Outcome outcome = run_program({"exact", scene, "--pixels", pixels, "--accuracy", wrong});
      CAPTURE(wrong);
      CHECK(outcome.code == 2);
      CHECK(outcome.err.find("error: ") == 0);
      CHECK(outcome.err.find("--accuracy") != std::string::npos);
      CHECK(outcome.out.empty());
    }
  }
}
