// The program: one command, and the one place where errors end.
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
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

int run_program(int argc, const char* const* argv) {
  try {
    const Command command = parse_command_line(argc, argv);
    const Exit code = std::visit([](const auto& options) { return execute(options); }, command);
    flush_output();
    return static_cast<int>(code);
  } catch (const Error& e) {
    return report(e.what(), e.code());
  } catch (const std::bad_alloc&) {
    return report("memory: there is not enough; choose a smaller image, count or plan", Exit::io);
  } catch (const std::exception& e) {
    return report(std::string("unexpected: ") + e.what(), Exit::io);
  }
}

}  // namespace
}  // namespace moire

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is a failed write, which is reported
  return moire::run_program(argc, argv);
}
