// What goes wrong around the program: kills, full and read-only disks, folders that vanish, damaged results, closed
// streams, no memory, no threads. The contract's exit code, one clear line, and nothing good is lost.
#include <doctest/doctest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "program.h"
#include "reports/json.h"
#include "result_files.h"
#include "run_ok.h"
#include "stopped_runs.h"

using namespace moire::cli;
namespace fs = std::filesystem;

namespace {

// Rows soon and many, pictures among them; about a second.
const std::string kSets =
    "name = \"sets\"\nseed = 5\ntrials = 40\npatterns = [\"random\", \"jittered\", \"hammersley\"]\nn = [64, 256, "
    "900]\n"
    "measures = [\"star-l2\", \"edge-l2\", \"edge-l2-printed:method=monte-carlo,tests=2000\"]\n";

const std::string kFewSets =
    "name = \"few\"\ntrials = 2\npatterns = [\"random\"]\nn = [4, 9]\nmeasures = [\"star-l2\"]\nimages = \"none\"\n";

const std::string kImages =
    "seed = 2\ntrials = 2\nspp = [1, 4]\npatterns = [\"random\", \"jittered\"]\nfilters = [\"box\", \"tent\"]\n"
    "[[scene]]\n" +
    kEdge;

// One line that says what is wrong.
void check_error(const Outcome& outcome, int code, const std::string& says) {
  CAPTURE(outcome.err);
  CHECK_FALSE(outcome.late);
  CHECK(outcome.code == code);
  const std::vector<std::string> lines = lines_of(outcome.err);
  REQUIRE_FALSE(lines.empty());
  CHECK(lines.back().starts_with("error: "));
  CHECK(lines.back().find(says) != std::string::npos);
  CHECK(std::count_if(lines.begin(), lines.end(), [](const std::string& l) { return !l.starts_with("note: "); }) == 1);
}

// Back when the process stands still (the signal alone is only on its way) or has ended.
void stop(pid_t process) {
  ::kill(process, SIGSTOP);
  for (;;) {
    const std::string stat = read_file("/proc/" + std::to_string(process) + "/stat");
    const std::size_t name_end = stat.rfind(')');  // "1234 (name) T ..."
    if (name_end == std::string::npos || stat.substr(name_end, 3) == ") T" || stat.substr(name_end, 3) == ") Z") return;
    ::usleep(100);
  }
}

bool has_parts(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".part") return true;
  }
  return false;
}

std::size_t rows_in(const std::string& results) {
  const std::string text = read_file(results);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// Gives this process file systems of its own, which end with it. Only root may, and containers may refuse.
bool own_mounts() {
  return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

// Each command with options that make it print, its data on standard output.
std::vector<std::vector<std::string>> printing_commands(const Folder& folder) {
  const std::string edge = folder.write("edge.toml", kEdge), pixels = folder.write("pixels.txt", "3,4\n16,12\n");
  const std::string study = folder.write("s.toml", kFewSets);
  return {{"list", "filters"},
          {"list", "patterns", "--json"},
          {"--help"},
          {"--version"},
          {"render", edge, "--pattern", "random", "--spp", "4"},
          {"exact", edge, "--pixels", pixels},
          {"points", "random", "--n", "100000"},
          {"discrepancy", "random", "--n", "16", "--measure", "star-l2"},
          {"filters", "box"},
          {"spectrum", "random", "--n", "16", "--trials", "1"},
          {"run", study, "--dry-run"},
          {"run", study, "-o", folder / "out"}};
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE(
      "runs of a study of discrepancies that are killed or stopped at random moments write what a whole run does") {
    stop_and_resume(kSets, 3);
  }

  TEST_CASE("a last row that is cut at any byte is computed again, and the cut is told") {
    const Whole whole = whole_run(kFewSets);
    const Folder folder;
    folder.write("s.toml", kFewSets);
    REQUIRE(run_study(folder).code == 0);
    const std::string path = folder / "out/results.jsonl", good = read_file(path);
    const std::size_t last = good.rfind('\n', good.size() - 2) + 1;
    for (std::size_t cut = last; cut < good.size(); ++cut) {
      CAPTURE(cut);
      std::ofstream(path, std::ios::binary) << good.substr(0, cut);
      const Outcome outcome = run_study(folder, true);
      REQUIRE(outcome.code == 0);
      CHECK((outcome.err.find("the last line was cut") != std::string::npos) == (cut > last));
      check_same(files_of(folder / "out"), whole.files);
    }
  }

  TEST_CASE("where memory has a limit, a run ends well or with code 3 and one clear line") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    MESSAGE("sanitizers take all addresses for themselves");
#else
    const auto limited = [](const std::vector<std::string>& words, rlim_t megabytes) {
      return run_program(words, "", 120, {}, [=] { limit(RLIMIT_AS, megabytes << 20); });
    };
    rlim_t least = 16;  // below, the loader gives up, not the program
    while (least < 1024 && limited({"--version"}, least).code != 0) least += 16;
    const Folder folder;
    folder.write("s.toml", kImages);
    bool failed = false, done = false;
    for (rlim_t more = 0; more <= 640; more += 40) {
      CAPTURE(more);
      fs::remove_all(folder / "out");
      const Outcome outcome = limited(run_words(folder, false), least + more);
      if (outcome.code != 0) check_error(outcome, 3, "");
      (outcome.code == 0 ? done : failed) = true;
    }
    CHECK(failed);
    CHECK(done);
#endif
  }
}

TEST_SUITE("cli") {
  TEST_CASE("SIGINT ends a study of discrepancies with code 130, a second one at once, and it goes on") {
    const Whole whole = whole_run(kSets);
    for (const int signals : {1, 2}) {
      CAPTURE(signals);
      const Folder folder;
      folder.write("s.toml", kSets);
      int sent = 0;
      const Outcome outcome = run_study(folder, false, [&](pid_t child) {
        if (sent == signals || rows_in(folder / "out/results.jsonl") < 3) return;
        ::kill(child, SIGINT);
        ++sent;
      });
      CHECK(outcome.code == 130);
      CHECK_FALSE(fs::exists(folder / "out/results.csv"));
      CHECK(run_study(folder, true).code == 0);
      check_same(files_of(folder / "out"), whole.files);
    }
  }

  TEST_CASE("a reader of results keeps the whole lines before any cut, and nothing else") {
    const Folder folder;
    folder.write("s.toml", kFewSets);
    REQUIRE(run_study(folder).code == 0);
    const std::string good = read_file(folder / "out/results.jsonl");
    const std::size_t header = good.find('\n') + 1;
    for (std::size_t cut = 0; cut <= good.size(); ++cut) {
      const moire::ResultsFile found = moire::read_results(folder.write("cut.jsonl", good.substr(0, cut)));
      const std::size_t whole = cut == 0 ? 0 : good.rfind('\n', cut - 1) + 1;  // npos + 1 is 0
      CHECK(found.whole_bytes == whole);
      CHECK(found.cut == good.substr(whole, cut - whole));
      CHECK(found.header.empty() == (whole == 0));
      const auto rows = std::count(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(whole), '\n');
      CHECK(found.rows.size() == static_cast<std::size_t>(std::max<std::ptrdiff_t>(rows - 1, 0)));
    }
    // What a crash of the system leaves behind: zeros at the end. In the middle they are damage, with a place.
    const moire::ResultsFile zeros = moire::read_results(folder.write("z.jsonl", good + std::string(100, '\0')));
    CHECK(zeros.whole_bytes == good.size());
    CHECK(zeros.cut == std::string(100, '\0'));
    for (const std::string& garbage : {std::string(9, '\0'), std::string("\xff\xfe\x80"), std::string("{\"kind\":")}) {
      const std::string text = good.substr(0, header) + garbage + "\n" + good.substr(header);
      const std::string path = folder.write("garbage.jsonl", text);
      CHECK_THROWS_WITH(moire::read_results(path), (path + ":2: is not a row of results; mend or remove it").c_str());
    }
  }

  TEST_CASE("results that are no regular file are refused at once: nobody would end a pipe") {
    const Folder folder;
    folder.write("s.toml", kFewSets);
    fs::create_directories(folder / "out");
    REQUIRE(::mkfifo((folder / "out/results.jsonl").c_str(), 0600) == 0);
    for (const bool resume : {false, true}) check_error(run_study(folder, resume), 3, "is no regular file");
    const std::string study =
        folder.write("t.toml", "patterns = [\"random\"]\n[[scene]]\nfile = \"out/results.jsonl\"\n");
    check_error(run_program({"run", study, "--dry-run"}), 3, "it is no regular file");
  }

  TEST_CASE("on a full disk a run ends with code 3, keeps its rows, leaves no parts, and goes on when there is room") {
    const Whole whole = whole_run(kImages);
    const Folder folder;
    const bool mounted = own_mounts();
    // Sizes of files without root: what a limit refuses fails as on a full disk, in each file at its size.
    for (const rlim_t kib : {1, 2, 5, 10, 20, 40, 80, 160}) {
      CAPTURE(kib);
      const Folder inner;
      const std::string disk = inner / "disk";
      fs::create_directories(disk);
      const std::string study = inner.write("s.toml", kImages);
      const std::string size = "size=" + std::to_string(std::max<rlim_t>(kib, 4)) + "k";
      const bool small = mounted && ::mount("tmpfs", disk.c_str(), "tmpfs", 0, size.c_str()) == 0;
      const std::vector<std::string> words = {"run", study, "-o", disk + "/out", "--threads", "1"};
      const Outcome outcome = run_program(words, "", 120, {}, [&] {
        if (!small) limit(RLIMIT_FSIZE, kib << 8);
      });
      if (outcome.code != 0) {
        check_error(outcome, 3, small ? "No space left on device" : "File too large");
        CHECK_FALSE(has_parts(disk));
      }
      if (small) REQUIRE(::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT, "size=4m") == 0);
      std::vector<std::string> again = words;
      again.push_back("--resume");
      const Outcome resumed = run_program(again);
      CAPTURE(resumed.err);
      CHECK(resumed.code == 0);
      check_same(files_of(disk + "/out"), whole.files);
      if (small) ::umount(disk.c_str());
    }
  }

  TEST_CASE("on a read-only disk a run and an image end with code 3 before the work") {
    const Folder folder;
    const std::string study = folder.write("s.toml", kImages), edge = folder.write("edge.toml", kEdge);
    const std::string disk = folder / "disk";
    fs::create_directories(disk + "/out");
    if (!own_mounts() || ::mount("tmpfs", disk.c_str(), "tmpfs", MS_RDONLY, "size=64k") != 0) {
      MESSAGE("only root can mount a read-only disk");
      return;
    }
    check_error(run_program({"run", study, "-o", disk + "/out"}), 3, "Read-only file system");
    check_error(run_program({"run", study, "-o", disk}), 3, "Read-only file system");
    check_error(run_program({"exact", edge, "-o", disk + "/x.exr"}), 3, "Read-only file system");
    check_error(run_program({"spectrum", "random", "--n", "4", "-o", disk + "/s"}), 3, "Read-only file system");
    ::umount(disk.c_str());
  }

  TEST_CASE("a file where a folder is to be, or a folder in place of a file, is named") {
    for (const std::string taken : {"out", "out/images", "out/results.jsonl", "out/report.md", "out/results.csv"}) {
      CAPTURE(taken);
      const Folder folder;
      folder.write("s.toml", kImages);
      const bool file = taken == "out" || taken == "out/images";
      if (!file) fs::create_directories(folder / (taken + "/full"));
      if (taken == "out/images") fs::create_directories(folder / "out");
      if (file) folder.write(taken, "mine");
      check_error(run_study(folder), 3, folder / taken);
      if (file) CHECK(read_file(folder / taken) == "mine");
    }
  }

  TEST_CASE("a folder that is removed while a run writes to it ends the run with code 3 and the name of a file in it") {
    for (const std::string& study : {kSets, kImages}) {
      const Folder folder;
      folder.write("s.toml", study);
      bool removed = false;
      const Outcome outcome = run_study(folder, false, [&](pid_t child) {
        if (removed || rows_in(folder / "out/results.jsonl") < 2) return;
        stop(child);
        // Where the report stands, nothing is left but the page, which would say first that its images are gone.
        if (!fs::exists(folder / "out/report.md")) {
          fs::remove_all(folder / "out");
          removed = true;
        }
        ::kill(child, SIGCONT);
      });
      if (!removed) continue;  // it was over before anybody looked
      check_error(outcome, 3, folder / "out/");
      CHECK_FALSE(fs::exists(folder / "out"));
    }
  }

  TEST_CASE("whoever looks while a run goes on sees whole files, and parts that say so") {
    const Whole whole = whole_run(kImages);
    const Folder folder;
    folder.write("s.toml", kImages);
    const auto look = [&] {
      for (const auto& [name, bytes] : whole.files) {
        const bool timed = name == "results.jsonl" || name == "results.csv";
        if (timed || !fs::exists(folder / ("out/" + name))) continue;
        CAPTURE(name);
        const std::string found = read_file(folder / ("out/" + name));
        CHECK(((name == "index.html" ? moire::page::without_times(moire::page::data_of(found)) : found) == bytes));
      }
    };
    const Outcome outcome = run_study(folder, false, [&](pid_t child) {
      ::kill(child, SIGSTOP);
      look();
      ::kill(child, SIGCONT);
    });
    CHECK(outcome.code == 0);
    look();
    // A killed run's parts, of files that this study does not write.
    folder.write("out/noise_ranking.csv.part", "half");
    folder.write("out/images/other.exr.part", "half");
    folder.write("out/mine.part", "mine");
    CHECK(run_study(folder).code == 0);
    CHECK_FALSE(fs::exists(folder / "out/noise_ranking.csv.part"));
    CHECK_FALSE(fs::exists(folder / "out/images/other.exr.part"));
    CHECK(fs::exists(folder / "out/mine.part"));
  }

  TEST_CASE("a standard output that is full, closed or read by nobody ends every command with code 3") {
    const Folder folder;
    for (const std::vector<std::string>& words : printing_commands(folder)) {
      CAPTURE(words[0]);
      check_error(run_program(words, "/dev/full"), 3, "standard output: cannot be written: No space left on device");
      const auto nobody_reads = [] {
        int ends[2];
        if (::pipe(ends) != 0) ::_exit(98);
        ::dup2(ends[1], STDOUT_FILENO);
        ::close(ends[0]);
        ::close(ends[1]);
      };
      check_error(run_program(words, "", 120, {}, nobody_reads), 3, "standard output: cannot be written: Broken pipe");
      const auto closed = [] { ::close(STDOUT_FILENO); };
      check_error(run_program(words, "", 120, {}, closed), 3,
                  "standard output: cannot be written: Bad file descriptor");
    }
  }

  TEST_CASE("standard streams that are closed do not become files of results") {
    const Whole whole = whole_run(kFewSets);
    const Folder folder;
    folder.write("s.toml", kFewSets);
    folder.write("out.txt", "");
    fs::create_directories(folder / "out");
    folder.write("out/results.jsonl", "old\n");  // so that a note goes to standard error
    const Outcome outcome = run_program(run_words(folder, false), "", 120, {}, [] {
      for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(stream);
    });
    CHECK(outcome.code == 3);
    check_same(files_of(folder / "out"), whole.files);
  }

  TEST_CASE("where the system gives no threads, a command does without or says so") {
    const std::vector<std::string> words = {"discrepancy", "random",    "--n",     "500",       "--trials",
                                            "64",          "--measure", "star-l2", "--threads", "1024"};
    const Outcome outcome = run_program(words, "", 120, {}, [] {
      if (::geteuid() == 0) {  // root has no limit
        if (::setgid(65534) != 0 || ::setuid(65534) != 0) ::_exit(98);
      }
      limit(RLIMIT_NPROC, 1);
      ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1);  // in such builds the search for leaks needs a thread of its own
    });
    CAPTURE(outcome.err);
    if (outcome.code == 99) {
      MESSAGE("the program stands in a folder that only root may enter");
      return;
    }
    CHECK((outcome.code == 0 || outcome.code == 3));
    if (outcome.code == 3) check_error(outcome, 3, "threads: ");
  }
}

TEST_SUITE("slow") {
  TEST_CASE("fifty runs of a study of discrepancies that are killed at random moments write what a whole run does") {
    stop_and_resume(kSets, 50);
  }
}
