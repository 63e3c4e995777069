// The commands on good input: what they print and write.
#include <doctest/doctest.h>

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.h"
#include "reports/images.h"

using namespace moire::cli;
using nlohmann::json;

namespace {

// The fields of a CSV line without quotes.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

double number_of(const std::string& text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  REQUIRE(status == std::errc());
  REQUIRE(end == text.data() + text.size());
  return value;
}

// Of standard error, what is no note to a person.
std::string complaints(const std::string& err) {
  std::istringstream lines(err);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("note: ")) kept += line + "\n";
  }
  return kept;
}

Outcome run_ok(const std::vector<std::string>& args) {
  Outcome outcome = run_program(args);
  CAPTURE(args.front());
  CHECK(complaints(outcome.err) == "");
  CHECK(outcome.code == 0);
  return outcome;
}

json without_times(json row) {
  for (auto it = row.begin(); it != row.end();) it = it.key().starts_with("time_") ? row.erase(it) : std::next(it);
  return row;
}

// The patterns that have a time.
constexpr auto kTimed =
    std::to_array<std::string_view>({"random", "jittered-random-time", "scan-time", "zaremba", "hammersley"});

// Names in a folder, sorted.
std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("--version and --help are answered on standard output, each command with an example") {
    CHECK(run_ok({"--version"}).out.starts_with("moire "));
    const std::string help = run_ok({"--help"}).out;
    for (const char* command : {"list", "run", "render", "exact", "points", "filters"}) {
      CAPTURE(command);
      CHECK(help.find(command) != std::string::npos);
      const std::string own = run_ok({command, "--help"}).out;
      CHECK(own.find("Example:") != std::string::npos);
      CHECK(own.find(std::string("moire ") + command) != std::string::npos);
    }
    const std::string render = run_ok({"render", "--help"}).out;
    CHECK(render.find("=box") != std::string::npos);
    CHECK(render.find("=ratio") != std::string::npos);
  }

  TEST_CASE("every catalogue is listed, as text and as JSON with the agreed keys") {
    for (const char* what : {"patterns", "filters", "scenes", "studies", "measures"}) {
      CAPTURE(what);
      const std::string text = run_ok({"list", what}).out;
      const json list = json::parse(run_ok({"list", what, "--json"}).out);
      REQUIRE(list.is_array());
      CHECK(!list.empty());
      for (const json& entry : list) {
        CHECK(text.find(entry.at("name").get<std::string>()) != std::string::npos);
        CHECK(!entry.at("title").get<std::string>().empty());
        CHECK(entry.at("cite").is_string());
        CHECK(entry.contains("dims") == (std::string(what) == "patterns"));
        if (entry.contains("dims")) {
          const bool timed = std::find(kTimed.begin(), kTimed.end(), entry["name"].get<std::string>()) != kTimed.end();
          CHECK(entry["dims"] == (timed ? json::array({2, 3}) : json::array({2})));
        }
        for (const json& param : entry.at("params")) {
          CHECK(param.size() == 6);
          CHECK(param.at("name").is_string());
          CHECK(param.at("required").is_boolean());
          CHECK(param.at("choices").is_array());
          CHECK(param.at("min").is_null() == param.at("max").is_null());
          if (param.at("required").get<bool>()) CHECK(param.at("default").is_null());
          if (!param.at("choices").empty()) {
            const json& choices = param["choices"];
            CHECK(std::find(choices.begin(), choices.end(), param["default"]) != choices.end());
          }
        }
      }
    }
  }

  TEST_CASE("what is listed with its defaults can be given back") {
    const Folder folder;
    const std::string disk = folder.write("disk.toml", kDisk);
    for (const char* what : {"patterns", "filters"}) {
      for (const json& entry : json::parse(run_ok({"list", what, "--json"}).out)) {
        const auto& params = entry["params"];
        // What needs a file has no defaults to be given back.
        if (std::any_of(params.begin(), params.end(), [](const json& p) { return p["required"].get<bool>(); }))
          continue;
        std::string spec = entry["name"].get<std::string>();
        char separator = ':';
        for (const json& param : params) {
          const json& fallback = param["default"];
          spec += separator + param["name"].get<std::string>() + "=" +
                  (fallback.is_string() ? fallback.get<std::string>() : fallback.dump());
          separator = ',';
        }
        CAPTURE(spec);
        const bool is_pattern = std::string(what) == "patterns";
        const json given = json::parse(run_ok({"render", disk, "--json", "--spp", "4", "--pattern",
                                               is_pattern ? spec : "jittered", "--filter", is_pattern ? "box" : spec})
                                           .out);
        const json plain = json::parse(run_ok({"render", disk, "--json", "--spp", "4", "--pattern",
                                               is_pattern ? entry["name"].get<std::string>() : "jittered", "--filter",
                                               is_pattern ? "box" : entry["name"].get<std::string>()})
                                           .out);
        CHECK(given["rmse_active"] == plain["rmse_active"]);
      }
    }
  }

  TEST_CASE("points are CSV with 17 digits, in the pixel, and depend on seed and trial alone") {
    const std::vector<std::string> lines = lines_of(run_ok({"points", "zaremba", "--n", "4"}).out);
    // x = i / N; y = psi_2(i): folded digits with their infinite tail, 1/3 at i = 0. Zaremba's table.
    CHECK(lines == std::vector<std::string>{"x,y", "0,0.33333333333333331", "0.25,0.83333333333333337",
                                            "0.5,0.083333333333333329", "0.75,0.58333333333333337"});
    for (const char* pattern :
         {"regular", "random", "jittered", "n-rooks", "dart-throwing", "hammersley", "hammersley:instance=scramble"}) {
      CAPTURE(pattern);
      const std::string text = run_ok({"points", pattern, "--n", "16", "--seed", "3", "--trial", "2"}).out;
      const std::vector<std::string> rows = lines_of(text);
      REQUIRE(rows.size() == 17);
      for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> fields = fields_of(rows[i]);
        REQUIRE(fields.size() == 2);
        for (const std::string& field : fields) CHECK((number_of(field) >= 0 && number_of(field) < 1));
      }
      CHECK(run_ok({"points", pattern, "--n", "16", "--seed", "3", "--trial", "2", "--dims", "2"}).out == text);
    }
    const std::string one = run_ok({"points", "random", "--n", "8"}).out;
    CHECK(run_ok({"points", "random", "--n", "8", "--seed", "1", "--trial", "0"}).out == one);
    CHECK(run_ok({"points", "random", "--n", "8", "--seed", "2"}).out != one);
    CHECK(run_ok({"points", "random", "--n", "8", "--trial", "1"}).out != one);
  }

  TEST_CASE("points in 3 dimensions are the same points with a time, and only patterns that have one give them") {
    // psi_3(i): digit k, counted from 0, becomes (a_k + k) mod 3, also the leading zeros: 5/26, 5/26 + 1/3, 5/26 + 2/3.
    const std::vector<std::string> lines = lines_of(run_ok({"points", "zaremba", "--n", "3", "--dims", "3"}).out);
    CHECK(lines == std::vector<std::string>{"x,y,t", "0,0.33333333333333331,0.19230769230769232",
                                            "0.33333333333333331,0.83333333333333337,0.52564102564102566",
                                            "0.66666666666666663,0.083333333333333329,0.85897435897435892"});
    for (const std::string_view name : kTimed) {
      const std::string pattern(name);
      CAPTURE(pattern);
      std::vector<std::string> command = {"points", pattern, "--n", "16", "--seed", "3", "--trial", "2"};
      const std::vector<std::string> flat = lines_of(run_ok(command).out);
      command.insert(command.end(), {"--dims", "3"});
      const std::vector<std::string> timed = lines_of(run_ok(command).out);
      REQUIRE(timed.size() == 17);
      for (std::size_t i = 1; i < timed.size(); ++i) {
        const std::vector<std::string> fields = fields_of(timed[i]);
        REQUIRE(fields.size() == 3);
        CHECK(fields[0] + "," + fields[1] == flat[i]);
        CHECK((number_of(fields[2]) >= 0 && number_of(fields[2]) < 1));
      }
    }
    const Outcome refused = run_program({"points", "n-rooks", "--n", "16", "--dims", "3"});
    CHECK(refused.code == 2);
    CHECK(refused.out.empty());
    CHECK(refused.err.starts_with("error: PATTERN: pattern \"n-rooks\" has points in 2 dimensions, without a time"));
    for (const std::string_view name : kTimed) CHECK(refused.err.find(name) != std::string::npos);
  }

  TEST_CASE("exact values of any pixels, also far outside the image, are CSV with their bounds") {
    const Folder folder;
    // A vertical edge through pixel 4: coverage 0.75 there, 0 to the left, 1 to the right, whatever y.
    const std::string edge =
        folder.write("e.toml", "kind = \"edge\"\nwidth = 8\nheight = 8\nthrough = [4.25, 0]\nnormal = [1, 0]\n");
    const std::string pixels = folder.write("p.txt",
                                            "4,0\n3,3\r\n5,-7\n-9223372036854775808,9223372036854775807\n"
                                            "9223372036854775807,-9223372036854775808\n4,1099511627776");
    const std::vector<std::string> lines = lines_of(run_ok({"exact", edge, "--pixels", pixels}).out);
    REQUIRE(lines.size() == 7);
    CHECK(lines[0] == "x,y,value,bound");
    CHECK(lines[2] == "3,3,0,0");
    CHECK(lines[3] == "5,-7,1,0");
    CHECK(lines[4] == "-9223372036854775808,9223372036854775807,0,0");
    CHECK(lines[5] == "9223372036854775807,-9223372036854775808,1,0");
    for (const std::size_t i : {std::size_t{1}, std::size_t{6}}) {
      const std::vector<std::string> fields = fields_of(lines[i]);
      REQUIRE(fields.size() == 4);
      CHECK(fields[0] == "4");
      CHECK(std::abs(number_of(fields[2]) - 0.75) <= number_of(fields[3]));
      CHECK(number_of(fields[3]) < 1e-13);  // the bound promised for edges at box
    }
    CHECK(run_ok({"exact", edge, "--pixels", folder.write("none.txt", "")}).out == "x,y,value,bound\n");
    // For the tent the edge is 1/4 left of the centre of pixel 4: 1 - (3/4)^2 / 2.
    const std::string tent =
        run_ok({"exact", edge, "--filter", "tent", "--pixels", folder.write("q.txt", "4,0\n")}).out;
    CHECK(std::abs(number_of(fields_of(lines_of(tent)[1])[2]) - (1 - 0.5 * 0.75 * 0.75)) < 1e-13);
  }

  TEST_CASE("exact says what a pixel cost and how good the values are, beside the values") {
    const Folder folder;
    const std::string disk = folder.write("disk.toml", kDisk), pixels = folder.write("pixels.txt", "1,2\n3,4\n");
    const std::string image = folder / "exact.exr";
    const std::string of_image = run_ok({"exact", disk, "-o", image}).err;
    CAPTURE(of_image);
    CHECK(of_image.starts_with("note: " + image + ": "));
    CHECK(of_image.find(" active pixels, ") != std::string::npos);
    CHECK(of_image.find(" us of wall time each on ") != std::string::npos);
    CHECK(of_image.find("; bounds at most ") != std::string::npos);
    CHECK(run_ok({"exact", disk, "--pixels", pixels}).err.starts_with("note: " + pixels + ": 2 pixels, "));
    CHECK(run_ok({"exact", disk, "--pixels", folder.write("none.txt", "")}).err.find(": no pixels") !=
          std::string::npos);
  }

  TEST_CASE("exact images are whole EXR files that say what they are") {
    const Folder folder;
    const std::string disk = folder.write("disk.toml", kDisk), out = folder / "ref.exr";
    CHECK(run_ok({"exact", disk, "--filter", "mitchell", "-o", out}).out.empty());
    const moire::ExrImage image = moire::read_exr(out);
    CHECK(image.grid == moire::Grid{32, 24});
    CHECK(image.y[0] == 0.0F);
    CHECK(image.y[12 * 32 + 15] == 1.0F);
    bool has_scene = false;
    for (const auto& [name, value] : image.attributes) {
      if (name != "moire:scene") continue;
      has_scene = true;
      const json scene = json::parse(std::get<std::string>(value));
      CHECK(scene["kind"] == "disk");
      CHECK(scene["radius"] == json::array({8.25}));
    }
    CHECK(has_scene);
    CHECK(names_in(folder / "") == std::vector<std::string>{"disk.toml", "ref.exr"});
    const std::string bytes = read_file(out);
    run_ok({"exact", disk, "--filter", "mitchell", "-o", out});
    CHECK(read_file(out) == bytes);
  }

  TEST_CASE("a rendered image, its error and its row agree with each other") {
    const Folder folder;
    for (const std::string& text : {kEdge, kDisk, kBoard}) {
      CAPTURE(text);
      const std::string scene = folder.write("scene.toml", text);
      const std::string got = folder / "got.exr", error = folder / "error.exr", ref = folder / "ref.exr";
      const json row =
          json::parse(run_ok({"render", scene, "--pattern", "jittered", "--spp", "16", "--filter", "gaussian", "--seed",
                              "5", "--trial", "3", "-o", got, "--error", error, "--json"})
                          .out);
      run_ok({"exact", scene, "--filter", "gaussian", "-o", ref});
      const moire::ExrImage a = moire::read_exr(got), e = moire::read_exr(error), b = moire::read_exr(ref);
      REQUIRE(a.y.size() == 32 * 24);
      double squares = 0;
      for (std::size_t i = 0; i < a.y.size(); ++i) {
        // Each file is rounded to float once, so that the difference of two is off by two roundings at 1.
        const auto ga = static_cast<double>(a.y[i]), ex = static_cast<double>(b.y[i]), er = static_cast<double>(e.y[i]);
        CHECK(std::abs(ga - ex - er) < 2 * 0x1p-24);
        squares += er * er;
        CHECK_FALSE((a.y[i] == 0.0F && std::signbit(a.y[i])));
        CHECK_FALSE((e.y[i] == 0.0F && std::signbit(e.y[i])));
      }
      // The errors in the file are rounded to 24 bits.
      CHECK(std::sqrt(squares / 768) == doctest::Approx(row["rmse_all"].get<double>()).epsilon(1e-6));
      CHECK(row["scene"] == "scene");
      CHECK(row["pattern"] == "jittered");
      CHECK(row["spp"] == 16);
      CHECK(row["filter"] == "gaussian");
      CHECK(row["estimator"] == "ratio");
      CHECK(row["seed"] == 5);
      CHECK(row["trial"] == 3);
      CHECK(row["pixels_total"] == 768);
      CHECK(row["pixels_active"].get<int>() > 0);
      CHECK(row["pixels_active"].get<int>() < 768);
      // The Gaussian's radius of 1.5 has an apron of one pixel on each side.
      CHECK(row["samples_total"] == 34 * 26 * 16);
      CHECK(row["samples_evaluated"].get<int>() < 34 * 26 * 16);
      CHECK(row["fallbacks"].is_number_integer());
      for (const char* time : {"time_setup_ns", "time_render_ns", "time_reference_ns"}) {
        CHECK(row[time].is_number_integer());
      }
      CHECK(row["definition"]["width"] == 32);
    }
  }

  TEST_CASE("importance estimators: one name each, samples without an apron, the same image when exhaustive") {
    const Folder folder;
    const std::string scene = folder.write("edge.toml",
                                           "kind = \"edge\"\nwidth = 32\nheight = 24\nthrough = [16, 12]\n"
                                           "normal = 97.3\n");
    const auto row_of = [&](std::vector<std::string> more) {
      std::vector<std::string> words{"render", scene, "--pattern", "jittered", "--spp", "4", "--json", "--estimator"};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = run_program(words);
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      return nlohmann::json::parse(outcome.out);
    };
    CHECK(row_of({"importance", "--filter", "tent"})["estimator"] == "importance");
    CHECK(row_of({"importance:form=signed", "--filter", "tent"})["estimator"] == "importance");
    for (const char* filter : {"tent", "lanczos", "cone"}) {
      for (const char* estimator : {"importance", "importance:form=ratio"}) {
        const auto some = row_of({estimator, "--filter", filter});
        const auto all = row_of({estimator, "--filter", filter, "--exhaustive"});
        CHECK(some["estimator"] == estimator);
        CHECK(some["samples_total"] == 32 * 24 * 4);
        CHECK(all["samples_evaluated"] == 32 * 24 * 4);
        CHECK(some["samples_evaluated"].get<int>() < 32 * 24 * 4);
        CHECK(some["fallbacks"] == 0);
        for (const char* name : {"rmse_active", "rmse_all", "max_abs_active"}) CHECK(some[name] == all[name]);
      }
    }
  }

  TEST_CASE("the definition gives the doubles stored: a normal of 90 degrees is exactly (0, 1)") {
    const Folder folder;
    const std::string edge =
        folder.write("e.toml", "kind = \"edge\"\nwidth = 8\nheight = 8\nthrough = [4.25, 0.1]\nnormal = 90\n");
    const json row = json::parse(run_ok({"render", edge, "--pattern", "regular", "--spp", "4", "--json"}).out);
    CHECK(row["definition"]["normal"] == json::array({0.0, 1.0}));
    CHECK(row["definition"]["through"] == json::array({4.25, 0.1}));
  }

  TEST_CASE("--exhaustive gives the same image and metrics bit for bit") {
    const Folder folder;
    for (const std::string& text : {kEdge, kDisk, kBoard}) {
      const std::string scene = folder.write("s.toml", text);
      for (const char* filter : {"box", "mitchell"}) {
        std::vector<std::string> fast = {"render", scene,    "--pattern", "n-rooks", "--spp",
                                         "5",      "--json", "--filter",  filter};
        // Opening the image library takes most of the time: one filter's images are enough.
        const bool images = std::string(filter) == "mitchell";
        if (images) fast.insert(fast.end(), {"-o", folder / "fast.exr"});
        std::vector<std::string> full = fast;
        full.push_back("--exhaustive");
        if (images) *(full.end() - 2) = folder / "full.exr";
        json a = without_times(json::parse(run_ok(fast).out)), b = without_times(json::parse(run_ok(full).out));
        CHECK(b["samples_evaluated"] == b["samples_total"]);
        a.erase("samples_evaluated");
        b.erase("samples_evaluated");
        CHECK(a == b);
        if (images) CHECK(read_file(folder / "fast.exr") == read_file(folder / "full.exr"));
      }
    }
  }

  TEST_CASE("render with one set over the image, and the refusal of a pattern that cannot") {
    const Folder folder;
    const std::string disk = folder.write("disk.toml", kDisk);
    const json row =
        json::parse(run_ok({"render", disk, "--pattern", "n-rooks", "--spp", "3", "--layout", "image", "--json"}).out);
    CHECK(row["layout"] == "image");
    CHECK(row["samples_total"] == 3 * 32 * 24);
    CHECK(row["samples_evaluated"].get<int>() < 3 * 32 * 24);
    const Outcome refused = run_program({"render", disk, "--pattern", "regular", "--spp", "4", "--layout", "image"});
    CHECK(refused.code == 2);
    CHECK(refused.err.find("cannot fill an image as one set; these can: random, jittered") != std::string::npos);
    const Outcome unknown = run_program({"render", disk, "--pattern", "random", "--spp", "4", "--layout", "imge"});
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("did you mean image") != std::string::npos);
  }

  TEST_CASE("without --json the metrics are lines of a name and a value") {
    const Folder folder;
    const std::string disk = folder.write("disk.toml", kDisk);
    const std::string text = run_ok({"render", disk, "--pattern", "random", "--spp", "4"}).out;
    for (const char* name : {"rmse_active", "rmse_all", "samples_total", "samples_evaluated", "fallbacks"}) {
      CAPTURE(name);
      CHECK(text.find(std::string("\n") + name + " ") != std::string::npos);
    }
  }

  TEST_CASE("standard output that takes nothing ends with code 3") {
    const Outcome full = run_program({"points", "random", "--n", "100000"}, "/dev/full");
    CHECK(full.code == 3);
    CHECK(full.err.starts_with("error: standard output: "));
    CHECK(lines_of(full.err).size() == 1);
    CHECK(run_program({"list", "patterns"}, "/dev/full").code == 3);
    CHECK(run_program({"--version"}, "/dev/full").code == 3);
  }

  TEST_CASE("a closed pipe ends with code 3, not with a signal") {
    const Folder folder;
    const std::string fifo = folder / "pipe";
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    // Opened for both so that the program's own opening does not wait; closed once it has begun to write.
    int reader = ::open(fifo.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(reader >= 0);
    const Outcome outcome = run_program({"points", "random", "--n", "1000000"}, fifo, 60, [&](pid_t) {
      char block[16];
      if (reader >= 0 && ::read(reader, block, sizeof block) > 0) {
        ::close(reader);
        reader = -1;
      }
    });
    CHECK(outcome.code == 3);
    CHECK(outcome.err.starts_with("error: standard output: "));
  }

  TEST_CASE("commands that touch no image start without the image library") {
    const Outcome outcome = run_program({"list", "patterns"});
    CHECK(outcome.code == 0);
    const std::string program = read_file(MOIRE_PROGRAM);
    CHECK(program.find("libOpenImageIO") == std::string::npos);  // as it would stand among the needed libraries
  }
}
