// The words of one command.
#include "app/command_words.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <limits>

#include "core/args.h"
#include "core/error.h"
#include "core/names.h"

namespace moire {

std::int64_t whole_number(const std::string& place, const std::string& word, std::int64_t min, std::int64_t max) {
  std::int64_t value = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status != std::errc() || end != word.data() + word.size() || value < min || value > max) {
    throw Error(place, fmt::format("\"{}\" is not possible; give a whole number, {} to {}", word, min, max));
  }
  return value;
}

CommandWords::CommandWords(CLI::App& parent, const std::string& name, const std::string& about,
                           const std::string& example)
    : app_(parent.add_subcommand(name, about)) {
  app_->allow_extras();
  app_->footer("Example:\n  " + example);
}

void CommandWords::positional(const std::string& name, const std::string& about) {
  app_->add_option(name, text_[name], about)->type_name("");
}

void CommandWords::positionals(const std::string& name, const std::string& about) {
  app_->add_option(name, lists_[name], about)->type_name("");
}

void CommandWords::option(const std::string& name, const std::string& metavar, const std::string& about,
                          const std::string& fallback) {
  std::string& value = text_[name] = fallback;
  CLI::Option* option = app_->add_option(name, value, about)->type_name(metavar);
  if (!fallback.empty()) option->default_str(fallback);
}

void CommandWords::flag(const std::string& name, const std::string& about) {
  app_->add_flag(name, flags_[name], about);
}

void CommandWords::draw() {
  option("--seed", "S", "names the experiment, 0 to 2^63 - 1", "1");
  option("--trial", "T", "replicate, 0 to 2^32 - 1", "0");
}

bool CommandWords::chosen() const { return app_->parsed(); }

// The usage line of CLI11 has every word in brackets, as if it could be left out.
std::string CommandWords::help() const {
  std::string text = app_->help("moire") + "\n";
  for (const auto& [name, unused] : text_) {
    const std::size_t at = text.find("[" + name + "]");
    if (at != std::string::npos) text.replace(at, name.size() + 2, name);
  }
  return text;
}

const std::string& CommandWords::name() const { return app_->get_name(); }

void CommandWords::check() const {
  const std::vector<std::string> left = app_->remaining();
  const auto option = std::find_if(left.begin(), left.end(), [](const std::string& word) { return word[0] == '-'; });
  if (option != left.end()) throw Error(place(), unknown_name("option", option->substr(0, option->find('=')), names()));
  if (!left.empty()) {
    throw Error(place(), fmt::format("\"{}\" is one word too many; see {} --help", left.front(), place()));
  }
  for (const CLI::Option* known : app_->get_options()) {
    const auto value = text_.find(known->get_name());
    if (value != text_.end() && known->count() > 0 && value->second.empty()) {
      throw Error(place(), fmt::format("{} is empty; see {} --help", known->get_name(), place()));
    }
  }
}

const std::string& CommandWords::required(const std::string& name) const {
  if (!has(name)) throw Error(place(), fmt::format("{} is missing; see {} --help", name, place()));
  return text(name);
}

std::int64_t CommandWords::integer(const std::string& name, std::int64_t min, std::int64_t max) const {
  return whole_number(name, required(name), min, max);
}

double CommandWords::number(const std::string& name, double min, double max) const {
  const std::string& word = required(name);
  double value = 0;
  if (!parse_number(word, value) || !(value >= min && value <= max)) {
    throw Error(name, fmt::format("\"{}\" is not possible; give a number, {} to {}", word, min, max));
  }
  return value;
}

std::uint64_t CommandWords::seed() const {
  return static_cast<std::uint64_t>(integer("--seed", 0, std::numeric_limits<std::int64_t>::max()));
}

std::uint32_t CommandWords::trial() const {
  return static_cast<std::uint32_t>(integer("--trial", 0, std::numeric_limits<std::uint32_t>::max()));
}

int CommandWords::threads() const {
  return has("--threads") ? static_cast<int>(integer("--threads", 1, kMaxThreads)) : 0;
}

void CommandWords::refuse(const std::string& kind, std::initializer_list<const char*> options) const {
  for (const char* option : options) {
    if (has(option)) throw Error(option, fmt::format("does not go with {}; leave it out", kind));
  }
}

std::vector<std::string_view> CommandWords::names() const {
  std::vector<std::string_view> views;
  for (const auto& [name, unused] : text_) {
    if (name[0] == '-') views.push_back(name);
  }
  for (const auto& [name, unused] : flags_) views.push_back(name);
  views.push_back("--help");
  return views;
}

}  // namespace moire
