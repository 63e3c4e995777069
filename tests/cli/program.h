// Runs the program and catches what it says; a folder for its files.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace moire::cli {

struct Outcome {
  int code = -1;      // exit code; 128 + signal when a signal ended it
  bool late = false;  // it was ended because the time was up
  std::string out, err;
};

// Starts the program, calls `meanwhile` about 50 times a second with its process number, and waits for its end, at most
// `seconds`. Standard input is /dev/null; `out_path`, when given, takes standard output. `before`, when given, runs in
// the new process before it becomes the program, and may set its limits.
inline Outcome run_program(const std::vector<std::string>& args, const std::string& out_path = "", int seconds = 120,
                           const std::function<void(pid_t)>& meanwhile = {}, const std::function<void()>& before = {}) {
  int out_pipe[2], err_pipe[2];
  if (::pipe(out_pipe) != 0 || ::pipe(err_pipe) != 0) throw std::runtime_error("pipe");
  std::vector<std::string> words = {MOIRE_PROGRAM};
  words.insert(words.end(), args.begin(), args.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // Signals must not meet the test program's handlers in the child: they wait until it has none.
  sigset_t all, unblocked;
  sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, &unblocked);
  const pid_t child = ::fork();
  if (child != 0) ::sigprocmask(SIG_SETMASK, &unblocked, nullptr);
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) {
    for (const int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_DFL);
    ::sigprocmask(SIG_SETMASK, &unblocked, nullptr);
    const int null = ::open("/dev/null", O_RDONLY);
    const int out = out_path.empty() ? out_pipe[1] : ::open(out_path.c_str(), O_WRONLY);
    ::dup2(null, 0);
    ::dup2(out, 1);
    ::dup2(err_pipe[1], 2);
    for (const int end : {out_pipe[0], out_pipe[1], err_pipe[0], err_pipe[1]}) ::close(end);
    if (before) before();
    ::execv(argv[0], argv.data());
    ::_exit(99);
  }
  ::close(out_pipe[1]);
  ::close(err_pipe[1]);
  Outcome outcome;
  pollfd ends[2] = {{out_pipe[0], POLLIN, 0}, {err_pipe[0], POLLIN, 0}};
  std::string* const texts[2] = {&outcome.out, &outcome.err};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  for (int open_ends = 2; open_ends > 0;) {
    if (std::chrono::steady_clock::now() > deadline && !outcome.late) {
      outcome.late = true;
      ::kill(child, SIGKILL);
    }
    if (meanwhile && !outcome.late) meanwhile(child);
    ::poll(ends, 2, 20);
    for (int i = 0; i < 2; ++i) {
      if (ends[i].fd < 0 || ends[i].revents == 0) continue;
      char block[4096];
      const ssize_t got = ::read(ends[i].fd, block, sizeof block);
      if (got > 0) {
        texts[i]->append(block, static_cast<std::size_t>(got));
      } else {
        ::close(ends[i].fd);
        ends[i].fd = -1;  // poll() passes over it
        --open_ends;
      }
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// A folder of its own, gone at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "moire_cli_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  // Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return *this / name;
  }

 private:
  std::filesystem::path path_;
};

inline const std::string kEdge = "kind = \"edge\"\nwidth = 32\nheight = 24\nthrough = [16.3, 12.1]\nnormal = 97.3\n";
inline const std::string kDisk = "kind = \"disk\"\nwidth = 32\nheight = 24\ncenter = [15.7, 12.3]\nradius = 8.25\n";
inline const std::string kBoard =
    "kind = \"checkerboard\"\nwidth = 32\nheight = 24\nextent = [-3, 3, 1, 8]\n[camera]\nfocal = 32\nheight = 1.5\n"
    "pitch = 20\nyaw = 10\n";

}  // namespace moire::cli
