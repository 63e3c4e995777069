// A web browser without a window.
#include "app/browser.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/error.h"

extern char** environ;

namespace moire {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNames[] = {"chromium", "chromium-browser", "google-chrome"};
constexpr std::string_view kAdvice = "install the package chromium, or set MOIRE_CHROMIUM to the program";
// A page of a hundred megabytes, written out.
constexpr std::size_t kMostBytes = std::size_t{1} << 30;

Error failed(const std::string& program, const std::string& what) { return Error(program, what, Exit::io); }

std::string browser() {
  if (const char* given = std::getenv("MOIRE_CHROMIUM"); given != nullptr && *given != '\0') {
    if (::access(given, X_OK) != 0) throw Error("MOIRE_CHROMIUM", fmt::format("\"{}\" is no program", given));
    return given;
  }
  const char* path = std::getenv("PATH");
  for (std::string_view rest = path == nullptr ? "" : path; !rest.empty();) {
    const std::string folder(rest.substr(0, rest.find(':')));
    rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
    for (const char* name : kNames) {
      const std::string program = (folder.empty() ? "." : folder) + "/" + name;
      if (::access(program.c_str(), X_OK) == 0 && fs::is_regular_file(program)) return program;
    }
  }
  throw Error("--figures", fmt::format("there is no Chromium to draw them; {}", kAdvice));
}

// The address of a file: bytes that mean something in an address are written as %XX (T. Berners-Lee and others, RFC
// 3986, 2005).
std::string address_of(const std::string& file) {
  std::string address = "file://";
  for (const char c : fs::absolute(file).string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("/-._~").find(c) != std::string_view::npos;
    address += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return address;
}

// A process of its own group, so that what it starts ends with it.
class Process {
 public:
  Process(const std::vector<std::string>& words) : program_(words[0]) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw failed(program_, std::string("no pipe: ") + std::strerror(errno));
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t plain;
    sigemptyset(&plain);
    for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&plain, signal);  // which this program ignores
    posix_spawnattr_setsigdefault(&attributes, &plain);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const int error = ::posix_spawn(&child_, program_.c_str(), &files, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    ::close(ends[1]);
    output_ = ends[0];
    if (error != 0) {
      ::close(output_);
      throw failed(program_, std::string("cannot be started: ") + std::strerror(error));
    }
  }
  ~Process() {
    ::close(output_);
    if (child_ > 0) {
      ::kill(-child_, SIGKILL);
      reap();
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // What it writes until it ends.
  std::string output(const std::function<bool()>& stop) {
    std::string text;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(kBrowserSeconds);
    for (;;) {
      if (stop()) throw Error(program_, "interrupted; no figure is written", Exit::interrupted);
      if (std::chrono::steady_clock::now() > deadline) {
        throw failed(program_, fmt::format("did not draw the page within {} s", kBrowserSeconds));
      }
      pollfd end{output_, POLLIN, 0};
      constexpr int kMilliseconds = 100;
      if (::poll(&end, 1, kMilliseconds) <= 0) continue;
      char block[1 << 16];
      const ssize_t got = ::read(output_, block, sizeof block);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      text.append(block, static_cast<std::size_t>(got));
      if (text.size() > kMostBytes) throw failed(program_, "wrote more than 1 GiB");
    }
    const int status = end_group();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
      throw failed(program_, fmt::format("failed (status {})", WIFEXITED(status) ? WEXITSTATUS(status) : -1));
    }
    return text;
  }

 private:
  int reap() {
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    return status;
  }

  // Waits for the process, ends whatever of its group is left, and returns its status. Until it is reaped its number,
  // which is the group's, is nobody else's.
  int end_group() {
    siginfo_t info{};
    while (::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    ::kill(-child_, SIGKILL);
    return reap();
  }

  std::string program_;
  pid_t child_ = -1;
  int output_ = -1;
};

}  // namespace

std::string rendered_document(const std::string& file, const std::string& fragment, const std::string& folder,
                              const std::function<bool()>& stop) {
  // Virtual time runs while nothing is left to do: the page's timers and frames do not wait for a clock.
  std::vector<std::string> words = {browser(),
                                    "--headless",
                                    "--disable-gpu",
                                    "--no-first-run",
                                    "--disable-background-networking",
                                    "--disable-dev-shm-usage",
                                    "--user-data-dir=" + folder,
                                    "--virtual-time-budget=60000"};
  if (::geteuid() == 0) words.emplace_back("--no-sandbox");  // Chromium does not start as root with its sandbox
  words.insert(words.end(), {"--dump-dom", address_of(file) + "#" + fragment});
  Process process(words);
  return process.output(stop);
}

}  // namespace moire
