// moire run --resume: runs that were killed or stopped, and folders that it must not touch.
#include <doctest/doctest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "program.h"
#include "result_files.h"
#include "stopped_runs.h"

using namespace moire::cli;

namespace {

// Many short cases with images among them: a moment drawn at random falls into any stage.
std::string study_with(const std::string& spp) {
  return "name = \"small\"\nseed = 3\ntrials = 3\nspp = " + spp +
         "\n"
         "patterns = [\"regular\", \"jittered\", \"dart-throwing:bank=4,k=500\"]\nfilters = [\"box\", \"tent\"]\n"
         "measures = [\"error\", \"coverage\", \"flat-field\", \"ringing\", \"spectrum\", \"kernel\"]\n"
         "images = \"first-trial\"\n"
         "[[scene]]\nname = \"Edge 1\"\n" +
         kEdge + "[[scene]]\n" + kDisk +
         "[[scene]]\nname = \"lines\"\nkind = \"edge\"\nwidth = 32\nheight = 24\n"
         "lines = { law = \"isotropic\", count = 3 }\n";
}

const std::string kStudy = study_with("[4, 16]");
const std::string kLongStudy = study_with("[64, 256, 1024]");  // about a second

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("runs that are killed or stopped at random moments and go on write what a whole run writes") {
    stop_and_resume(kLongStudy, 3);
  }
}

TEST_SUITE("cli") {
  TEST_CASE("SIGTERM ends after the running case with code 130, and the message says how to go on") {
    const Folder folder;
    folder.write("s.toml", kLongStudy);
    const std::string results = folder / "out/results.jsonl";
    bool sent = false;
    const Outcome outcome = run_study(folder, false, [&](pid_t child) {
      if (sent || lines_of(read_file(results)).size() < 3) return;
      ::kill(child, SIGTERM);
      sent = true;
    });
    CHECK(outcome.code == 130);
    CHECK(outcome.err.starts_with("error: " + results + ": interrupted; "));
    CHECK(outcome.err.find("moire run " + (folder / "s.toml") + " -o " + (folder / "out") + " --resume") !=
          std::string::npos);
    CHECK(lines_of(outcome.err).size() == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "out/results.csv"));
    CHECK(run_study(folder, true).code == 0);
    check_same(files_of(folder / "out"), whole_run(kLongStudy).files);
  }

  TEST_CASE("a run that is complete is resumed without work: every file keeps its bytes, times too") {
    const Folder folder;
    folder.write("s.toml", kStudy);
    CHECK(run_study(folder, true).code == 0);  // a folder that is not there is a fresh start
    const std::string results = read_file(folder / "out/results.jsonl"), csv = read_file(folder / "out/results.csv");
    const auto before = files_of(folder / "out");
    const Outcome again = run_study(folder, true);
    CHECK(again.code == 0);
    CHECK(again.err.empty());
    CHECK((read_file(folder / "out/results.jsonl") == results));
    CHECK((read_file(folder / "out/results.csv") == csv));
    check_same(files_of(folder / "out"), before);

    // Files that are missing are made again from the same cases; others are left as they are.
    std::filesystem::remove_all(folder / "out/images");
    std::filesystem::remove(folder / "out/summary.csv");
    CHECK(run_study(folder, true).code == 0);
    CHECK((read_file(folder / "out/results.jsonl") == results));
    check_same(files_of(folder / "out"), before);
    std::ofstream(folder / "out/images/disk_box.exact.exr", std::ios::trunc);  // as after a crash of the system
    CHECK(run_study(folder, true).code == 0);
    check_same(files_of(folder / "out"), before);
    const std::string image = folder / "out/images/disk_box.exact.png";
    std::ofstream(image) << "mine";
    std::filesystem::remove(folder / "out/images/disk_tent.exact.png");
    CHECK(run_study(folder, true).code == 0);
    CHECK(read_file(image) == "mine");
    CHECK((files_of(folder / "out").at("images/disk_tent.exact.png") == before.at("images/disk_tent.exact.png")));
  }

  TEST_CASE("rows that are missing and a last line that was cut are computed again, and the cut is told") {
    const Folder folder;
    folder.write("s.toml", kStudy);
    CHECK(run_study(folder).code == 0);
    const auto before = files_of(folder / "out");
    const std::vector<std::string> lines = lines_of(read_file(folder / "out/results.jsonl"));
    std::string some;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      if (i % 7 != 3) some += lines[i] + "\n";
    }
    const std::string cut = some + lines.back().substr(0, lines.back().size() / 2);
    for (const std::string& text :
         {some, cut, cut + "\n", some + lines.back(), lines[0].substr(0, 40), std::string()}) {
      std::ofstream(folder / "out/results.jsonl", std::ios::binary) << text;
      const Outcome outcome = run_study(folder, true);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
      CHECK((outcome.err.find("the last line was cut") != std::string::npos) == (text != some && !text.empty()));
      check_same(files_of(folder / "out"), before);
    }
  }

  TEST_CASE("results that do not belong to the study or are damaged are refused with the place, and left alone") {
    const Folder folder;
    folder.write("s.toml", kStudy);
    CHECK(run_study(folder).code == 0);
    const std::string path = folder / "out/results.jsonl", good = read_file(path);
    const std::vector<std::string> lines = lines_of(good);
    const auto with = [&](std::size_t line, const std::string& text) {
      std::string all;
      for (std::size_t i = 0; i < lines.size(); ++i) all += (i == line ? text : lines[i]) + "\n";
      return all;
    };
    const auto header_with = [&](const std::string& pointer, const nlohmann::ordered_json& value) {
      auto header = nlohmann::ordered_json::parse(lines[0]);
      header[nlohmann::ordered_json::json_pointer(pointer)] = value;
      return with(0, header.dump());
    };
    const auto row_with = [&](std::size_t line, const std::string& key, const nlohmann::ordered_json& value) {
      auto row = nlohmann::ordered_json::parse(lines[line]);
      row[key] = value;
      return with(line, row.dump());
    };
    struct Bad {
      std::string text, says;
    };
    const Bad bads[] = {
        {header_with("/study/sha256", "0"), "is of another study"},
        {header_with("/study/name", "x"), "another name of the study"},
        {header_with("/schema", "moire.results/2"), "is of another schema"},
        {header_with("/tool/commit", "0123"), "is of another build (commit \"0123\""},
        {header_with("/tool/flags", "-ffast-math"), "is of another build (flags"},
        {row_with(1, "seed", 4), "is of another seed (4, here 3)"},
        {row_with(5, "seed", 4), ":6: "},
        {row_with(4, "pattern", "random"), ":5: \"Edge 1 random"},
        {with(3, lines[2]), ":4: "},  // there twice
        {with(6, lines[6].substr(0, 30)), ":7: is not a row"},
        {with(6, ""), ":7: is not a row"},
        {with(2, lines[0]), ":3: is not a row"},
        {with(0, lines[1]), ":1: is not the header"},
        {"hello", ":1: is not the header"},
        {"hello\nworld\n", ":1: is not the header"},
        {"[1]", ":1: is not the header"},
        {with(1, "{\"kind\":\"row\",\"scene\":{}}"), ":2: \"scene\" must be"},
        {with(0, "{\"kind\":\"header\",\"tool\":3,\"study\":[1]}"), "is of another schema"},
    };
    for (const Bad& bad : bads) {
      CAPTURE(bad.says);
      std::ofstream(path, std::ios::binary) << bad.text;
      const Outcome outcome = run_study(folder, true);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(outcome.out.empty());
      CHECK(outcome.err.starts_with("error: " + path));
      CHECK(outcome.err.find(bad.says) != std::string::npos);
      CHECK((read_file(path) == bad.text));
    }
  }

  TEST_CASE("a row that is not what its case gives now is found when the case is computed again") {
    const Folder folder;
    folder.write("s.toml", kStudy);
    CHECK(run_study(folder).code == 0);
    const std::string path = folder / "out/results.jsonl";
    std::string text;
    for (const std::string& line : lines_of(read_file(path))) {
      auto row = nlohmann::ordered_json::parse(line);
      // The last trials of a case have gone: its first one is computed again for the variance.
      if (row.value("scene", "") == "disk" && row.value("pattern", "") == "jittered") {
        if (row["trial"] == 2) continue;
        if (row["trial"] == 0 && row["spp"] == 16) row["rmse_all"] = 0.5;
      }
      text += row.dump() + "\n";
    }
    std::ofstream(path, std::ios::binary) << text;
    const Outcome outcome = run_study(folder, true);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);
    CHECK(outcome.err.find("disk jittered 16 box ratio 0: its \"rmse_all\" differs") != std::string::npos);
    CHECK(read_file(path).starts_with(text));
  }

  TEST_CASE("a second run in the same folder is refused while the first one lasts, and not afterwards") {
    const Folder folder;
    folder.write("s.toml", kLongStudy);
    bool tried = false;
    const Outcome first = run_study(folder, false, [&](pid_t child) {
      if (tried || lines_of(read_file(folder / "out/results.jsonl")).size() < 2) return;
      tried = true;
      ::kill(child, SIGSTOP);  // it cannot end before the others have tried
      for (const bool resume : {false, true}) {
        const Outcome second = run_study(folder, resume);
        CHECK(second.code == 3);
        CHECK(second.err.starts_with("error: " + (folder / "out") + ": another run"));
      }
      ::kill(child, SIGCONT);
    });
    CHECK(tried);
    CHECK(first.code == 0);
    check_same(files_of(folder / "out"), whole_run(kLongStudy).files);
    const Outcome third = run_study(folder);
    CHECK(third.code == 0);
    CHECK(third.err.starts_with("note: " + (folder / "out/results.jsonl")));
  }
}

TEST_SUITE("slow") {
  TEST_CASE("fifty runs that are killed or stopped at random moments and go on write what a whole run writes") {
    stop_and_resume(kLongStudy, 50);
  }
}
