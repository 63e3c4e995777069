// moire report as its users call it.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "reports/html.h"
#include "reports/page_reading.h"
#include "run_ok.h"

namespace moire::cli {
namespace {

namespace fs = std::filesystem;

const std::string kStudy =
    "name = \"small\"\ntrials = 2\nspp = [1, 4]\npatterns = [\"jittered\", \"zaremba\"]\nfilters = [\"box\", "
    "\"tent\"]\n"
    "[[scene]]\nname = \"edge\"\n" +
    kEdge;
const std::string kDiscrepancies =
    "name = \"even\"\ntrials = 2\npatterns = [\"jittered\", \"zaremba\"]\nn = [16, 64]\nmeasures = [\"star-l2\"]\n";

// Program and page were built together: without node there is nothing to test.
bool has_page() {
  if (why_no_page().empty()) return true;
  MESSAGE("no page: " << why_no_page());
  return false;
}

void check_error(const Outcome& outcome, int code, const std::string& text) {
  CAPTURE(outcome.err);
  CHECK(outcome.code == code);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find(text) != std::string::npos);
}

// Runs `moire report` with $MOIRE_CHROMIUM set.
Outcome report_with_browser(const std::vector<std::string>& args, const std::string& browser) {
  return run_program(args, "", 120, {}, [&] { ::setenv("MOIRE_CHROMIUM", browser.c_str(), 1); });
}

TEST_SUITE("cli") {
  TEST_CASE("run writes a page as its last file, and report makes the same again") {
    if (!has_page()) return;
    const Folder folder;
    for (const auto& [name, study] : {std::pair("images", kStudy), std::pair("sets", kDiscrepancies)}) {
      const std::string out = folder / name;
      const Outcome run = run_ok({"run", folder.write(std::string(name) + ".toml", study), "-o", out});
      CHECK(run.out.ends_with("report: " + out + "/report.md\nreport: " + out + "/index.html\n"));
      const std::string page = read_file(out + "/index.html");
      CHECK(run_ok({"report", out}).out == "report: " + out + "/index.html\n");
      CHECK(read_file(out + "/index.html") == page);
      run_ok({"report", out + "/results.jsonl", "-o", out + "/again.html"});
      CHECK(read_file(out + "/again.html") == page);
    }
  }

  TEST_CASE("report puts several runs into one page, and links lead from there to their files") {
    if (!has_page()) return;
    const Folder folder;
    run_ok({"run", folder.write("a.toml", kStudy), "-o", folder / "a"});
    run_ok({"run", folder.write("b.toml", kDiscrepancies), "-o", folder / "b"});
    run_ok({"bench", folder / "a.toml", "-o", folder / "c", "--repeats", "1"});
    run_ok({"report", folder / "a", folder / "b", folder / "c", folder / "a", "-o", folder / "all.html"});
    const page::Json data = page::data_of(read_file(folder / "all.html"));
    REQUIRE(data.at("runs").size() == 4);
    CHECK(data.at("title") == "small, even");
    const char* kIds[] = {"small", "even", "small-2", "small-3"};
    for (std::size_t i = 0; i < 4; ++i) CHECK(data.at("runs").at(i).at("id") == kIds[i]);
    CHECK(data.at("runs").at(0).at("folder") == "a");
    CHECK(data.at("runs").at(0).at("images").size() == 2 + 8);
    for (const auto& image : data.at("runs").at(0).at("images")) {
      CHECK(fs::exists(folder / image.at("file").get<std::string>()));
    }
    const auto& bench = data.at("runs").at(2).at("tables");
    for (const char* table : {"bench", "exponents", "scaling"}) CHECK(bench.contains(table));
    CHECK(page::unpacked(bench.at("bench")).at("length") == 8);
    CHECK(data.at("runs").at(1).at("tables").contains("slopes"));
  }

  TEST_CASE("report leaves out images that are gone, and says so") {
    if (!has_page()) return;
    const Folder folder;
    run_ok({"run", folder.write("a.toml", kStudy), "-o", folder / "a"});
    fs::remove_all(folder / "a/images");
    const Outcome outcome = run_program({"report", folder / "a"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.starts_with("note: page: " + (folder / "a") + ": 10 parts are missing in the page, first: "));
    CHECK(lines_of(outcome.err).size() == 1);
    CHECK(page::data_of(read_file(folder / "a/index.html")).at("runs").at(0).at("images").empty());
  }

  TEST_CASE("report says what is wrong with its words, and where") {
    const Folder folder;
    check_error(run_program({"report"}), 2, "moire report: RUN is missing");
    check_error(run_program({"report", folder / "no"}), 3, folder / "no");
    fs::create_directory(folder / "empty");
    check_error(run_program({"report", folder / "empty"}), 2, "holds no results; give a folder of moire run");
    check_error(run_program({"report", folder.write("x.jsonl", "{}\n")}), 2, "x.jsonl: has the schema \"\"");
    check_error(run_program({"report", folder.write("y.jsonl", "no JSON")}), 2, "y.jsonl");
    const std::string header =
        "{\"kind\":\"header\",\"schema\":\"moire.results/1\",\"study\":{\"name\":\"x\",\"text\":\"\"}}\n";
    check_error(run_program({"report", folder.write("z.jsonl", header + "{\"kind\":\"line\"}\n{\"kind\":\"row\"}\n")}),
                2, "z.jsonl:2: is not a row of results");
    check_error(run_program({"report", folder / "empty", "--budget", "0.1"}), 2, "--budget: \"0.1\" is not possible");
  }

  TEST_CASE("report writes what a browser draws as figures, under names that stay in the folder") {
    if (!has_page()) return;
    const Folder folder;
    run_ok({"run", folder.write("a.toml", kDiscrepancies), "-o", folder / "a"});
    fs::remove(folder / "a/index.html");
    // A browser that has drawn already: it also shows how it was called.
    const auto browser = [&](const std::string& figures) {
      const std::string path = folder.write("browser", "#!/bin/sh\nprintf '%s\\n' \"$@\" >'" + (folder / "words") +
                                                           "'\ncat <<'END'\n<html>" + figures + "</html>\nEND\n");
      ::chmod(path.c_str(), 0755);
      return path;
    };
    const std::string begin = "<script type=\"application/json\" id=\"moire-figures\">", end = "</script>";
    const std::vector<std::string> args = {"report", folder / "a", "--figures", folder / "f"};
    const Outcome good = report_with_browser(
        args, browser(begin + R"([{"name":"x=1_a","svg":"\u003csvg>\u003c/svg>"},{"name":"b","svg":""}])" + end));
    CHECK(good.err.empty());
    CHECK(good.out == "figure: " + (folder / "f") + "/x=1_a.svg\nfigure: " + (folder / "f") + "/b.svg\n");
    CHECK(read_file(folder / "f/x=1_a.svg") == "<svg></svg>");
    CHECK(!fs::exists(folder / "a/index.html"));  // only with -o
    const std::vector<std::string> words = lines_of(read_file(folder / "words"));
    REQUIRE(words.size() > 3);
    CHECK(words.back().starts_with("file:///"));
    CHECK(words.back().ends_with("/page.html#figures=1"));
    CHECK(!fs::exists(words.back().substr(7, words.back().rfind('/') - 7)));  // its folder is removed

    for (const char* name : {"../x", "", "a b", ".x", "A"}) {
      const std::string figure = begin + "[{\"name\":\"" + std::string(name) + "\",\"svg\":\"\"}]" + end;
      check_error(report_with_browser(args, browser(figure)), 3, "is no name of a file");
    }
    check_error(report_with_browser(args, browser("")), 3, "--figures: the browser did not draw the page");
    check_error(report_with_browser(args, browser(begin + "{" + end)), 2, "the page's figures: is not a JSON array");
    check_error(report_with_browser(args, folder / "nobody"), 2, "MOIRE_CHROMIUM: ");
    check_error(report_with_browser(args, "/bin/false"), 3, "/bin/false: failed (status 1)");
    check_error(run_program(args, "", 120, {}, [] { ::setenv("PATH", "/nowhere", 1); }), 2,
                "--figures: there is no Chromium to draw them; install the package chromium");
  }
}

}  // namespace
}  // namespace moire::cli
