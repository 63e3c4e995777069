// The command line by CLI11 (H. Schreiner and others); the only file that knows it.
//
// CLI11 splits words into options; everything that can go wrong afterwards is said here, since its own messages name
// neither choices nor nearest names. So it is told that nothing is required and that unknown words may pass.
#include "app/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.h"
#include "measure/point_spectrum.h"
#include "patterns/pattern.h"
#include "reports/provenance.h"

namespace moire {
namespace {

constexpr int kMaxThreads = 1024;

// One command: its words as CLI11 finds them, and the checks that turn them into options.
class Words {
 public:
  Words(CLI::App& parent, const std::string& name, const std::string& about, const std::string& example)
      : app_(parent.add_subcommand(name, about)) {
    app_->allow_extras();
    app_->footer("Example:\n  " + example);
  }

  Words(Words&&) = default;
  Words(const Words&) = delete;

  void positional(const std::string& name, const std::string& about) {
    app_->add_option(name, text_[name], about)->type_name("");
  }
  // Any number of words, none included.
  void positionals(const std::string& name, const std::string& about) {
    app_->add_option(name, lists_[name], about)->type_name("");
  }
  // Without a fallback the value is "" when it is not given.
  void option(const std::string& name, const std::string& metavar, const std::string& about,
              const std::string& fallback = "") {
    std::string& value = text_[name] = fallback;
    CLI::Option* option = app_->add_option(name, value, about)->type_name(metavar);
    if (!fallback.empty()) option->default_str(fallback);
  }
  void flag(const std::string& name, const std::string& about) { app_->add_flag(name, flags_[name], about); }

  bool chosen() const { return app_->parsed(); }
  // The usage line of CLI11 has every word in brackets, as if it could be left out.
  std::string help() const {
    std::string text = app_->help("moire") + "\n";
    for (const auto& [name, unused] : text_) {
      const std::size_t at = text.find("[" + name + "]");
      if (at != std::string::npos) text.replace(at, name.size() + 2, name);
    }
    return text;
  }
  const std::string& name() const { return app_->get_name(); }
  std::string place() const { return "moire " + app_->get_name(); }

  // Throws for words that are left over and for values that are empty.
  void check() const {
    const std::vector<std::string> left = app_->remaining();
    const auto option = std::find_if(left.begin(), left.end(), [](const std::string& word) { return word[0] == '-'; });
    if (option != left.end())
      throw Error(place(), unknown_name("option", option->substr(0, option->find('=')), names()));
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

  bool has(const std::string& name) const { return !text(name).empty(); }
  bool is_set(const std::string& name) const { return flags_.at(name); }
  const std::string& text(const std::string& name) const { return text_.at(name); }
  const std::vector<std::string>& list(const std::string& name) const { return lists_.at(name); }
  const std::string& required(const std::string& name) const {
    if (!has(name)) throw Error(place(), fmt::format("{} is missing; see {} --help", name, place()));
    return text(name);
  }
  std::int64_t integer(const std::string& name, std::int64_t min, std::int64_t max) const {
    const std::string& word = required(name);
    std::int64_t value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc() || end != word.data() + word.size() || value < min || value > max) {
      throw Error(name, fmt::format("\"{}\" is not possible; give a whole number, {} to {}", word, min, max));
    }
    return value;
  }

 private:
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> views;
    for (const auto& [name, unused] : text_) {
      if (name[0] == '-') views.push_back(name);
    }
    for (const auto& [name, unused] : flags_) views.push_back(name);
    views.push_back("--help");
    return views;
  }

  CLI::App* app_;
  std::map<std::string, std::string> text_;  // CLI11 keeps references to the values: a map leaves them in place
  std::map<std::string, std::vector<std::string>> lists_;
  std::map<std::string, bool> flags_;
};

void add_draw(Words& words) {
  words.option("--seed", "S", "names the experiment, 0 to 2^63 - 1", "1");
  words.option("--trial", "T", "replicate, 0 to 2^32 - 1", "0");
}

std::uint64_t seed_of(const Words& words) {
  return static_cast<std::uint64_t>(words.integer("--seed", 0, std::numeric_limits<std::int64_t>::max()));
}

std::uint32_t trial_of(const Words& words) {
  return static_cast<std::uint32_t>(words.integer("--trial", 0, std::numeric_limits<std::uint32_t>::max()));
}

// The commands. Names of options are given once, in the two functions of a command.

Words list_words(CLI::App& app) {
  Words w(app, "list", "The catalogue: names, parameters and sources", "moire list patterns --json");
  w.positional("WHAT", "patterns, filters, scenes, studies or measures");
  w.flag("--json", "as a JSON array");
  return w;
}

Command list_options(const Words& w) { return ListOptions{w.required("WHAT"), w.is_set("--json")}; }

Words run_words(CLI::App& app) {
  Words w(app, "run", "Run a study: results, images and a report", "moire run quick -o out/quick");
  w.positional("STUDY", "a study file (TOML), or the name of a built-in study");
  w.option("-o", "DIR", "folder of the results; made if it is not there");
  w.option("--threads", "N", "threads, 1 to 1024; default: as many as there are cores");
  w.flag("--resume", "go on with a run that was stopped: cases that are in DIR already are kept");
  w.flag("--dry-run", "print the cases, one a line, and stop");
  return w;
}

Command run_options(const Words& w) {
  RunOptions options;
  options.study = w.required("STUDY");
  options.resume = w.is_set("--resume");
  options.dry_run = w.is_set("--dry-run");
  options.folder = options.dry_run ? w.text("-o") : w.required("-o");
  if (w.has("--threads")) options.threads = static_cast<int>(w.integer("--threads", 1, kMaxThreads));
  return options;
}

Words render_words(CLI::App& app) {
  Words w(app, "render", "One sampled image and its error",
          "moire render disk.toml --pattern jittered --spp 16 --filter gaussian:sigma=0.4 -o disk.exr");
  w.positional("SCENE", "a scene file (TOML)");
  w.option("--pattern", "P", "sampling pattern, NAME or NAME:key=value,...");
  w.option("--spp", "N", "samples per pixel, 1 to 16777216");
  w.option("--layout", "L", "pixel: the pattern in each pixel; image: one set over all of them", "pixel");
  w.option("--filter", "F", "reconstruction filter, NAME or NAME:key=value,...", "box");
  w.option("--estimator", "E", "how samples become a pixel", "ratio");
  add_draw(w);
  w.option("-o", "FILE", "write the image (float32 EXR)");
  w.option("--error", "FILE", "write image minus exact image (float32 EXR)");
  w.flag("--exhaustive", "evaluate every sample of every pixel, without any skipping");
  w.flag("--json", "print the row of results as JSON");
  return w;
}

Command render_options(const Words& w) {
  RenderOptions options;
  options.scene = w.required("SCENE");
  options.pattern = w.required("--pattern");
  options.spp = w.integer("--spp", 1, kMaxSamples);
  options.layout = w.required("--layout");
  options.filter = w.required("--filter");
  options.estimator = w.required("--estimator");
  options.seed = seed_of(w);
  options.trial = trial_of(w);
  options.out = w.text("-o");
  options.error = w.text("--error");
  options.exhaustive = w.is_set("--exhaustive");
  options.json = w.is_set("--json");
  return options;
}

Words exact_words(CLI::App& app) {
  Words w(app, "exact", "The exact image, or exact values of single pixels with their error bounds",
          "moire exact disk.toml --filter mitchell --pixels pixels.txt");
  w.positional("SCENE", "a scene file (TOML)");
  w.option("--filter", "F", "reconstruction filter, NAME or NAME:key=value,...", "box");
  w.option("-o", "FILE", "write the image (float32 EXR)");
  w.option("--pixels", "FILE", "lines x,y, any 64-bit integers; prints CSV x,y,value,bound");
  return w;
}

Command exact_options(const Words& w) {
  if (w.has("-o") == w.has("--pixels")) {
    throw Error(w.place(), "give either -o FILE for the image or --pixels FILE for single pixels");
  }
  return ExactOptions{w.required("SCENE"), w.required("--filter"), w.text("-o"), w.text("--pixels")};
}

Words points_words(CLI::App& app) {
  Words w(app, "points", "A pattern's points in one pixel, CSV x,y", "moire points zaremba --n 16");
  w.positional("PATTERN", "sampling pattern, NAME or NAME:key=value,...");
  w.option("--n", "N", "number of points, 1 to 16777216");
  w.option("--dims", "D", "2 for x,y or 3 for x,y,t", "2");
  add_draw(w);
  return w;
}

Command points_options(const Words& w) {
  return PointsOptions{w.required("PATTERN"), w.integer("--n", 1, kMaxSamples),
                       static_cast<int>(w.integer("--dims", 2, 3)), seed_of(w), trial_of(w)};
}

Words filters_words(CLI::App& app) {
  Words w(app, "filters", "What filters do, in numbers: blur, ringing, noise and aliasing of their kernels",
          "moire filters mitchell lanczos:a=2 gaussian:sigma=0.4");
  w.positionals("FILTER", "reconstruction filters, NAME or NAME:key=value,...; default: all, with all their presets");
  w.flag("--json", "as a JSON array, all digits");
  return w;
}

Command filters_options(const Words& w) { return FiltersOptions{w.list("FILTER"), w.is_set("--json")}; }

Words spectrum_words(CLI::App& app) {
  Words w(app, "spectrum", "Which frequencies a pattern, a set of points or the error of an image contains",
          "moire spectrum jittered --n 1600 --trials 16 -o out/jittered");
  w.positional("WHAT", "a sampling pattern, NAME or NAME:key=value,..., or an image, .exr or .png");
  w.option("--points", "FILE", "in place of WHAT: lines x,y or x,y,t in [0, 1), sets apart by a line #; - is stdin");
  w.option("--reference", "REF", "of an image: what is subtracted; without it the image is an error already");
  w.option("--n", "N", "of a pattern: number of points, 1 to 16777216");
  w.option("--trials", "T", "of a pattern: sets to average, default 16; 1 if its points do not vary");
  w.option("--seed", "S", "of a pattern: names the experiment, 0 to 2^63 - 1; default 1");
  w.option("--frequencies", "F", "of points: along each axis, even, 4 to 4096; default by their number, 64 to 1024");
  w.option("-o", "DIR", "write spectrum.exr, spectrum.png and radial.csv; DIR is made if it is not there");
  w.flag("--json", "as a JSON object, all digits");
  return w;
}

// Throws for options that belong to another kind of spectrum.
void check_kind(const Words& w, const std::string& kind, std::initializer_list<const char*> foreign) {
  for (const char* name : foreign) {
    if (w.has(name)) throw Error(name, fmt::format("does not go with {}; leave it out", kind));
  }
}

Command spectrum_options(const Words& w) {
  SpectrumOptions options;
  options.what = w.text("WHAT");
  options.points = w.text("--points");
  options.folder = w.text("-o");
  options.json = w.is_set("--json");
  if (options.what.empty() == options.points.empty()) {
    throw Error(w.place(), "give one of a pattern, an image and --points FILE; see moire spectrum --help");
  }
  if (w.has("--frequencies")) {
    options.frequencies = static_cast<int>(w.integer("--frequencies", kMinFrequencies, kMaxFrequencies));
    if (options.frequencies % 2 != 0) {
      throw Error("--frequencies", fmt::format("\"{}\" is odd; give an even number", options.frequencies));
    }
  }
  if (!options.points.empty()) {
    check_kind(w, "--points", {"--reference", "--n", "--trials", "--seed"});
  } else if (options.what.ends_with(".exr") || options.what.ends_with(".png")) {
    check_kind(w, "an image", {"--n", "--trials", "--seed", "--frequencies"});
    options.reference = w.text("--reference");
  } else {
    check_kind(w, "a pattern", {"--reference"});
    options.n = w.integer("--n", 1, kMaxSamples);
    if (w.has("--trials")) options.trials = w.integer("--trials", 1, std::numeric_limits<std::uint32_t>::max());
    if (w.has("--seed")) options.seed = seed_of(w);
  }
  return options;
}

// The first word where a command belongs.
[[noreturn]] void refuse_command(const CLI::App& app, const std::vector<std::string_view>& commands) {
  const std::vector<std::string> words = app.remaining();
  if (words.empty()) throw Error("moire", "a command is missing; choose from " + join(commands));
  throw Error("moire", unknown_name(words[0][0] == '-' ? "option" : "command", words[0], commands));
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  CLI::App app("moire: error of sampling patterns and reconstruction filters against exact images", "moire");
  app.set_version_flag("--version", "moire " + tool().version);
  app.allow_extras();
  app.require_subcommand(0, 1);  // at most one: a word after a command is not another one (moire list filters)
  app.footer(
      "Exit codes: 0 ok, 1 a comparison or a stated bound failed, 2 usage or input error,\n"
      "3 input/output error, 130 interrupted.\n\nExample:\n  moire run quick -o out/quick");
  struct Entry {
    Words words;
    Command (*options)(const Words&);
  };
  Entry entries[] = {{list_words(app), list_options},        {run_words(app), run_options},
                     {render_words(app), render_options},    {exact_words(app), exact_options},
                     {points_words(app), points_options},    {filters_words(app), filters_options},
                     {spectrum_words(app), spectrum_options}};
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    for (const Entry& e : entries) {
      if (e.words.chosen()) return TextOptions{e.words.help()};
    }
    return TextOptions{app.help() + "\n"};
  } catch (const CLI::CallForVersion& version) {
    return TextOptions{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& e) {
    throw Error("moire", std::string(e.what()) + "; see moire --help");
  }
  std::vector<std::string_view> commands;
  for (const Entry& e : entries) {
    if (e.words.chosen()) {
      e.words.check();
      return e.options(e.words);
    }
    commands.push_back(e.words.name());
  }
  refuse_command(app, commands);
}

}  // namespace moire
