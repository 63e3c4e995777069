// moire discrepancy, and studies of discrepancies, as a person and as a script get them.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.h"
#include "result_files.h"
#include "run_ok.h"

using namespace moire::cli;
using nlohmann::json;

TEST_SUITE("cli") {
  TEST_CASE("JSON has one object per pattern, n and measure, in the contract's words") {
    const json rows = json::parse(run_ok({"discrepancy", "zaremba", "jittered", "--n", "16,256", "--measure",
                                          "star-l2,edge-linf", "--trials", "5", "--json"})
                                      .out);
    REQUIRE(rows.size() == 8);
    for (const json& row : rows) {
      CHECK(row.size() == 9);
      CHECK(row["dims"] == 2);
      CHECK(row["method"] == (row["measure"] == "star-l2" ? "closed-form" : "exact"));
      CHECK(row["trials"] == (row["pattern"] == "zaremba" ? 1 : 5));
      CHECK(row["stderr"].is_null() == (row["pattern"] == "zaremba"));
      CHECK(row["rms"].get<double>() >= row["mean"].get<double>() * (1 - 1e-15));
    }
    // 6059/4718592 is the square of the first (Warnock's formula in rationals).
    CHECK(std::abs(rows[0]["mean"].get<double>() - std::sqrt(6059.0 / 4718592)) < 1e-16);
    CHECK(rows[1]["mean"].get<double>() == doctest::Approx(17.0 / 96).epsilon(1e-14));
  }

  TEST_CASE("points of a file are scored like a pattern's own") {
    const Folder folder;
    const std::string file = folder / "points.csv";
    std::ofstream(file) << run_ok({"points", "hammersley", "--n", "16", "--dims", "3"}).out;
    for (const std::string dims : {"2", "3"}) {
      const json own = json::parse(
          run_ok({"discrepancy", "hammersley", "--n", "16", "--measure", "star-l2", "--dims", dims, "--json"}).out);
      const json scored =
          json::parse(run_ok({"discrepancy", "--points", file, "--measure", "star-l2", "--dims", dims, "--json"}).out);
      CHECK(own[0]["mean"] == scored[0]["mean"]);
      CHECK(scored[0]["n"] == 16);
      CHECK(scored[0]["pattern"] == file);
    }
  }

  TEST_CASE("Monte Carlo comes near the closed form, and takes its tests and radius from the options") {
    const auto mean = [](std::vector<std::string> more) {
      std::vector<std::string> words = {"discrepancy", "zaremba", "--n", "16", "--measure", "disk-l2", "--json"};
      words.insert(words.end(), more.begin(), more.end());
      return json::parse(run_ok(words).out)[0]["mean"].get<double>();
    };
    const double closed = mean({"--radius", "0.3"}), random = mean({"--radius", "0.3", "--method", "monte-carlo"});
    CHECK(closed != mean({}));
    CHECK(random != closed);
    // 10,000 tests: a standard error of T of about 1%.
    CHECK(std::abs(random / closed - 1) < 0.05);
    CHECK(random != mean({"--radius", "0.3", "--method", "monte-carlo", "--lines", "20000"}));
  }

  TEST_CASE("what cannot be is refused in one line") {
    const auto refused = [](std::vector<std::string> words, const std::string& part) {
      words.insert(words.begin(), "discrepancy");
      const Outcome outcome = run_program(words);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(outcome.out.empty());
      CHECK(lines_of(outcome.err).size() == 1);
      CHECK(outcome.err.find(part) != std::string::npos);
    };
    refused({}, "patterns or --points");
    refused({"zaremba", "--measure", "star-l2"}, "--n");
    refused({"zaremba", "--n", "16"}, "--measure");
    refused({"zaremba", "--n", "16,x", "--measure", "star-l2"}, "\"x\"");
    refused({"zaremba", "--n", "16", "--measure", "star-l9"}, "star-l2");
    refused({"zarembo", "--n", "16", "--measure", "star-l2"}, "zaremba");
    refused({"jittered", "--n", "16", "--measure", "star-l2", "--dims", "3"}, "jittered-random-time");
    refused({"zaremba", "--n", "16", "--measure", "edge-linf", "--dims", "3"}, "star-l2");
    refused({"zaremba", "--n", "16777216", "--measure", "edge-l2"}, "262144");
    refused({"zaremba", "--n", "16", "--measure", "disk-l2", "--radius", "0.7"}, "0.5");
    refused({"zaremba", "--n", "16", "--measure", "star-l2", "--method", "guess"}, "monte-carlo");
    refused({"zaremba", "--n", "16", "--measure", "star-l2", "--lines", "100"}, "--method monte-carlo");
    refused({"zaremba", "--n", "16", "--measure", "star-linf", "--method", "monte-carlo"}, "leave it out");
    refused({"zaremba", "--n", "16", "--measure", "edge-l2", "--radius", "0.1"}, "leave it out");
    const Folder folder;
    const std::string file = folder / "points.csv";
    std::ofstream(file) << "0.5,0.5\n1.0,0.25\n";
    refused({"--points", file, "--measure", "star-l2"}, ":2:");
  }

  TEST_CASE("a study of discrepancies writes results, summary, rates, pictures and a report, and goes on") {
    const Folder folder;
    const std::string study = folder / "d.toml", out = folder / "out";
    std::ofstream(study) << "trials = 4\nn = [16, 64]\npatterns = [\"zaremba\", \"jittered\"]\nmeasures = "
                            "[\"star-l2\", \"edge-l2-printed\"]\n";
    const Outcome run = run_ok({"run", study, "-o", out});
    CHECK(run.out.find("star-l2") != std::string::npos);
    for (const char* name :
         {"results.jsonl", "results.csv", "summary.csv", "slopes.csv", "report.md", "images/points_zaremba_16.png",
          "images/points_jittered_64.png", "images/lines_printed.png"}) {
      CAPTURE(name);
      CHECK(std::filesystem::file_size(out + "/" + name) > 0);
    }
    CHECK(run_ok({"run", study, "-o", out, "--resume"}).out == run.out);
    // As a kill leaves it: some rows, the last one cut.
    const std::map<std::string, std::string> whole = files_of(out);
    std::string text = read_file(out + "/results.jsonl");
    text.resize(text.size() / 2);
    std::ofstream(out + "/results.jsonl", std::ios::binary) << text;
    std::filesystem::remove(out + "/images/points_zaremba_16.png");
    const Outcome again = run_program({"run", study, "-o", out, "--resume"});
    CHECK(again.code == 0);
    CHECK(files_of(out) == whole);
    CHECK(run_ok({"run", study, "-o", out, "--dry-run"}).out.find("20 rows") != std::string::npos);
  }
}
