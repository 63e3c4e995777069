// moire bench: its files, its JSON and what it refuses. No time is judged.
#include <doctest/doctest.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.h"
#include "reports/html.h"
#include "run_ok.h"

using namespace moire::cli;
using nlohmann::json;

namespace {

const std::string kStudy =
    "trials = 2\nspp = [1, 4]\npatterns = [\"regular\", \"jittered\"]\nfilters = [\"box\", \"mitchell\"]\n"
    "[[scene]]\nname = \"edge\"\n" +
    kEdge + "[[scene]]\nname = \"disk\"\n" + kDisk;
constexpr std::size_t kRows = 2 * 2 * 2 * 2;

// Without its times.
json untimed(const json& row) {
  json kept;
  for (const auto& [key, value] : row.items()) {
    if (!key.starts_with("time_")) kept[key] = value;
  }
  return kept;
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("bench writes its table, its lines, its plot and its report, and prints tables") {
    const Folder folder;
    const std::string study = folder.write("small.toml", kStudy);
    const Outcome outcome = run_ok({"bench", study, "-o", folder / "deep/out", "--repeats", "2", "--threads", "2"});
    const std::filesystem::path out = folder / "deep/out";
    CHECK(outcome.out.find("disk, mitchell\n") != std::string::npos);
    CHECK(outcome.out.find("report: " + (out / "report.md").string() + "\n") != std::string::npos);

    const std::vector<std::string> lines = lines_of(read_file(out / "bench.jsonl"));
    REQUIRE(lines.size() == 1 + kRows + kRows / 2 + 2);
    const json header = json::parse(lines[0]);
    CHECK(header["schema"] == "moire.bench/1");
    CHECK(header["study"]["text"] == kStudy);
    CHECK_FALSE(header["host"]["cpu"].get<std::string>().empty());
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const json row = json::parse(lines[i]);
      CHECK(row["kind"] == (i <= kRows ? "row" : i <= kRows + kRows / 2 ? "exponent" : "scaling"));
    }
    CHECK(lines_of(read_file(out / "bench.csv")).size() == 1 + kRows);
    const std::string svg = read_file(out / "bench.svg");
    CHECK(count_of(svg, "class=\"point\"") == kRows);
    CHECK(count_of(svg, "class=\"frame\"") == 4);
    const std::string report = read_file(out / "report.md");
    CHECK(report.starts_with("# small: run time against error\n"));
    CHECK(report.find("(bench.svg)") != std::string::npos);
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(out)) ++files;
    CHECK(files == (moire::why_no_page().empty() ? 5 : 4));  // and index.html
  }

  TEST_CASE("two benches of a study give the same JSON but for times") {
    const Folder folder;
    const std::string study = folder.write("small.toml", kStudy);
    const json a = json::parse(run_ok({"bench", study, "--json", "--repeats", "1"}).out);
    const json b = json::parse(run_ok({"bench", study, "--json", "--repeats", "2", "--threads", "1"}).out);
    CHECK(a["header"] == b["header"]);
    CHECK(b["scaling"].size() == 1);
    for (const auto& [table, size] : {std::pair{"rows", kRows}, {"exponents", kRows / 2}}) {
      REQUIRE(a[table].size() == size);
      REQUIRE(b[table].size() == size);
      for (std::size_t i = 0; i < size; ++i) CHECK(untimed(a[table][i]) == untimed(b[table][i]));
    }
    for (const json& row : a["rows"]) {
      CHECK(row["time_render_pixel_ns"].get<double>() > 0);
      CHECK(row["exhaustive_same"] == true);
    }
  }

  TEST_CASE("the built-in study bench can be planned") {
    const Outcome outcome = run_ok({"run", "bench", "--dry-run"});
    CHECK(lines_of(outcome.out).size() > 200);
  }

  TEST_CASE("bench refuses what it cannot time in one line, and writes nothing") {
    const Folder folder;
    const std::string points =
        folder.write("points.toml", "[[discrepancy]]\npatterns = [\"random\"]\nn = [4]\nmeasures = [\"star-l2\"]\n");
    const std::string study = folder.write("small.toml", kStudy);
    const std::vector<std::vector<std::string>> wrong = {{"bench", "nosuch"},
                                                         {"bench", points},
                                                         {"bench", study, "--repeats", "0"},
                                                         {"bench", study, "--threads", "x"},
                                                         {"bench", study, "more"},
                                                         {"bench", study, "--resume"}};
    for (std::vector<std::string> args : wrong) {
      args.insert(args.end(), {"-o", folder / "out"});
      CAPTURE(args[2]);
      const Outcome outcome = run_program(args);
      CHECK(outcome.code == 2);
      CHECK(outcome.out.empty());
      CHECK(outcome.err.starts_with("error: "));
      CHECK(lines_of(outcome.err).size() == 1);
      CHECK_FALSE(std::filesystem::exists(folder / "out"));
    }
  }
}
