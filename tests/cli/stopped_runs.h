// Runs of a study that are killed or stopped and go on, compared with one that nothing disturbed.
#pragma once

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "program.h"
#include "result_files.h"

namespace moire::cli {

using Clock = std::chrono::steady_clock;

// The study `s.toml` of the folder, into its folder `out`, with one thread.
inline std::vector<std::string> run_words(const Folder& folder, bool resume) {
  std::vector<std::string> words = {"run", folder / "s.toml", "-o", folder / "out", "--threads", "1"};
  if (resume) words.push_back("--resume");
  return words;
}

inline Outcome run_study(const Folder& folder, bool resume = false, const std::function<void(pid_t)>& meanwhile = {}) {
  return run_program(run_words(folder, resume), "", 240, meanwhile);
}

// What an uninterrupted run writes, and how long that takes.
struct Whole {
  std::map<std::string, std::string> files;
  Clock::duration time{};
};

inline Whole whole_run(const std::string& study) {
  const Folder folder;
  folder.write("s.toml", study);
  const auto start = Clock::now();
  REQUIRE(run_study(folder).code == 0);
  const Clock::duration time = Clock::now() - start;
  return {files_of(folder / "out"), time};
}

// The same names and bytes; no file more, so that no temporary one is left.
inline void check_same(const std::map<std::string, std::string>& got, const std::map<std::string, std::string>& want) {
  REQUIRE(got.size() == want.size());
  for (const auto& [name, bytes] : want) {
    CAPTURE(name);
    REQUIRE(got.count(name) == 1);
    CHECK((got.at(name) == bytes));
  }
}

// Stops `rounds` runs, each up to three times at moments within the time that a whole run takes, goes on, and compares.
inline void stop_and_resume(const std::string& study, int rounds) {
  const Whole whole = whole_run(study);
  std::mt19937 random(1);  // the same moments each time, as far as a clock allows
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  int stopped = 0;
  for (int round = 0; round < rounds; ++round) {
    CAPTURE(round);
    const Folder folder;
    folder.write("s.toml", study);
    const int stops = 1 + round % 3;
    for (int i = 0; i < stops; ++i) {
      const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(share() * whole.time);
      const int signal = random() % 2 == 0 ? SIGKILL : SIGTERM;
      bool sent = false;
      const Outcome outcome = run_study(folder, i > 0 || round % 2 == 1, [&](pid_t child) {
        if (sent || Clock::now() < end) return;
        ::kill(child, signal);
        sent = true;
      });
      CAPTURE(outcome.err);
      // 0: it was ready before the signal; 128 + signal: SIGKILL, or SIGTERM before it listens.
      CHECK((outcome.code == 0 || outcome.code == 130 || outcome.code == 128 + signal));
      stopped += outcome.code != 0;
    }
    const Outcome outcome = run_study(folder, true);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    check_same(files_of(folder / "out"), whole.files);
  }
  CHECK(stopped > 0);
}

}  // namespace moire::cli
