// moire report as its users call it.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "reports/html.h"
#include "reports/json.h"
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
    check_error(run_program({"report", folder.write("x.jsonl", "{}\n")}), 2, "x.jsonl: is no results file of moire");
    for (const char* text : {"no JSON", "", "\n", "scene,pattern\nedge,jittered\n", "[1]\n", "\xff\xfe\n"}) {
      check_error(run_program({"report", folder.write("y.jsonl", text)}), 2,
                  "y.jsonl: is no results file of moire; give a run's folder or its results.jsonl");
    }
    check_error(run_program({"report", folder.write("s.jsonl", "{\"schema\":\"moire.other/1\"}\n")}), 2,
                "s.jsonl: has the schema \"moire.other/1\"");
    const std::string header = json_header(tool(), host(), {"x", ""}) + "\n";
    check_error(run_program({"report", folder.write("z.jsonl", header + "{\"kind\":\"line\"}\n{\"kind\":\"row\"}\n")}),
                2, "z.jsonl:2: is not a row of results");
    check_error(run_program({"report", folder / "empty", "--budget", "0.1"}), 2, "--budget: \"0.1\" is not possible");
  }

  TEST_CASE("a header that lacks what a page shows, and rows that a page cannot take, are refused with their line") {
    const Folder folder;
    run_ok({"run", folder.write("a.toml", kStudy), "-o", folder / "a"});
    const std::vector<std::string> lines = lines_of(read_file(folder / "a/results.jsonl"));
    REQUIRE(lines.size() == 13);
    // The file with line `number` changed by `change`.
    const auto refused = [&](std::size_t number, const auto& change, const std::string& text) {
      std::string bytes;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        page::Json line = page::Json::parse(lines[i]);
        if (i + 1 == number) change(line);
        bytes += line.dump() + "\n";
      }
      check_error(run_program({"report", folder.write("b.jsonl", bytes)}), 2,
                  "b.jsonl:" + std::to_string(number) + ": " + text);
    };
    for (const char* part : {"study", "tool", "host"}) {
      refused(
          1, [&](page::Json& line) { line.erase(part); }, "the header lacks \"" + std::string(part) + ".");
      refused(
          1, [&](page::Json& line) { line[part] = 1; }, "the header lacks \"" + std::string(part) + ".");
    }
    refused(
        1, [](page::Json& line) { line["study"].erase("sha256"); }, "the header lacks \"study.sha256\", a text");
    refused(
        1, [](page::Json& line) { line["host"]["cores"] = "2"; }, "the header lacks \"host.cores\", an integer");
    refused(
        3, [&](page::Json& line) { line = page::Json::parse(lines[1]); },
        "\"edge jittered 1 box ratio 0\" stands in line 2");
    refused(
        4, [](page::Json& line) { line["rmse_active"] = "0.1"; }, "\"rmse_active\" must be a number or null");
    refused(
        2, [](page::Json& line) { line["time_render_ns"] = true; }, "\"time_render_ns\" must be a number");
    for (const auto& spp : {page::Json(0), page::Json(-4), page::Json(1.5), page::Json("4"), page::Json()}) {
      refused(
          5, [&](page::Json& line) { line["spp"] = spp; }, "\"spp\" must be an integer from 1 on");
    }
    refused(
        6, [](page::Json& line) { line.erase("trial"); }, "\"trial\" must be an integer from 0 on");
    refused(
        7, [](page::Json& line) { line["scene"] = 3; }, "\"scene\" must be a text");
    refused(
        8, [](page::Json& line) { line["status"] = 3; }, "\"status\" is of another type than in the lines above");
    refused(
        9, [](page::Json& line) { line["scene"] = "a|b"; }, "the scene \"a|b\" has a '|'");
  }

  TEST_CASE("a run that was stopped has a page of what is there, which says how much that is") {
    if (!has_page()) return;
    const Folder folder;
    for (const auto& [name, study] : {std::pair("images", kStudy), std::pair("sets", kDiscrepancies)}) {
      const std::string out = folder / name;
      run_ok({"run", folder.write(std::string(name) + ".toml", study), "-o", out});
      const std::vector<std::string> lines = lines_of(read_file(out + "/results.jsonl"));
      const std::string whole = page::without_times(page::data_of(read_file(out + "/index.html")));
      const auto page_of_lines = [&](const std::vector<std::size_t>& kept, const std::string& notice) {
        std::string bytes = lines[0] + "\n";
        for (const std::size_t i : kept) bytes += lines[i] + "\n";
        folder.write(std::string(name) + "/results.jsonl", bytes);
        const Outcome outcome = run_program({"report", out});
        CAPTURE(outcome.err);
        CHECK(outcome.code == 0);
        const page::Json data = page::data_of(read_file(out + "/index.html"));
        const page::Json& run = data.at("runs").at(0);
        CHECK(run.contains("notices") == !notice.empty());
        if (notice.empty()) {
          CHECK(outcome.err.empty());
        } else {
          CHECK(outcome.err == "note: page: " + out + ": " + run.at("notices").at(0).get<std::string>() + "\n");
          CHECK(run.at("notices").at(0).get<std::string>().find(notice) != std::string::npos);
        }
        return data;
      };
      const std::size_t rows = lines.size() - 1;
      const std::string of_rows = " of the " + std::to_string(rows) + " rows of its study";
      page_of_lines({}, "0" + of_rows);
      page_of_lines({1, 2, 3}, "3" + of_rows);
      // Rows in any order, as a run that was killed leaves them, are put into that of the study.
      std::vector<std::size_t> backwards;
      for (std::size_t i = rows; i > 0; --i) backwards.push_back(i);
      CHECK(page::without_times(page_of_lines(backwards, "")) == whole);
    }
    // Means of sets are over the trials that are there: of 16 jittered points both, of 64 the first. The file is still
    // backwards.
    const std::vector<std::string> lines = lines_of(read_file(folder / "sets/results.jsonl"));
    folder.write("sets/results.jsonl", lines[0] + "\n" + lines.back() + "\n" + lines[lines.size() - 2] + "\n" +
                                           lines[lines.size() - 3] + "\n" + "{\"kind\":\"ro");
    const Outcome outcome = run_program({"report", folder / "sets"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("The last line of the results is cut") != std::string::npos);
    const page::Json part = page::data_of(read_file(folder / "sets/index.html")).at("runs").at(0);
    const page::Json summary = page::unpacked(part.at("tables").at("summary"));
    CHECK(summary.at("length") == 2);
    CHECK(page::cell(summary, "trials", 0) == 2);
    CHECK(page::cell(summary, "trials", 1) == 1);
  }

  TEST_CASE("a page that cannot be written is told before the runs are read") {
    const Folder folder;
    folder.write("file", "");
    check_error(run_program({"report", folder / "no", "-o", folder / "gone/x.html"}), 3,
                "gone/x.html: cannot be written");
    check_error(run_program({"report", folder / "no", "-o", folder / "file/x.html"}), 3,
                "file/x.html: cannot be written");
    fs::create_directory(folder / "sub");
    check_error(run_program({"report", folder / "no", "-o", folder / "sub"}), 3, "cannot be written: it is a folder");
    check_error(run_program({"report", folder / "no", "-o", folder / "x.html"}), 3, folder / "no");
    CHECK(std::distance(fs::directory_iterator(folder / ""), fs::directory_iterator()) == 2);  // nothing is left behind
  }

  TEST_CASE("stress and bench write the page of their folder, and report makes the same again") {
    if (!has_page()) return;
    const Folder folder;
    const std::string study = folder.write("a.toml", kStudy);
    for (const std::vector<std::string>& args :
         {std::vector<std::string>{"stress", "--cases", "20", "--family", "edges"},
          {"bench", study, "--repeats", "1"}}) {
      const std::string out = folder / args[0];
      std::vector<std::string> words = args;
      words.insert(words.end(), {"-o", out});
      CHECK(run_ok(words).out.ends_with("report: " + out + "/report.md\nreport: " + out + "/index.html\n"));
      const std::string page = read_file(out + "/index.html");
      run_ok({"report", out});
      CHECK(read_file(out + "/index.html") == page);
    }
    check_error(run_program({"stress", "--family", "edges,edges"}), 2, "--family: \"edges\" is listed twice");
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
