// One command of the program: its words as CLI11 finds them, and the checks that turn them into options.
//
// CLI11 splits words into options; everything that can go wrong afterwards is said here, since its own messages name
// neither choices nor nearest names. So it is told that nothing is required and that unknown words may pass.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace moire {

inline constexpr int kMaxThreads = 1024;

// The word as a whole number within [min, max]; throws Error at `place`.
std::int64_t whole_number(const std::string& place, const std::string& word, std::int64_t min, std::int64_t max);

class CommandWords {
 public:
  CommandWords(CLI::App& parent, const std::string& name, const std::string& about, const std::string& example);
  CommandWords(CommandWords&&) = default;
  CommandWords(const CommandWords&) = delete;

  void positional(const std::string& name, const std::string& about);
  // Any number of words, none included.
  void positionals(const std::string& name, const std::string& about);
  // Without a fallback the value is "" when it is not given.
  void option(const std::string& name, const std::string& metavar, const std::string& about,
              const std::string& fallback = "");
  void flag(const std::string& name, const std::string& about);
  // --seed and --trial.
  void draw();

  bool chosen() const;
  std::string help() const;
  const std::string& name() const;
  std::string place() const { return "moire " + name(); }

  // Throws Error for words that are left over and for values that are empty.
  void check() const;

  bool has(const std::string& name) const { return !text(name).empty(); }
  bool is_set(const std::string& name) const { return flags_.at(name); }
  const std::string& text(const std::string& name) const { return text_.at(name); }
  const std::vector<std::string>& list(const std::string& name) const { return lists_.at(name); }
  // Throw Error for words that are missing or wrong.
  const std::string& required(const std::string& name) const;
  std::int64_t integer(const std::string& name, std::int64_t min, std::int64_t max) const;
  double number(const std::string& name, double min, double max) const;
  std::uint64_t seed() const;
  std::uint32_t trial() const;
  // Threads of --threads; 0 when it is not given.
  int threads() const;
  // Throws Error when one of the options is given, which do not go with `kind`.
  void refuse(const std::string& kind, std::initializer_list<const char*> options) const;

 private:
  std::vector<std::string_view> names() const;

  CLI::App* app_;
  std::map<std::string, std::string> text_;  // CLI11 keeps references to the values: a map leaves them in place
  std::map<std::string, std::vector<std::string>> lists_;
  std::map<std::string, bool> flags_;
};

}  // namespace moire
