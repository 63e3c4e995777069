// The data of a page, read back and compared with the rows and images that it was made of.
#include "reports/page_data.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <set>

#include "core/parallel.h"
#include "folder.h"
#include "reports/file.h"
#include "reports/html.h"
#include "reports/images.h"
#include "reports/json.h"
#include "reports/page_reading.h"

namespace moire {
namespace {

using page::Json;

constexpr Grid kGrid{16, 12};

std::vector<float> noise_image(std::uint32_t seed) {
  std::mt19937 bits(seed);
  std::vector<float> image;
  for (int i = 0; i < kGrid.width * kGrid.height; ++i) image.push_back(static_cast<float>(bits()) * 0x1p-33F - 0.25F);
  return image;
}

std::string text_header(const std::string& name, const std::string& text = "name = \"study\"\n") {
  return json_header(tool(), host(), {name, text});
}

// A run of 2 scenes, 1 filter, 4 patterns and 3 counts with an image of each case in `folder`/images. The errors of the
// patterns are in the order c, a, d, b at each count. `time` goes into the times.
PageRun small_run(const Folder& folder, double time = 1000, bool write = true) {
  PageRun run{text_header("study <1>"), folder.file(""), {}, {}};
  run.folder.pop_back();
  if (write) make_folder(run.folder + "/images");
  std::uint32_t seed = 1;
  for (const char* scene : {"edge", "disk"}) {
    const std::string exact = std::string("images/") + scene + "_box.exact.exr";
    if (write) write_exr(run.folder + "/" + exact, kGrid, noise_image(seed), {});
    for (const char* pattern : {"jittered", "random", "hammersley", "zaremba"}) {
      for (const std::int64_t spp : {4, 16, 64}) {
        const double size = pattern[0] == 'h' ? 4 : pattern[0] == 'j' ? 3 : pattern[0] == 'z' ? 2 : 1;
        const std::string stem = std::string("images/") + scene + "_" + pattern + "_" + std::to_string(spp) + "_box_t0";
        if (write) write_exr(run.folder + "/" + stem + ".error.exr", kGrid, noise_image(++seed), {});
        Row row;
        row.set("scene", scene);
        row.set("pattern", pattern);
        row.set("spp", spp);
        row.set("filter", "box");
        row.set("estimator", "ratio");
        row.set("trial", std::int64_t{0});
        row.set("layout", "pixel");
        row.set("width", std::int64_t{kGrid.width});
        row.set("height", std::int64_t{kGrid.height});
        row.set("seed", std::int64_t{7});
        row.set("pixels_active", std::int64_t{100});
        row.set("time_render_ns", time / (static_cast<double>(seed) + 0.1));
        row.set("rmse_active", size / 3 / static_cast<double>(spp));
        row.set("mse_active", size * size / 9 / static_cast<double>(spp * spp));
        row.set("p995_active", size / 7);
        row.set("status", "ok");
        row.set("image_error", stem + ".error.exr");
        row.set("image_exact", exact);
        run.rows.push_back(std::move(row));
      }
    }
  }
  run.tables = page_tables(run.rows, summarize(run.rows), {});
  return run;
}

Json data_of(const PageRun& run, std::size_t budget = kDefaultBudget) {
  return Json::parse(page_data(std::span(&run, 1), run.folder, budget).json);
}

std::vector<std::string> ids_of(const Json& images) {
  std::vector<std::string> ids;
  for (const Json& image : images) ids.push_back(image.at("id"));
  return ids;
}

TEST_SUITE("io") {
  TEST_CASE("a page holds every image, and the rows of its errors bit for bit") {
    const Folder folder;
    const PageRun run = small_run(folder);
    const Json data = data_of(run);
    CHECK(data.at("schema") == "moire.report/1");
    const Json& part = data.at("runs").at(0);
    CHECK(part.at("id") == "study--1-");
    CHECK(part.at("folder") == "");
    CHECK(part.at("header") == Json::parse(run.header));
    CHECK(page::unpacked(part.at("left_out")).empty());
    REQUIRE(part.at("images").size() == 26);
    const Json rows = page::unpacked(part.at("tables").at("image_rows"));
    CHECK(rows.at("length") == 24);
    std::map<std::string, const Row*> by_file;
    for (const Row& row : run.rows) by_file[std::string(row.text("image_error"))] = &row;
    std::size_t errors = 0;
    for (const Json& image : part.at("images")) {
      const std::string file = image.at("file");
      const std::vector<float> want = read_exr(run.folder + "/" + file).y;
      const std::vector<double> got = page::pixel_values(image.at("pixels"));
      CHECK(image.at("pixels").at("w") == kGrid.width);
      CHECK(image.at("pixels").at("h") == kGrid.height);
      REQUIRE(got.size() == want.size());
      const bool exact = image.at("kind") == "exact";
      for (std::size_t i = 0; i < want.size(); ++i) {
        const double value = static_cast<double>(want[i]);
        // Errors are of one size here: all keep 11 bits.
        if (std::fabs(got[i] - value) > (exact ? 0 : std::fabs(value) * 0x1p-11)) FAIL_CHECK(file << " " << i);
      }
      if (exact) continue;
      const Row& row = *by_file.at(file);
      const std::size_t index = image.at("row");
      CHECK(index == errors++);
      CHECK(image.at("range").get<double>() == row.number("p995_active"));
      for (const auto& [name, cell] : row.cells()) CHECK(page::cell(rows, name, index).dump() == json_cell(cell));
      const auto ids = ids_of(part.at("images"));
      CHECK(std::count(ids.begin(), ids.end(), image.at("of").get<std::string>()) == 1);
    }
    const Json ranking = page::unpacked(part.at("tables").at("ranking"));
    CHECK(ranking.at("length") == 24);
    CHECK(page::unpacked(part.at("filter_curves")).at(0).at("filter") == "box");
    CHECK(page::unpacked(part.at("points")).size() == 12);
  }

  TEST_CASE("a page of a small budget holds the telling images, keeps to the budget and lists the others") {
    const Folder folder;
    const PageRun run = small_run(folder);
    const std::size_t all = page_data(std::span(&run, 1), run.folder, kDefaultBudget).json.size();
    for (const double share : {1.0, 0.9, 0.75, 0.6}) {
      const auto budget = static_cast<std::size_t>(share * static_cast<double>(all));
      const PageData page = page_data(std::span(&run, 1), run.folder, budget);
      CHECK(page.notices.empty());
      const Json part = Json::parse(page.json).at("runs").at(0), left_out = page::unpacked(part.at("left_out"));
      CHECK(part.at("images").size() + left_out.size() == 26);
      if (part.at("images").empty()) continue;  // then the tables alone are above it
      CHECK(page.json.size() <= budget + 100);  // what stands around the runs
      const std::vector<std::string> ids = ids_of(part.at("images"));
      const std::vector<std::string> first = {"study--1-/edge_box.exact", "study--1-/edge_hammersley_16_box_t0.error",
                                              "study--1-/disk_box.exact", "study--1-/disk_hammersley_16_box_t0.error",
                                              "study--1-/edge_random_16_box_t0.error"};
      for (std::size_t i = 0; i < std::min(first.size(), ids.size()); ++i) CHECK(ids[i] == first[i]);
      std::set<std::string> files;
      for (const Json& image : part.at("images")) files.insert(image.at("file"));
      for (const Json& left : left_out) {
        CHECK(files.insert(left.at("file")).second);
        CHECK(left.at("label").get<std::string>().find("error: ") == 0);
        CHECK(std::filesystem::exists(run.folder + "/" + left.at("file").get<std::string>()));
      }
    }
    const Json part = data_of(run, all * 9 / 10).at("runs").at(0);
    CHECK(part.at("images").size() < 26);
    CHECK(part.at("images").size() > 5);
  }

  TEST_CASE(
      "which images a page holds depends neither on times nor on threads, and the same run gives the same bytes") {
    const Folder folder;
    const PageRun run = small_run(folder), slow = small_run(folder, 987654.321, false);
    const std::size_t budget = page_data(std::span(&run, 1), run.folder, kDefaultBudget).json.size() * 8 / 10;
    const PageData page = page_data(std::span(&run, 1), run.folder, budget);
    CHECK(page_data(std::span(&run, 1), run.folder, budget).json == page.json);
    {
      const ThreadLimit one(1);
      CHECK(page_data(std::span(&run, 1), run.folder, budget).json == page.json);
    }
    const Json data = Json::parse(page.json), other = data_of(slow, budget);
    CHECK(data != other);
    CHECK(page::without_times(data) == page::without_times(other));
  }

  TEST_CASE("images that are missing or broken are told in one line and nowhere else") {
    const Folder folder;
    const PageRun run = small_run(folder);
    std::filesystem::remove(run.folder + "/images/edge_random_16_box_t0.error.exr");
    std::ofstream(run.folder + "/images/disk_box.exact.exr") << "no image";
    const PageData page = page_data(std::span(&run, 1), run.folder, kDefaultBudget);
    REQUIRE(page.notices.size() == 1);
    CHECK(page.notices[0].find("2 parts are missing in the page") != std::string::npos);
    const Json part = Json::parse(page.json).at("runs").at(0);
    CHECK(part.at("images").size() == 24);
    CHECK(page::unpacked(part.at("left_out")).empty());
  }

  TEST_CASE("tables above the budget are told, in the page as well, and so is what a run lacks") {
    const Folder folder;
    PageRun run = small_run(folder);
    run.notices = {"It is <not> complete."};
    const PageData page = page_data(std::span(&run, 1), run.folder, 1000);
    REQUIRE(page.notices.size() == 2);
    CHECK(page.notices[0] == run.folder + ": It is <not> complete.");
    CHECK(page.notices[1].find("The tables alone are as large as the run's share of the page's --budget") !=
          std::string::npos);
    const Json part = Json::parse(page.json).at("runs").at(0);
    CHECK(part.at("images").empty());
    REQUIRE(part.at("notices").size() == 2);
    CHECK(part.at("notices").at(0) == "It is <not> complete.");
    CHECK(run.folder + ": " + part.at("notices").at(1).get<std::string>() == page.notices[1]);
    CHECK(!data_of(small_run(folder)).at("runs").at(0).contains("notices"));
  }

  TEST_CASE("rows that name files elsewhere, or lack what is said of an image, have none in the page") {
    const Folder folder;
    PageRun run = small_run(folder);
    const std::size_t count = run.rows.size();
    Row row = run.rows.front();
    for (const char* file : {"../x_t0.error.exr", "/etc/x_t0.error.exr", "images/../x_t0.error.exr",
                             "images/.error.exr", "images/x.error.exr", "images/x_t0.error.png", ""}) {
      row.set("image_error", file);
      run.rows.push_back(row);
    }
    row.set("image_error", "images/edge_jittered_4_box_t0.error.exr");
    row.set("spp", Cell());
    run.rows.push_back(row);
    run.rows[0].set("image_exact", "../exr");
    const PageData page = page_data(std::span(&run, 1), run.folder, kDefaultBudget);
    CHECK(page.notices.empty());
    const Json part = Json::parse(page.json).at("runs").at(0);
    CHECK(part.at("images").size() == count + 2);
    for (const Json& image : part.at("images")) {
      if (image.at("file") == "images/edge_jittered_4_box_t0.error.exr") CHECK(!image.contains("of"));
    }
  }

  TEST_CASE("runs of one name have ids of their own, and links lead from the page to each") {
    const Folder folder;
    make_folder(folder.file("a"));
    std::vector<PageRun> runs = {small_run(folder, 1000), small_run(folder, 2000, false)};
    const PageData page = page_data(runs, folder.file("a"), kDefaultBudget);
    CHECK(page.title == "study <1>");
    const Json data = Json::parse(page.json);
    CHECK(data.at("runs").at(0).at("id") == "study--1-");
    CHECK(data.at("runs").at(1).at("id") == "study--1--2");
    for (const Json& run : data.at("runs")) {
      CHECK(run.at("folder") == "..");
      for (const Json& image : run.at("images")) CHECK(image.at("file").get<std::string>().find("../images/") == 0);
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("nothing in the data ends the element that holds it, and it reads back the same") {
    const std::string text = "# </script><script>alert(1)</script> <!-- \xe2\x80\xa8\nname = \"x\"\n";
    const PageRun run{text_header("</title>&\"", text), ".", {}, {}};
    const PageData page = page_data(std::span(&run, 1), ".", kDefaultBudget);
    CHECK(page.json.find('<') == std::string::npos);
    const Json data = Json::parse(page.json);
    CHECK(data.at("runs").at(0).at("header").at("study").at("text") == text);
    CHECK(page.title == "</title>&\"");
    CHECK(html_text(page.title) == "&lt;/title&gt;&amp;&quot;");
    if (!why_no_page().empty()) return;
    const std::string html = html_page(page.title, page.json);
    CHECK(html.size() == empty_page_bytes() + html_text(page.title).size() + page.json.size());
    CHECK(html.find("<title>&lt;/title&gt;&amp;&quot;</title>") != std::string::npos);
    CHECK(page::data_of(html) == data);
    CHECK(html.find("default-src 'none'") != std::string::npos);
  }

  TEST_CASE("tables by columns keep every cell, and one value throughout is written once") {
    Row a, b;
    a.set("x", 0.1);
    a.set("name", "edge");
    b.set("name", "edge");
    b.set("flag", true);
    PageRun run{text_header("t"), ".", {}, {{"summary", {a, b}}}};
    const Json table = data_of(run).at("runs").at(0).at("tables").at("summary");
    CHECK(table.dump() == R"({"length":2,"columns":{"x":[0.1,null],"name":{"all":"edge"},"flag":[null,true]}})");
  }
}

}  // namespace
}  // namespace moire
