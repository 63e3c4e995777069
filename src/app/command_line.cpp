// The commands of the program, by CLI11 (H. Schreiner and others).
#include "app/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_words.h"
#include "app/image_spectrum.h"
#include "core/names.h"
#include "measure/point_spectrum.h"
#include "patterns/pattern.h"
#include "reports/provenance.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr int kMaxRepeats = 1000;
constexpr std::int64_t kMaxCases = 1'000'000'000;  // of a family of hard cases: days of work
constexpr int kMaxSets = 1'000'000;                // of a pattern, as in studies

// The commands. Names of options are given once, in the two functions of a command.

CommandWords list_words(CLI::App& app) {
  CommandWords w(app, "list", "The catalogue: names, parameters and sources", "moire list patterns --json");
  w.positional("WHAT", "patterns, filters, scenes, studies or measures");
  w.flag("--json", "as a JSON array");
  return w;
}

Command list_options(const CommandWords& w) { return ListOptions{w.required("WHAT"), w.is_set("--json")}; }

CommandWords run_words(CLI::App& app) {
  CommandWords w(app, "run", "Run a study: results, images and a report", "moire run quick -o out/quick");
  w.positional("STUDY", "a study file (TOML), or the name of a built-in study");
  w.option("-o", "DIR", "folder of the results; made if it is not there");
  w.option("--threads", "N", "threads, 1 to 1024; default: as many as there are cores");
  w.flag("--resume", "go on with a run that was stopped: cases that are in DIR already are kept");
  w.flag("--dry-run", "print the cases, one a line, and stop");
  return w;
}

Command run_options(const CommandWords& w) {
  RunOptions options;
  options.study = w.required("STUDY");
  options.resume = w.is_set("--resume");
  options.dry_run = w.is_set("--dry-run");
  options.folder = options.dry_run ? w.text("-o") : w.required("-o");
  options.threads = w.threads();
  return options;
}

CommandWords render_words(CLI::App& app) {
  CommandWords w(app, "render", "One sampled image and its error",
                 "moire render disk.toml --pattern jittered --spp 16 --filter gaussian:sigma=0.4 -o disk.exr");
  w.positional("SCENE", "a scene file (TOML)");
  w.option("--pattern", "P", "sampling pattern, NAME or NAME:key=value,...");
  w.option("--spp", "N", "samples per pixel, 1 to 16777216");
  w.option("--layout", "L", "pixel: the pattern in each pixel; image: one set over all of them", "pixel");
  w.option("--filter", "F", "reconstruction filter, NAME or NAME:key=value,...", "box");
  w.option("--estimator", "E", "how samples become a pixel", "ratio");
  w.draw();
  w.option("-o", "FILE", "write the image (float32 EXR)");
  w.option("--error", "FILE", "write image minus exact image (float32 EXR)");
  w.flag("--exhaustive", "evaluate every sample of every pixel, without any skipping");
  w.flag("--json", "print the row of results as JSON");
  return w;
}

Command render_options(const CommandWords& w) {
  RenderOptions options;
  options.scene = w.required("SCENE");
  options.pattern = w.required("--pattern");
  options.spp = w.integer("--spp", 1, kMaxSamples);
  options.layout = w.required("--layout");
  options.filter = w.required("--filter");
  options.estimator = w.required("--estimator");
  options.seed = w.seed();
  options.trial = w.trial();
  options.out = w.text("-o");
  options.error = w.text("--error");
  options.exhaustive = w.is_set("--exhaustive");
  options.json = w.is_set("--json");
  return options;
}

CommandWords exact_words(CLI::App& app) {
  CommandWords w(app, "exact", "The exact image, or exact values of single pixels with their error bounds",
                 "moire exact disk.toml --filter mitchell --pixels pixels.txt");
  w.positional("SCENE", "a scene file (TOML)");
  w.option("--filter", "F", "reconstruction filter, NAME or NAME:key=value,...", "box");
  w.option("-o", "FILE", "write the image (float32 EXR)");
  w.option("--pixels", "FILE", "lines x,y, any 64-bit integers; prints CSV x,y,value,bound");
  w.option("--accuracy", "A",
           "bound aimed at on checkerboards, 1e-15 to 0.1: a larger one takes less time; "
           "default 1e-12, and 1e-9 where a window meets the horizon");
  return w;
}

Command exact_options(const CommandWords& w) {
  if (w.has("-o") == w.has("--pixels")) {
    throw Error(w.place(), "give either -o FILE for the image or --pixels FILE for single pixels");
  }
  return ExactOptions{
      w.required("SCENE"), w.required("--filter"), w.text("-o"), w.text("--pixels"),
      w.has("--accuracy") ? WeightAim::everywhere(w.number("--accuracy", kFinestAim, kCoarsestAim)) : WeightAim{}};
}

CommandWords points_words(CLI::App& app) {
  CommandWords w(app, "points", "A pattern's points in one pixel, CSV x,y", "moire points zaremba --n 16");
  w.positional("PATTERN", "sampling pattern, NAME or NAME:key=value,...");
  w.option("--n", "N", "number of points, 1 to 16777216");
  w.option("--dims", "D", "2 for x,y or 3 for x,y,t", "2");
  w.draw();
  return w;
}

Command points_options(const CommandWords& w) {
  return PointsOptions{w.required("PATTERN"), w.integer("--n", 1, kMaxSamples),
                       static_cast<int>(w.integer("--dims", 2, 3)), w.seed(), w.trial()};
}

CommandWords filters_words(CLI::App& app) {
  CommandWords w(app, "filters", "What filters do, in numbers: blur, ringing, noise and aliasing of their kernels",
                 "moire filters mitchell lanczos:a=2 gaussian:sigma=0.4");
  w.positionals("FILTER", "reconstruction filters, NAME or NAME:key=value,...; default: all, with all their presets");
  w.flag("--json", "as a JSON array, all digits");
  return w;
}

Command filters_options(const CommandWords& w) { return FiltersOptions{w.list("FILTER"), w.is_set("--json")}; }

CommandWords spectrum_words(CLI::App& app) {
  CommandWords w(app, "spectrum", "Which frequencies a pattern, a set of points or the error of an image contains",
                 "moire spectrum jittered --n 1600 --trials 16 -o out/jittered");
  w.positional("WHAT", "a sampling pattern, NAME or NAME:key=value,..., or an image, .exr or .png");
  w.option("--points", "FILE", "in place of WHAT: lines x,y or x,y,t in [0, 1), sets apart by a line #; - is stdin");
  w.option("--reference", "REF", "of an image: what is subtracted; without it the image is an error already");
  w.option("--window", "W", "of an image: none, or hann for images that do not go on periodically; default none");
  w.option("--pixels-per-degree", "P", "of an image: pixels per degree of the eye's field, 1 to 1000; default 32");
  w.option("--n", "N", "of a pattern: number of points, 1 to 16777216");
  w.option("--trials", "T", "of a pattern: sets to average, default 16; 1 if its points do not vary");
  w.option("--seed", "S", "of a pattern: names the experiment, 0 to 2^63 - 1; default 1");
  w.option("--frequencies", "F", "of points: along each axis, even, 4 to 4096; default by their number, 64 to 1024");
  w.option("-o", "DIR", "write spectrum.exr, spectrum.png and radial.csv; DIR is made if it is not there");
  w.flag("--json", "as a JSON object, all digits");
  return w;
}

Command spectrum_options(const CommandWords& w) {
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
    w.refuse("--points", {"--reference", "--window", "--pixels-per-degree", "--n", "--trials", "--seed"});
  } else if (is_image_name(options.what)) {
    w.refuse("an image", {"--n", "--trials", "--seed", "--frequencies"});
    options.reference = w.text("--reference");
    if (w.has("--window")) options.window = find_window(w.text("--window"), "--window");
    if (w.has("--pixels-per-degree")) options.pixels_per_degree = w.number("--pixels-per-degree", 1, 1000);
  } else {
    w.refuse("a pattern", {"--reference", "--window", "--pixels-per-degree"});
    PatternChoice(parse_spec(options.what, "PATTERN"));  // a wrong name is told before a missing count
    options.n = w.integer("--n", 1, kMaxSamples);
    if (w.has("--trials")) options.trials = w.integer("--trials", 1, std::numeric_limits<std::uint32_t>::max());
    if (w.has("--seed")) options.seed = w.seed();
  }
  return options;
}

CommandWords discrepancy_words(CLI::App& app) {
  CommandWords w(app, "discrepancy", "How unevenly points fill the square or the cube: T (L2) and D (L-infinity)",
                 "moire discrepancy zaremba jittered --n 16,256,1600 --measure star-l2,edge-l2");
  w.positionals("PATTERN", "sampling patterns, NAME or NAME:key=value,...");
  w.option("--points", "FILE", "in place of PATTERN: lines x,y or x,y,t in [0, 1), sets apart by a line #; - is stdin");
  w.option("--n", "LIST", "of patterns: numbers of points, with commas between them");
  w.option("--measure", "M", "discrepancies, with commas between them; moire list measures has them");
  w.option("--dims", "D", "2 for x,y or 3 for x,y,t; default 2, or as many as FILE has");
  w.option("--trials", "T", "of patterns: sets; default 16, 1 if their points do not vary");
  w.option("--seed", "S", "names the experiment, 0 to 2^63 - 1", "1");
  w.option("--method", "METHOD", "of T: closed-form or monte-carlo; default closed-form");
  w.option("--lines", "L", "random tests (lines, boxes, disks) per set for monte-carlo; default 10000");
  w.option("--radius", "R", "of disk-l2: one radius, to 1/2; default: uniformly distributed to 1/2");
  w.option("--threads", "N", "threads, 1 to 1024; default: as many as there are cores");
  w.flag("--json", "as a JSON array, all digits");
  return w;
}

// A list with commas; a comma that belongs to a parameter, before another key=, does not separate.
std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> items;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string item = text.substr(begin, end - begin);
    const bool goes_on = !items.empty() && items.back().find(':') != std::string::npos &&
                         item.find('=') != std::string::npos && item.find(':') == std::string::npos;
    if (goes_on) {
      items.back() += "," + item;
    } else {
      items.push_back(item);
    }
    begin = end + 1;
  }
  return items;
}

Command discrepancy_options(const CommandWords& w) {
  DiscrepancyOptions options;
  options.patterns = w.list("PATTERN");
  options.points = w.text("--points");
  if (options.patterns.empty() == options.points.empty()) {
    throw Error(w.place(), "give patterns or --points FILE; see moire discrepancy --help");
  }
  if (options.points.empty()) {
    for (const std::string& word : listed(w.required("--n"))) {
      options.n.push_back(static_cast<int>(whole_number("--n", word, 1, kMaxSamples)));
    }
    if (w.has("--trials")) options.trials = static_cast<int>(w.integer("--trials", 1, kMaxSets));
  } else {
    w.refuse("--points", {"--n", "--trials"});
  }
  options.measures = listed(w.required("--measure"));
  if (w.has("--dims")) options.dims = static_cast<int>(w.integer("--dims", 2, 3));
  options.seed = w.seed();
  options.method = w.text("--method");
  options.lines = w.text("--lines");
  options.radius = w.text("--radius");
  options.threads = w.threads();
  options.json = w.is_set("--json");
  return options;
}

CommandWords bench_words(CLI::App& app) {
  CommandWords w(app, "bench", "Run time against error, for every case of a study", "moire bench -o out/bench");
  w.positional("STUDY", "a study of images, a file (TOML) or a built-in name; default: bench");
  w.option("-o", "DIR", "write bench.csv, bench.jsonl, bench.svg and report.md; DIR is made if it is not there");
  w.option("--repeats", "R", "timings of each case, of which the median is taken, 1 to 1000", "5");
  w.option("--threads", "N", "most threads to try, 1 to 1024; default: as many as there are cores");
  w.flag("--json", "as a JSON object, all digits");
  return w;
}

Command bench_options(const CommandWords& w) {
  BenchOptions options;
  options.study = w.has("STUDY") ? w.text("STUDY") : "bench";
  options.folder = w.text("-o");
  options.repeats = static_cast<int>(w.integer("--repeats", 1, kMaxRepeats));
  options.threads = w.threads();
  options.json = w.is_set("--json");
  return options;
}

CommandWords stress_words(CLI::App& app) {
  CommandWords w(app, "stress", "Hunt for the worst error of everything that is computed, against higher precision",
                 "moire stress -o out/stress");
  w.option("--cases", "N", "cases of each family; families that cost much run a part of them", "2000");
  w.option("--seed", "S", "which cases", "1");
  w.option("--family", "NAME[,NAME...]", "these families alone");
  w.option("--case", "I", "with one family: this case alone, in full");
  w.option("-o", "DIR", "write stress.jsonl, stress.csv, growth.csv, stress.svg and report.md; DIR is made");
  w.option("--threads", "N", "threads, 1 to 1024; default: as many as there are cores");
  w.flag("--json", "as a JSON object, all digits");
  return w;
}

Command stress_options(const CommandWords& w) {
  StressOptions options;
  options.cases = static_cast<std::uint64_t>(w.integer("--cases", 1, kMaxCases));
  options.seed = w.seed();
  if (w.has("--family")) options.families = listed(w.text("--family"));
  if (w.has("--case")) {
    if (options.families.size() != 1) throw Error("--case", "needs one family; add --family NAME");
    w.refuse("--case", {"-o"});
    options.only_case = static_cast<std::uint64_t>(w.integer("--case", 0, kMaxCases));
  }
  options.folder = w.text("-o");
  options.threads = w.threads();
  options.json = w.is_set("--json");
  if (options.only_case && options.json) throw Error("--json", "does not go with --case, which is for a person");
  return options;
}

CommandWords report_words(CLI::App& app) {
  CommandWords w(app, "report", "One page of runs that are there: rankings, charts and images in a single HTML file",
                 "moire report out/quick out/noise -o report.html");
  w.positionals("RUN", "folders of moire run, bench or stress, or their .jsonl files");
  w.option("-o", "FILE", "the page; default: index.html in the folder of the first run");
  w.option("--budget", "MB", "size of the page, 0.5 to 1000 million bytes: images that do not fit are listed", "10");
  w.option("--figures", "DIR", "write each chart as SVG, by Chromium; the page itself only with -o");
  return w;
}

Command report_options(const CommandWords& w) {
  ReportOptions options;
  options.runs = w.list("RUN");
  if (options.runs.empty()) throw Error(w.place(), "RUN is missing; see moire report --help");
  options.out = w.text("-o");
  options.figures = w.text("--figures");
  options.budget = static_cast<std::size_t>(1e6 * w.number("--budget", 0.5, 1000));
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
    CommandWords words;
    Command (*options)(const CommandWords&);
  };
  Entry entries[] = {{list_words(app), list_options},         {run_words(app), run_options},
                     {render_words(app), render_options},     {exact_words(app), exact_options},
                     {points_words(app), points_options},     {filters_words(app), filters_options},
                     {spectrum_words(app), spectrum_options}, {discrepancy_words(app), discrepancy_options},
                     {bench_words(app), bench_options},       {stress_words(app), stress_options},
                     {report_words(app), report_options}};
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
