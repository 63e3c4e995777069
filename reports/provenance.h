// Where results come from: the program's build, the kind of machine, and the study.
#pragma once

#include <string>
#include <string_view>

namespace moire {

// How the program was built. commit is "unknown" without git, and that of the last configuration.
struct Tool {
  std::string version, commit, build_type, compiler, flags, fp_contract;
};
Tool tool();

// The machine's kind, "unknown" where the system does not say: nothing that names one machine.
struct Host {
  std::string cpu;
  int cores = 1;
  std::string os;
};
Host host();

// A study's text, exactly as read.
struct StudyText {
  std::string name, text;
};

// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace moire
