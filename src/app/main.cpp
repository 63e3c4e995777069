// The program: one command, and the one place where errors end.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <variant>

#include "app/command_line.h"
#include "app/output.h"

namespace moire {
namespace {

// An error is one line: names from files may hold anything.
std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n') {
      line += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      line += '?';
    } else {
      line += c;
    }
  }
  return line;
}

int report(std::string_view message, Exit code) {
  std::fprintf(stderr, "error: %s\n", one_line(message).c_str());
  return static_cast<int>(code);
}

constexpr std::string_view kNoMemory = "memory: there is not enough; choose a smaller image, count or plan";

// A standard stream that the caller closed would be given to the first file that is opened, results.jsonl perhaps, and
// what is printed would go there. In its place comes one that fails at once.
void fill_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

// Libraries that the module for image files loads allocate memory and start threads where no exception can leave: in
// static constructors. What is on disk by then is kept.
[[noreturn]] void end_at_once() {
  try {
    if (const std::exception_ptr e = std::current_exception()) std::rethrow_exception(e);
    report("unexpected: the program cannot go on", Exit::io);
  } catch (const std::bad_alloc&) {
    report(kNoMemory, Exit::io);
  } catch (const std::system_error& e) {
    report(std::string("system: ") + e.what() + "; allow more memory and threads", Exit::io);
  } catch (const std::exception& e) {
    report(std::string("unexpected: ") + e.what(), Exit::io);
  } catch (...) {
    report("unexpected: the program cannot go on", Exit::io);
  }
  ::_exit(static_cast<int>(Exit::io));
}

int run_program(int argc, const char* const* argv) {
  try {
    const Command command = parse_command_line(argc, argv);
    const Exit code = std::visit([](const auto& options) { return execute(options); }, command);
    flush_output();
    return static_cast<int>(code);
  } catch (const Error& e) {
    return report(e.what(), e.code());
  } catch (const std::bad_alloc&) {
    return report(kNoMemory, Exit::io);
  } catch (const std::exception& e) {
    return report(std::string("unexpected: ") + e.what(), Exit::io);
  }
}

}  // namespace
}  // namespace moire

int main(int argc, char** argv) {
  moire::fill_standard_streams();
  std::set_terminate(moire::end_at_once);
  // A closed pipe and a file at the limit of its size are failed writes, which are reported.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return moire::run_program(argc, argv);
}
