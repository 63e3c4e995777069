// Study and scene files: what they mean, what is refused and where, and the plan.
#include "study/study.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "message.h"
#include "study/file_names.h"

using namespace moire;

namespace {

const std::string kEdge = "kind = \"edge\"\nwidth = 32\nheight = 16\nthrough = [16, 8]\n";

std::string study_text(const std::string& head, const std::string& scene = kEdge + "normal = 30\n") {
  return head + "[[scene]]\n" + scene;
}

Study parse(const std::string& text) { return parse_study(text, "s.toml", "s"); }

std::string refusal(const std::string& text) {
  return message_of([&] { plan(parse(text)); });
}

// A folder of its own that is gone at the end of the test.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("moire_study_test_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(file(name)).parent_path());
    std::ofstream(file(name)) << text;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("what a study does not say has its default") {
    const Study study = parse(study_text("patterns = [\"jittered\"]\n"));
    CHECK(study.name == "s");
    CHECK(study.seed == 1);
    CHECK(study.trials == 8);
    CHECK(study.spp == std::vector<int>{1, 4, 16, 64, 256});
    REQUIRE(study.filters.size() == 1);
    CHECK(study.filters[0].text() == "box");
    REQUIRE(study.estimators.size() == 1);
    CHECK(study.estimators[0].text == "ratio");
    CHECK(study.images == Images::first_trial);
    REQUIRE(study.scenes.size() == 1);
    CHECK(study.scenes[0].name == "edge");
    CHECK(study.scenes[0].image.grid() == Grid{32, 16});
  }

  TEST_CASE("a study says everything that the plan needs") {
    const Study study =
        parse(study_text("name = \"mine\"\nseed = 7\ntrials = 3\nspp = [4, 9]\npatterns = [\"regular\", \"random\"]\n"
                         "filters = [\"tent\", \"mitchell:b=0.5,c=0.25\"]\nestimators = [\"ratio\"]\n"
                         "measures = [\"error\"]\nimages = \"none\"\n"));
    CHECK(study.name == "mine");
    CHECK(study.seed == 7);
    CHECK(study.images == Images::none);
    CHECK(study.filters[1].text() == "mitchell:b=0.5,c=0.25");
    const std::vector<Case> cases = plan(study);
    // A regular grid does not vary: one trial. 1 scene x 2 counts x 2 filters x (1 + 3) trials.
    REQUIRE(cases.size() == 16);
    CHECK(describe(study, cases[0]) == "edge regular 4 tent ratio 0");
    CHECK(describe(study, cases[3]) == "edge regular 9 mitchell:b=0.5,c=0.25 ratio 0");
    CHECK(describe(study, cases[4]) == "edge random 4 tent ratio 0");
    CHECK(describe(study, cases[5]) == "edge random 4 tent ratio 1");
    CHECK(describe(study, cases[15]) == "edge random 9 mitchell:b=0.5,c=0.25 ratio 2");
  }

  TEST_CASE("the plan holds every case once, in order") {
    const Study study = parse(
        "patterns = [\"random\", \"jittered\"]\nspp = [4, 1]\ntrials = 2\nfilters = [\"box\", \"tent\"]\n"
        "[[scene]]\nname = \"a\"\n" +
        kEdge + "normal = 1\n[[scene]]\nname = \"b\"\n" + kEdge + "normal = 2\n");
    const std::vector<Case> cases = plan(study);
    CHECK(cases.size() == 32);
    const auto key = [](const Case& c) {
      return std::tuple(c.scene, c.pattern, c.spp, c.filter, c.estimator, c.trial);
    };
    for (std::size_t i = 1; i < cases.size(); ++i) CHECK(key(cases[i - 1]) < key(cases[i]));
  }

  TEST_CASE("a range makes one scene per value, named after it") {
    const Study study =
        parse(study_text("patterns = [\"random\"]\n", kEdge + "normal = { from = 0.0, to = 90.0, step = 1.5 }\n"));
    REQUIRE(study.scenes.size() == 61);
    CHECK(study.scenes[0].name == "edge:normal=0");
    CHECK(study.scenes[1].name == "edge:normal=1.5");
    CHECK(study.scenes[60].name == "edge:normal=90");
    // The stored normal of the last one is exactly (0, 1).
    for (const auto& [name, numbers] : study.scenes[60].image.stored()) {
      if (name == "normal") CHECK(numbers == std::vector<double>{0.0, 1.0});
    }
  }

  TEST_CASE("two ranges make every pair, the later key fastest") {
    const Study study = parse(study_text("patterns = [\"random\"]\n",
                                         "name = \"e\"\nkind = \"edge\"\nwidth = { from = 8, to = 16, step = 8 }\n"
                                         "height = 4\nthrough = [1, 2]\n"
                                         "normal = { from = 1, to = 3, step = 1 }\n"));
    REQUIRE(study.scenes.size() == 6);
    CHECK(study.scenes[0].name == "e:width=8,normal=1");
    CHECK(study.scenes[4].name == "e:width=16,normal=2");
    CHECK(study.scenes[4].image.grid() == Grid{16, 4});
  }

  TEST_CASE("a scene can stand in a file of its own, found from the study's folder") {
    const Folder folder;
    folder.write("deep/scenes/my edge.toml", kEdge + "normal = 30\n");
    const std::string file = folder.file("deep/study.toml");
    const std::string text = "patterns = [\"random\"]\n[[scene]]\nfile = \"scenes/my edge.toml\"\n";
    const Study study = parse_study(text, file, "study");
    REQUIRE(study.scenes.size() == 1);
    CHECK(study.scenes[0].name == "my edge");
    // The text that is hashed holds both files: another scene is another study.
    CHECK(study.text.starts_with(text));
    CHECK(contains(study.text, kEdge));
    CHECK(parse_study(text + "name = \"x\"\n", file, "study").scenes[0].name == "x");

    folder.write("deep/scenes/my edge.toml", kEdge + "normal = [0, 0]\n");
    CHECK(contains(message_of([&] { parse_study(text, file, "study"); }), "my edge.toml:5:"));
    CHECK(contains(message_of([&] { parse_study(text + "width = 3\n", file, "study"); }), "beside \"file\""));
    const std::string missing =
        message_of([&] { parse_study("patterns = [\"random\"]\n[[scene]]\nfile = \"none.toml\"\n", file, "study"); });
    CHECK(contains(missing, "study.toml:3:8"));
    CHECK(contains(missing, "none.toml"));
  }

  TEST_CASE("scene files describe one scene") {
    CHECK(parse_scene(kEdge + "normal = 3\n", "e.toml", "e").name == "e");
    CHECK(parse_scene("name = \"x\"\n" + kEdge + "normal = 3\n", "e.toml", "e").name == "x");
    CHECK(contains(message_of([] { parse_scene(kEdge + "normal = { from = 0, to = 1, step = 1 }\n", "e.toml", "e"); }),
                   "e.toml:5:10: a range"));
  }

  TEST_CASE("what is wrong in a study is refused where it stands, with what would be right") {
    const std::string ok = "patterns = [\"random\"]\n";
    struct Bad {
      std::string text, place, says;
    };
    const Bad bads[] = {
        {study_text("patern = [\"random\"]\n"), "s.toml:1:1", "did you mean patterns"},
        {study_text("patterns = []\n"), "s.toml:1:12", "empty list"},
        {study_text("patterns = \"random\"\n"), "s.toml:1:12", "give a list"},
        {study_text("patterns = [3]\n"), "s.toml:1:13", "text in quotes"},
        {study_text("patterns = [\"jitterd\"]\n"), "s.toml:1:13", "did you mean jittered"},
        {study_text("patterns = [\"random\", \"random\"]\n"), "s.toml:1:23", "twice"},
        {study_text("patterns = [\"random:x=1\"]\n"), "s.toml:1:13", ""},
        {study_text("patterns = [\"zaremba:instance=shfit\"]\n"), "s.toml:1:13", "did you mean shift"},
        {study_text(ok + "filters = [\"bx\"]\n"), "s.toml:2:12", "did you mean box"},
        {study_text(ok + "filters = [\"gaussian:sigma=0\"]\n"), "s.toml:2:12", "sigma"},
        {study_text(ok + "estimators = [\"ration\"]\n"), "s.toml:2:15", "did you mean ratio"},
        {study_text(ok + "estimators = [\"importance:form=sum\"]\n"), "s.toml:2:15", "signed, ratio"},
        {study_text(ok + "estimators = [\"importance\", \"importance:form=signed\"]\n"), "s.toml:2:29",
         "\"importance:form=signed\", which is \"importance\", is listed twice"},
        {study_text(ok + "layout = \"image\"\nestimators = [\"importance\"]\n"), "s.toml:3:15", "layout \"pixel\""},
        {study_text(ok + "measures = [\"eror\"]\n"), "s.toml:2:13", "did you mean error"},
        {study_text(ok + "measures = [\"error\", \"error\"]\n"), "s.toml:2:22", "twice"},
        {study_text(ok + "measures = [\"coverage\"]\n"), "s.toml:2:12", "no \"error\""},
        {study_text(ok + "layout = \"imge\"\n"), "s.toml:2:10", "did you mean image"},
        {study_text(ok + "layout = []\n"), "s.toml:2:10", "empty list"},
        {study_text(ok + "layout = [\"image\", \"image\"]\n"), "s.toml:2:20", "twice"},
        {study_text(ok + "spectrum = 3\n"), "s.toml:2:12", "write a table [spectrum]"},
        {study_text(ok + "spectrum = { widow = \"hann\" }\n"), "s.toml:2:14", "did you mean window"},
        {study_text(ok + "spectrum = { window = \"han\" }\n"), "s.toml:2:23", "did you mean hann"},
        {study_text(ok + "spectrum = { pixels_per_degree = 0 }\n"), "s.toml:2:34", "1 to 1000"},
        {study_text(ok + "images = \"some\"\n"), "s.toml:2:10", "first-trial"},
        {study_text(ok + "images = true\n"), "s.toml:2:10", "text in quotes"},
        {study_text(ok + "name = 3\n"), "s.toml:2:8", "text in quotes"},
        {study_text(ok + "seed = -1\n"), "s.toml:2:8", "seed is -1"},
        {study_text(ok + "seed = 1.5\n"), "s.toml:2:8", "whole number"},
        {study_text(ok + "trials = 0\n"), "s.toml:2:10", "1 to 1000000"},
        {study_text(ok + "trials = 1000001\n"), "s.toml:2:10", "1 to 1000000"},
        {study_text(ok + "spp = []\n"), "s.toml:2:7", "empty list"},
        {study_text(ok + "spp = 4\n"), "s.toml:2:7", "give a list"},
        {study_text(ok + "spp = [0]\n"), "s.toml:2:8", "1 to 16777216"},
        {study_text(ok + "spp = [4, 1000000000]\n"), "s.toml:2:11", "1 to 16777216"},
        {study_text(ok + "spp = [4, 4]\n"), "s.toml:2:11", "twice"},
        {study_text(ok + "spp = [4.0]\n"), "s.toml:2:8", "whole number"},
        {study_text("patterns = [\"jittered\"]\nspp = [10]\n"), "s.toml:1:13", "nearest: 9, 16"},
        {"spp = [4]\n", "s.toml:", "no patterns"},
        {ok, "s.toml:", "no scenes"},
        {ok + "scene = []\n", "s.toml:2:9", "[[scene]]"},
        {ok + "scene = 3\n", "s.toml:2:9", "[[scene]]"},
        {ok + "scene = [3]\n", "s.toml:2:10", "[[scene]]"},
        {ok + "[scene]\nkind = \"edge\"\n", "s.toml:2:1", "[[scene]]"},
        {study_text(ok, kEdge + "normal = 1\n[[scene]]\n" + kEdge + "normal = 2\n"), "s.toml:8:1", "stands above"},
        {study_text(ok, "name = \"\"\n" + kEdge + "normal = 1\n"), "s.toml:2:1", "empty"},
        {study_text(ok, "name = \"a\"\n" + kEdge + "normal = 1\n[[scene]]\nname = \"A\"\n" + kEdge + "normal = 2\n" +
                            "[[scene]]\nname = \"B\"\n" + kEdge + "normal = 2\n"),
         "images", "share the file name"},
        {study_text(ok + "trials = 1000000\n"), "study", "more than 1000000 rows"},
        {study_text(ok, "name = \"" + std::string(250, 'x') + "\"\n" + kEdge + "normal = 1\n"), "images", "255"},
        {study_text(ok, "kind = \"edge\"\nwidth = 1048576\nheight = 1048576\nthrough = [1, 2]\nnormal = 3\n"), "images",
         "1048576 x 1048576"},
    };
    for (const Bad& bad : bads) {
      CAPTURE(bad.text);
      const std::string message = refusal(bad.text);
      CAPTURE(message);
      CHECK(message.starts_with(bad.place));
      CHECK(contains(message, bad.says));
    }
  }

  TEST_CASE("a list of disks is read row by row, over several lines and with whole numbers") {
    const NamedScene scene = parse_scene(
        "kind = \"disks\"\nwidth = 64\nheight = 32\ndisks = [\n  [10.5, 20.25, 0.3],\n"
        "  [40, 20, 3],  # touches the next\n  [45.0, 20.0, 2.0],\n]\n",
        "d.toml", "d");
    const StoredDoubles stored = scene.image.stored();
    REQUIRE(stored.size() == 1);
    CHECK(stored[0].first == "disks");
    CHECK(stored[0].second == std::vector<double>{10.5, 20.25, 0.3, 40, 20, 3, 45, 20, 2});
  }

  TEST_CASE("what is wrong in a scene is refused where it stands, with what would be right") {
    struct Bad {
      std::string text, place, says;
    };
    const std::string edge = "kind = \"edge\"\n", size = "width = 8\nheight = 8\n", through = "through = [1, 2]\n";
    const std::string disks = "kind = \"disks\"\n";
    const Bad bads[] = {
        {"", "e.toml:1:1", "no kind"},
        {"kind = 3\n", "e.toml:1:8", "text in quotes"},
        {"kind = \"egde\"\n", "e.toml:1:8", "did you mean edge"},
        {edge + through + "normal = 3\n", "e.toml:1:1", "no width"},
        {edge + "width = 8\n" + through + "normal = 3\n", "e.toml:1:1", "no height"},
        {edge + "width = 0\nheight = 8\n" + through + "normal = 3\n", "e.toml:2:9", "1 to 1048576"},
        {edge + "width = 8\nheight = -4\n" + through + "normal = 3\n", "e.toml:3:10", "1 to 1048576"},
        {edge + "width = 8.5\nheight = 8\n" + through + "normal = 3\n", "e.toml:2:9", "whole number"},
        {edge + "width = 1048577\nheight = 8\n" + through + "normal = 3\n", "e.toml:2:9", "1 to 1048576"},
        {edge + "width = \"8\"\nheight = 8\n" + through + "normal = 3\n", "e.toml:2:9", "whole number"},
        {edge + "width = [8]\nheight = 8\n" + through + "normal = 3\n", "e.toml:2:9", "whole number"},
        {edge + size + through + "normal = 3\nnorml = 3\n", "e.toml:6:1", "did you mean normal"},
        {edge + size + through + "normal = 3\n[camera]\nfocal = 1\n", "e.toml:7:1", "camera.focal"},
        {edge + size + through + "normal = nan\n", "e.toml:5:10", "not finite"},
        {edge + size + "through = [inf, 1]\nnormal = 3\n", "e.toml:4:12", "not finite"},
        {edge + size + "through = [1, true]\nnormal = 3\n", "e.toml:4:15", "true or false"},
        {edge + size + "through = [1, [2]]\nnormal = 3\n", "e.toml:4:15", "a list"},
        {edge + size + "through = [[1], 2]\nnormal = 3\n", "e.toml:4:17", "among lists"},
        {edge + size + "through = [[1, 2], [3]]\nnormal = 3\n", "e.toml:4:20", "equal length"},
        {edge + size + "through = [[], []]\nnormal = 3\n", "e.toml:4:12", "equal length"},
        {edge + size + "through = [1, 2, 3]\nnormal = 3\n", "e.toml:4:11", "through"},
        {edge + size + "through = [9007199254740993, 2]\nnormal = 3\n", "e.toml:4:12", "no double"},
        {edge + size + "through = 1979-05-27\nnormal = 3\n", "e.toml:4:11", "date"},
        {edge + size + "normal = 3\n", "e.toml:1:1", "through"},
        {edge + size + through + "normal = [0, 0]\n", "e.toml:5:10", "normal"},
        {edge + size + through + "normal = [0, 0, 1]\n", "e.toml:5:10", "normal"},
        {edge + size + through + "[normal]\nfrom = { x = 1 }\n", "e.toml:5:1", "range"},
        {edge + size + through + "normal.a.b = 1\n", "e.toml:5:8", "table within a table"},
        {edge + size + through + "file = \"x\"\n", "e.toml:5:1", "file"},
        {disks + size + "disks = []\n", "e.toml:4:9", "empty"},
        {disks + size + "disks = [[]]\n", "e.toml:4:10", "equal length"},
        {disks + size + "disks = [1, 2, 3]\n", "e.toml:4:9", "[[x, y, radius], ...]"},
        {disks + size + "disks = [[1, 2], [3, 4]]\n", "e.toml:4:9", "[[x, y, radius], ...]"},
        {disks + size + "disks = [[1, 2, 3],\n  [9, 9, 1, 1]]\n", "e.toml:5:3", "equal length"},
        {disks + size + "disks = [[1, 2, 3],\n  [9, nan, 1]]\n", "e.toml:5:7", "not finite"},
        {disks + size + "disks = [[1, 2, 3], [9, 9, 0]]\n", "e.toml:4:9", "radius of disks[1]"},
        {disks + size + "disks = [[1, 2, 3], [30, 9, 1], [1, 4, 3]]\n", "e.toml:4:9", "disks[0] and disks[2]"},
        {disks + size + "center = [1, 2]\nradius = 3\n", "e.toml:4:1", "disks"},
    };
    for (const Bad& bad : bads) {
      CAPTURE(bad.text);
      const std::string message = message_of([&] { parse_scene(bad.text, "e.toml", "e"); });
      CAPTURE(message);
      CHECK(message.starts_with(bad.place));
      CHECK(contains(message, bad.says));
    }
  }

  TEST_CASE("file names keep small letters, digits, dots, equals signs and hyphens") {
    CHECK(file_part("edge:normal=1.5") == "edge-normal=1.5");
    CHECK(file_part("My_scene/..\xc3\xa4") == "-y-scene-..--");
    const Study study = parse(study_text("patterns = [\"zaremba:instance=shift\"]\nspp = [16]\nfilters = [\"box\"]\n"));
    Case c;
    c.trial = 2;
    CHECK(image_stem(study, c) == "images/edge_zaremba-instance=shift_16_box_t2");
    CHECK(exact_stem(study, 0, 0) == "images/edge_box");
    CHECK(keeps_images(study, 0));
    CHECK_FALSE(keeps_images(study, 2));
  }
}
