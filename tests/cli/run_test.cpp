// moire run: files, names, determinism and interruption.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "program.h"
#include "reports/html.h"
#include "reports/images.h"
#include "result_files.h"

using namespace moire::cli;
using nlohmann::json;

namespace {

// The board as a scene of a study.
const std::string kBoardScene = "[[scene]]\n" + kBoard.substr(0, kBoard.find("[camera]")) + "[scene.camera]\n" +
                                kBoard.substr(kBoard.find("focal"));

const std::string kStudy =
    "name = \"small\"\nseed = 3\ntrials = 3\nspp = [4, 16]\n"
    "patterns = [\"regular\", \"jittered\", \"zaremba:instance=shift\"]\n"
    "filters = [\"box\", \"mitchell:b=0.5,c=0.25\"]\nimages = \"first-trial\"\n"
    "[[scene]]\nname = \"Edge 1\"\n" +
    kEdge + kBoardScene;
constexpr std::size_t kRows = 2 * 2 * 2 * (1 + 3 + 3);  // scenes, counts, filters, trials of the three patterns

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("--dry-run prints the plan, one case a line, and writes nothing") {
    const Folder folder;
    const Outcome outcome = run_program({"run", folder.write("s.toml", kStudy), "--dry-run", "-o", folder / "out"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    const std::vector<std::string> lines = lines_of(outcome.out);
    REQUIRE(lines.size() == kRows + 1);
    CHECK(lines[0].starts_with("# " + std::to_string(kRows) + " cases"));
    CHECK(lines[1] == "Edge 1 regular 4 box ratio 0");
    CHECK(lines.back() == "checkerboard zaremba:instance=shift 16 mitchell:b=0.5,c=0.25 ratio 2");
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
    const std::vector<std::string> quick = lines_of(run_program({"run", "quick", "--dry-run"}).out);
    // 3 scenes, 5 counts, 4 filters; 3 patterns do not vary and 4 have 4 trials.
    CHECK(quick.size() == 1 + 3 * 5 * 4 * (3 + 4 * 4));
  }

  TEST_CASE("a run writes its results, report and images under the agreed names") {
    const Folder folder;
    const Outcome outcome = run_program({"run", folder.write("s.toml", kStudy), "-o", folder / "deep/out"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    const std::filesystem::path out = folder / "deep/out";
    CHECK(outcome.out.find((out / "report.md").string()) != std::string::npos);
    CHECK(outcome.out.find("jittered") != std::string::npos);
    const std::vector<std::string> lines = lines_of(read_file(out / "results.jsonl"));
    REQUIRE(lines.size() == kRows + 1);
    const json header = json::parse(lines[0]);
    CHECK(header["kind"] == "header");
    CHECK(header["schema"] == "moire.results/1");
    CHECK(header["study"]["name"] == "small");
    CHECK(header["study"]["text"] == kStudy);
    std::size_t with_variance = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const json row = json::parse(lines[i]);
      CHECK(row["kind"] == "row");
      CHECK(row["status"] == "ok");
      CHECK(row["seed"] == 3);
      with_variance += !row["variance_active"].is_null();
      for (const char* key :
           {"image_got", "image_error", "image_exact", "image_got_png", "image_error_png", "image_exact_png"}) {
        CHECK(row[key].is_null() == (row["trial"] != 0));
        if (row["trial"] == 0) CHECK(std::filesystem::exists(out / row[key].get<std::string>()));
      }
    }
    CHECK(with_variance == 2 * 2 * 2 * 2);  // once per scene, count, filter and pattern that varies
    const auto files = files_of(out);
    CHECK(files.count("images/-dge-1_zaremba-instance=shift_16_mitchell-b=0.5-c=0.25_t0.error.exr") == 1);
    CHECK(files.count("images/checkerboard_box.exact.exr") == 1);
    // 4 exact images and 24 cases with 2 each, every one as EXR and PNG; 4 other files, 5 with the
    // page; nothing unfinished left.
    CHECK(files.size() == 2 * (4 + 24 * 2) + (moire::why_no_page().empty() ? 5U : 4U));
    for (const char* name : {"results.csv", "summary.csv", "report.md"}) CHECK(!files.at(name).empty());
    CHECK(lines_of(files.at("results.csv")).size() == kRows + 1);
    CHECK(lines_of(files.at("summary.csv")).size() == 24 + 1);
    const moire::ExrImage image = moire::read_exr((out / "images/checkerboard_box.exact.exr").string());
    CHECK(image.grid == moire::Grid{32, 24});
  }

  TEST_CASE("the same study gives the same bytes, whatever the threads, times apart") {
    const Folder folder;
    const std::string study = folder.write("s.toml", kStudy);
    std::string first_out;
    std::map<std::string, std::string> first;
    for (const char* threads : {"2", "1", "7"}) {
      const Outcome outcome = run_program({"run", study, "-o", folder / "out", "--threads", threads});
      CHECK(outcome.code == 0);
      const auto files = files_of(folder / "out");
      if (first.empty()) {
        first = files;
        first_out = outcome.out;
      }
      CHECK(outcome.out == first_out);
      REQUIRE(files.size() == first.size());
      for (const auto& file : files) {
        CAPTURE(file.first);
        CHECK((file.second == first.at(file.first)));
      }
      std::filesystem::remove_all(folder / "out");
    }
  }

  TEST_CASE("a study of spectra over both layouts writes them beside the images, under names that tell the layout") {
    const Folder folder;
    const std::string study =
        "trials = 3\nspp = [4]\nlayout = [\"pixel\", \"image\"]\npatterns = [\"random\", \"zaremba\"]\n"
        "measures = [\"error\", \"spectrum\"]\nspectrum = { window = \"hann\" }\n[[scene]]\nname = \"e\"\n" +
        kEdge;
    const Outcome outcome = run_program({"run", folder.write("s.toml", study), "-o", folder / "out"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.starts_with("noise over all scenes, box, 4 samples per pixel\n"));
    CHECK(outcome.out.find("  zaremba, layout=image") != std::string::npos);
    const std::filesystem::path images = folder / "out/images";
    for (const char* stem : {"e_random_4_box", "e_random_4_box_image", "e_zaremba_4_box", "e_zaremba_4_box_image"}) {
      for (const char* ending : {".spectrum.exr", ".structured.exr", ".noise.exr", ".spectrum.png", ".spectrum.csv"}) {
        CHECK(std::filesystem::exists(images / (std::string(stem) + ending)));
      }
      CHECK(std::filesystem::exists(images / (std::string(stem) + "_t0.got.exr")));
    }
    // Over the image no power but that of its parts.
    const auto total = moire::read_exr((images / "e_random_4_box_image.spectrum.exr").string());
    const auto structured = moire::read_exr((images / "e_random_4_box_image.structured.exr").string());
    const auto noise = moire::read_exr((images / "e_random_4_box_image.noise.exr").string());
    REQUIRE(total.y.size() == 32 * 24);
    for (std::size_t i = 0; i < total.y.size(); ++i) {
      // Each file is rounded to float.
      const float size = total.y[i] + noise.y[i];
      CHECK(std::abs(total.y[i] - structured.y[i] - noise.y[i]) <= 4 * 0x1p-24F * size);
    }
    std::map<std::string, int> rows;
    for (const std::string& line : lines_of(read_file(folder / "out/results.jsonl"))) {
      const json row = json::parse(line);
      if (row["kind"] == "row") ++rows[row["layout"].get<std::string>()];
    }
    CHECK(rows == std::map<std::string, int>{{"image", 4}, {"pixel", 4}});
    CHECK(read_file(folder / "out/report.md").find("## The answer: what the errors look like") != std::string::npos);
    CHECK(lines_of(read_file(folder / "out/noise_ranking.csv")).size() == 5);
  }

  TEST_CASE("images = none writes no image, images = all those of every trial") {
    const Folder folder;
    const std::string head = "patterns = [\"random\"]\nspp = [4]\ntrials = 2\n", scene = "[[scene]]\n" + kDisk;
    const auto images_of = [&](const std::string& setting) {
      const std::string file = folder.write("s.toml", head + "images = \"" + setting + "\"\n" + scene);
      CHECK(run_program({"run", file, "-o", folder / setting}).code == 0);
      const auto files = files_of(folder / setting);
      return std::count_if(files.begin(), files.end(), [](const auto& f) { return f.first.starts_with("images/"); });
    };
    CHECK(images_of("none") == 0);
    CHECK(images_of("first-trial") == 2 + 4);
    CHECK(images_of("all") == 2 + 8);
  }

  TEST_CASE("an interrupted run ends with code 130 and keeps the rows that were finished") {
    const Folder folder;
    // Far longer than the test: 1000 trials of 4096 samples.
    const std::string study = folder.write("s.toml",
                                           "patterns = [\"random\"]\nspp = [4096]\ntrials = 1000\nimages = "
                                           "\"none\"\n" +
                                               kBoardScene);
    const std::string results = folder / "out/results.jsonl";
    bool sent = false;
    const Outcome outcome = run_program({"run", study, "-o", folder / "out"}, "", 120, [&](pid_t child) {
      if (!sent && lines_of(read_file(results)).size() >= 3) {
        ::kill(child, SIGINT);
        sent = true;
      }
    });
    CHECK(sent);
    CHECK(outcome.code == 130);
    CHECK(outcome.out.empty());
    CHECK(lines_of(outcome.err).size() == 1);
    CHECK(outcome.err.find("interrupted") != std::string::npos);
    const std::vector<std::string> lines = lines_of(read_file(results));
    CHECK(lines.size() >= 3);
    CHECK(lines.size() < 1001);
    for (std::size_t i = 1; i < lines.size(); ++i) CHECK(json::parse(lines[i])["trial"] == i - 1);
  }
}
