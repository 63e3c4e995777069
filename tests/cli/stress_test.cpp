// moire stress: its tables, its files, the case that is shown again, and what it refuses.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.h"
#include "run_ok.h"

using namespace moire::cli;
using nlohmann::json;

TEST_SUITE("cli") {
  TEST_CASE("the same seed gives the same bytes for any number of threads, another seed other cases") {
    const auto bytes = [](const char* seed, const char* threads) {
      return run_ok({"stress", "--cases", "40", "--seed", seed, "--threads", threads, "--family", "edges,sums"}).out;
    };
    const std::string one = bytes("1", "1");
    CHECK(one == bytes("1", "3"));
    CHECK(one != bytes("2", "3"));
  }

  TEST_CASE("a case of the table is shown again in full") {
    const json found = json::parse(run_ok({"stress", "--cases", "40", "--family", "disks", "--json"}).out);
    const json& row = found["rows"][0];
    const std::string text =
        run_ok({"stress", "--family", "disks", "--case", std::to_string(row["case"].get<long>())}).out;
    CHECK(text.find(row["words"].get<std::string>()) != std::string::npos);
    CHECK(text.find("pass\n") != std::string::npos);
    CHECK(text.find("  oracle ") != std::string::npos);
  }

  TEST_CASE("stress writes its table, its lines, error growth, its plot and its report") {
    const Folder folder;
    const std::filesystem::path out = folder / "deep/out";
    const std::string text = run_ok({"stress", "--cases", "40", "--family", "edges", "-o", out.string()}).out;
    CHECK(text.find("report: " + (out / "report.md").string() + "\n") != std::string::npos);
    const std::vector<std::string> lines = lines_of(read_file(out / "stress.jsonl"));
    REQUIRE(lines.size() > 2);
    CHECK(json::parse(lines[0])["schema"] == "moire.stress/1");
    CHECK(json::parse(lines[1])["kind"] == "row");
    CHECK(json::parse(lines[1])["family"] == "edges");
    CHECK(json::parse(lines.back())["kind"] == "growth");
    CHECK(lines_of(read_file(out / "stress.csv")).size() == 2);
    CHECK(lines_of(read_file(out / "growth.csv")).size() == lines.size() - 1);
    CHECK(read_file(out / "stress.svg").find("class=\"point\"") != std::string::npos);
    CHECK(read_file(out / "report.md").find("| `edges` |") != std::string::npos);
  }

  TEST_CASE("a family that is not known is answered with the nearest, and a case needs a family") {
    const auto refused = [](const std::vector<std::string>& words) {
      const Outcome outcome = run_program(words);
      CHECK(outcome.code == 2);
      CHECK(outcome.out.empty());
      return outcome.err;
    };
    CHECK(refused({"stress", "--family", "edge"}).find("did you mean edges?") != std::string::npos);
    CHECK(refused({"stress", "--case", "3"}).find("--family") != std::string::npos);
    CHECK(refused({"stress", "--cases", "0"}).find("--cases") != std::string::npos);
  }
}

// Among the first cases of every family are its largest.
TEST_SUITE("heavy") {
  TEST_CASE("stress prints a line for each family and passes") {
    const json found = json::parse(run_ok({"stress", "--cases", "40", "--json"}).out);
    std::vector<std::string> families;
    for (const json& row : found["rows"]) {
      families.push_back(row["family"]);
      CHECK(row["pass"] == true);
      CHECK(row["cases"] >= 1);
      CHECK_FALSE(row["words"].get<std::string>().empty());
      CHECK_FALSE(row["claim"].get<std::string>().empty());
      CHECK(row["error_over_bound"] <= 1);
    }
    CHECK(families == std::vector<std::string>{"edges", "disks", "boards", "kernels", "patterns", "discrepancies",
                                               "sums", "spectra", "reconstruction"});
    CHECK(found["header"]["schema"] == "moire.stress/1");
    CHECK(found["growth"].size() >= families.size());
    CHECK(found["failures"].empty());
  }
}
