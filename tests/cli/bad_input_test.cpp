// Bad input: one clear line on standard error, the right exit code, nothing on standard output.
#include <doctest/doctest.h>

#include "program.h"

using namespace moire::cli;

namespace {

struct Bad {
  std::vector<std::string> args;
  int code;
  std::vector<std::string> says;  // parts of the message
};

void check_refused(const Bad& bad) {
  std::string words;
  for (const std::string& word : bad.args) words += word + " ";
  CAPTURE(words);
  const Outcome outcome = run_program(bad.args);
  CAPTURE(outcome.err);
  CHECK_FALSE(outcome.late);
  CHECK(outcome.code == bad.code);
  CHECK(outcome.out.empty());
  const std::vector<std::string> lines = lines_of(outcome.err);
  CHECK(lines.size() == 1);
  CHECK(outcome.err.starts_with("error: "));
  for (const std::string& part : bad.says) {
    CAPTURE(part);
    CHECK(outcome.err.find(part) != std::string::npos);
  }
}

// A scene with one line changed, and where and how it is refused.
struct BadScene {
  std::string text, place, says;
};

void check_scene_refused(const BadScene& bad) {
  const Folder folder;
  const std::string file = folder.write("s.toml", bad.text);
  CAPTURE(bad.text);
  const std::string place = file + ":" + bad.place;
  check_refused({{"exact", file, "-o", folder / "x.exr"}, 2, {place, bad.says}});
  CHECK_FALSE(std::filesystem::exists(folder / "x.exr"));
  check_refused({{"render", file, "--pattern", "random", "--spp", "4"}, 2, {place, bad.says}});
}

std::string edge_with(const std::string& rest) { return "kind = \"edge\"\nwidth = 8\nheight = 8\n" + rest + "\n"; }
std::string disk_with(const std::string& rest) { return "kind = \"disk\"\nwidth = 8\nheight = 8\n" + rest + "\n"; }
std::string disks_with(const std::string& rest) { return "kind = \"disks\"\nwidth = 8\nheight = 8\n" + rest + "\n"; }
std::string board_with(const std::string& rest) {
  return "kind = \"checkerboard\"\nwidth = 8\nheight = 8\n" + rest + "\n";
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("an unknown command or option is answered with the nearest ones") {
    check_refused({{}, 2, {"a command is missing", "list"}});
    check_refused({{"rendr"}, 2, {"\"rendr\"", "did you mean render"}});
    check_refused({{"--verbos"}, 2, {"--verbos"}});
    check_refused({{"list"}, 2, {"WHAT is missing"}});
    check_refused({{"list", "pattern"}, 2, {"did you mean patterns"}});
    check_refused({{"list", "patterns", "--jsn"}, 2, {"did you mean --json"}});
    check_refused({{"list", "patterns", "extra"}, 2, {"\"extra\" is one word too many"}});
    check_refused({{"list", "patterns", "--json=maybe"}, 2, {"json"}});
  }

  TEST_CASE("missing and malformed options are named") {
    const Folder folder;
    const std::string edge = folder.write("edge.toml", kEdge);
    const auto render = [&](std::vector<std::string> more) {
      more.insert(more.begin(), {"render", edge});
      return more;
    };
    check_refused({{"render"}, 2, {"SCENE is missing"}});
    check_refused({render({}), 2, {"--pattern is missing"}});
    check_refused({render({"--pattern", "random"}), 2, {"--spp is missing"}});
    check_refused({render({"--pattern", "random", "--spp"}), 2, {"--spp"}});
    check_refused({render({"--pattern", "random", "--spp", "4", "--spp", "5"}), 2, {"--spp"}});
    check_refused({render({"--patern", "random", "--spp", "4"}), 2, {"did you mean --pattern"}});
    for (const char* count : {"0", "-1", "1000000000", "16777217", "99999999999999999999", "4.5", "4x", "", "nan"}) {
      check_refused({render({"--pattern", "random", "--spp", count}), 2, {"--spp"}});
    }
    check_refused({render({"--pattern", "random", "--spp", "1000000000"}), 2, {"1 to 16777216"}});
    check_refused({render({"--pattern", "jittered", "--spp", "10"}), 2, {"nearest: 9, 16"}});
    check_refused({render({"--pattern", "jitered", "--spp", "4"}), 2, {"did you mean jittered"}});
    check_refused({render({"--pattern", "", "--spp", "4"}), 2, {"--pattern is empty"}});
    check_refused({render({"--pattern", ":x=1", "--spp", "4"}), 2, {"a name is missing"}});
    check_refused({render({"--pattern", "jittered:", "--spp", "4"}), 2, {"key=value"}});
    check_refused({render({"--pattern", "jittered:amont=1", "--spp", "4"}), 2, {"did you mean amount"}});
    check_refused({render({"--pattern", "jittered:amount=nan", "--spp", "4"}), 2, {"amount"}});
    check_refused({render({"--pattern", "jittered:amount=2", "--spp", "4"}), 2, {"0 to 1"}});
    check_refused({render({"--pattern", "jittered:amount=1,amount=1", "--spp", "4"}), 2, {"twice"}});
    check_refused({render({"--pattern", "zaremba:instance=shfit", "--spp", "4"}), 2, {"did you mean shift"}});
    check_refused({render({"--pattern", "random", "--spp", "4", "--filter", "gausian"}), 2, {"did you mean gaussian"}});
    check_refused({render({"--pattern", "random", "--spp", "4", "--filter", "tent:radius=-1"}), 2, {"radius"}});
    check_refused({render({"--pattern", "random", "--spp", "4", "--filter", "box:width=inf"}), 2, {"width"}});
    check_refused({render({"--pattern", "random", "--spp", "4", "--estimator", "rato"}), 2, {"did you mean ratio"}});
    const auto estimate = [&](std::vector<std::string> more) {
      more.insert(more.begin(), {"--pattern", "random", "--spp", "4", "--estimator"});
      return render(more);
    };
    check_refused({estimate({"importnce"}), 2, {"did you mean importance", "unnormalised, control-variate"}});
    check_refused({estimate({"importance:form=sum"}), 2, {"form", "signed, ratio"}});
    check_refused({estimate({"importance:from=ratio"}), 2, {"did you mean form"}});
    check_refused({estimate({"ratio:form=ratio"}), 2, {"takes no parameters"}});
    check_refused({estimate({"importance", "--layout", "image"}), 2, {"--estimator", "layout \"pixel\""}});
    check_refused({render({"--pattern", "random", "--spp", "4", "--seed", "-1"}), 2, {"--seed"}});
    check_refused({render({"--pattern", "random", "--spp", "4", "--seed", "9223372036854775808"}), 2, {"--seed"}});
    check_refused({render({"--pattern", "random", "--spp", "4", "--trial", "4294967296"}), 2, {"--trial"}});
    check_refused({render({"--pattern", "random", "--spp", "4", "-o", "x.png"}), 2, {"-o", ".exr"}});
    check_refused({{"exact", edge}, 2, {"either -o FILE", "--pixels FILE"}});
    check_refused({{"exact", edge, "-o", folder / "a.exr", "--pixels", edge}, 2, {"either -o FILE"}});
    check_refused({{"points", "zaremba"}, 2, {"--n is missing"}});
    check_refused({{"points", "--n", "4"}, 2, {"PATTERN is missing"}});
    check_refused({{"points", "zaremba", "--n", "0"}, 2, {"--n"}});
    check_refused({{"points", "regular", "--n", "5"}, 2, {"nearest: 4, 9"}});
    check_refused({{"points", "zarenba", "--n", "4"}, 2, {"did you mean zaremba"}});
    check_refused({{"points", "zaremba", "--n", "4", "--dims", "4"}, 2, {"--dims", "2 to 3"}});
    check_refused({{"points", "regular", "--n", "4", "--dims", "3"}, 2, {"2 dimensions"}});
    check_refused({{"run", "quick"}, 2, {"-o is missing"}});
    check_refused({{"run", "quik", "-o", folder / "out"}, 2, {"did you mean quick"}});
    check_refused({{"run", "quick", "-o", folder / "out", "--threads", "0"}, 2, {"--threads", "1 to 1024"}});
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  }

  TEST_CASE("wrong numbers in scenes are refused where they stand") {
    const BadScene scenes[] = {
        {edge_with("through = [nan, 1]\nnormal = 3"), "4:12", "not finite"},
        {edge_with("through = [1, 2]\nnormal = inf"), "5:10", "not finite"},
        {edge_with("through = [1, 2]\nnormal = [0, 0]"), "5:10", "normal"},
        {edge_with("through = [1, 2]\nnormal = \"up\""), "5:10", "normal"},
        {edge_with("through = 3\nnormal = 3"), "4:11", "through"},
        {edge_with("through = [1, 2]\nnormal = 3\nnorml = 4"), "6:1", "did you mean normal"},
        {edge_with("through = [1, 2]"), "1:1", "normal"},
        {disk_with("center = [4, 4]\nradius = 0"), "5:10", "radius"},
        {disk_with("center = [4, 4]\nradius = -2.5"), "5:10", "radius"},
        {disk_with("center = [4, 4]\nradius = nan"), "5:10", "not finite"},
        {disk_with("center = [4]\nradius = 2"), "4:10", "center"},
        {disk_with("center = [4, 4]\nradius = [2]"), "5:10", "radius"},
        {disk_with("radius = 2"), "1:1", "center"},
        {disks_with("disks = []"), "4:9", "empty"},
        {disks_with("disks = [4, 4, 2]"), "4:9", "[[x, y, radius], ...]"},
        {disks_with("disks = [[4, 4]]"), "4:9", "[[x, y, radius], ...]"},
        {disks_with("disks = [[4, 4, 2],\n [9, 4, 2, 1]]"), "5:2", "equal length"},
        {disks_with("disks = [[4, 4, 2], [9, 4, -1]]"), "4:9", "radius of disks[1]"},
        {disks_with("disks = [[4, 4, 2], [9, 4, inf]]"), "4:28", "not finite"},
        {disks_with("disks = [[4, 4, 2], [1e16, 4, 1]]"), "4:9", "disks[1]"},
        {disks_with("disks = [[4, 4, 2], [99, 4, 1], [4, 5, 1]]"), "4:9", "disks[0] and disks[2] (counted from 0)"},
        {disks_with("disks = [[4, 4, 2], [6.9999999999999991, 4, 1]]"), "4:9", "overlap by 8.88e-16 pixels"},
        {disks_with("disk = [[4, 4, 2]]"), "4:1", "did you mean disks"},
        {disks_with(""), "1:1", "disks"},
        {board_with("homography = [[1, 0, 0], [0, 1, 0], [0, 0, 0]]\nextent = [0, 1, 0, 1]"), "4:14", "homography"},
        {board_with("homography = [[1, 2, 3], [2, 4, 6], [0, 0, 1]]\nextent = [0, 1, 0, 1]"), "4:14", "homography"},
        {board_with("homography = [[1, 0], [0, 1]]\nextent = [0, 1, 0, 1]"), "4:14", "homography"},
        {board_with("homography = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nextent = [1, 0, 0, 1]"), "5:10", "extent"},
        {board_with("homography = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nextent = [0, 1, 1, 1]"), "5:10", "extent"},
        {board_with("homography = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nextent = [0, 1]"), "5:10", "extent"},
        {board_with("homography = [[1, 0, 0], [0, 1, 0], [0, 0, nan]]\nextent = [0, 1, 0, 1]"), "4:", "not finite"},
        {board_with("extent = [0, 1, 0, 1]\n[camera]\nfocal = 0"), "6:9", "focal"},
        {board_with("extent = [0, 1, 0, 1]\n[camera]\nfocal = 8\nheight = 0"), "7:10", "height"},
        {board_with("extent = [0, 1, 0, 1]\n[camera]\nfocal = 8\npich = 3"), "7:1", "did you mean camera.pitch"},
        {board_with("extent = [0, 1, 0, 1]"), "1:1", "homography"},
    };
    for (const BadScene& scene : scenes) check_scene_refused(scene);
  }

  TEST_CASE("wrong sizes, kinds and texts are refused where they stand") {
    const auto deep_key = [](int parts) {
      std::string key = "a";
      for (int i = 1; i < parts; ++i) key += ".a";
      return key;
    };
    const BadScene scenes[] = {
        {"", "1:1", "no kind"},
        {"kind = \"dsk\"\n", "1:8", "did you mean disk"},
        {"kind = 3\n", "1:8", "text in quotes"},
        {"kind = \"disk\"\nwidth = 0\nheight = 8\ncenter = [1, 1]\nradius = 1\n", "2:9", "1 to 1048576"},
        {"kind = \"disk\"\nwidth = 8\nheight = 99999999\ncenter = [1, 1]\nradius = 1\n", "3:10", "1 to 1048576"},
        {"kind = \"disk\"\nwidth = 8\ncenter = [1, 1]\nradius = 1\n", "1:1", "no height"},
        {"kind = \"disk\"\nwidth = 8\nheight = 8\ncenter = [1, 1\n", "", "this is not TOML"},
        {"kind = \"disk\"\nwidth = 8\nwidth = 8\n", "3:", "this is not TOML"},
        {"kind = \"disk", "1:", "this is not TOML"},
        {std::string("kind = \"disk\"\0", 14), "1:", "this is not TOML"},
        {"\xff\xfe", "1:1", "this is not TOML"},
        // The parser would follow the dots by recursion, to the end of the stack.
        {"kind = \"disk\"\n" + deep_key(100000) + " = 1\n", "2:130", "dotted parts"},
        {"[" + deep_key(200000) + "]\n", "1:", "dotted parts"},
        {"# " + deep_key(1000) + "\nkind = \"dsk\"\n", "2:8", "did you mean disk"},
        {"kind = \"disk\"\nname = \"two\\nlines\"\n", "2:8", "line breaks"},
        {"kind = \"disk\"\nname = \"a`b\"\n", "2:8", "backquotes"},
        {kDisk + "radios = 2\n", "6:1", "did you mean radius"},
        {kDisk + "\"new\\nline\" = 2\n", "6:1", "new\\nline"},
        {"kind = \"disk\"\nwidth = 8\nheight = 8\ncenter = [1, 1]\nradius = { from = 1, to = 2, step = 1 }\n", "5:10",
         "one number"},
    };
    for (const BadScene& scene : scenes) check_scene_refused(scene);
  }

  TEST_CASE("an image that no file can hold is refused before it is computed") {
    const Folder folder;
    const std::string huge = folder.write(
        "huge.toml", "kind = \"edge\"\nwidth = 1048576\nheight = 1048576\nthrough = [1, 2]\nnormal = 30\n");
    check_refused({{"exact", huge, "-o", folder / "x.exr"}, 2, {"1048576 x 1048576"}});
    check_refused(
        {{"render", huge, "--pattern", "random", "--spp", "1", "-o", folder / "x.exr"}, 2, {"1048576 x 1048576"}});
    check_refused({{"render", huge, "--pattern", "random", "--spp", "1", "--exhaustive"}, 2, {"1048576 x 1048576"}});
  }

  TEST_CASE("files that cannot be read or written end with code 3") {
    const Folder folder;
    const std::string edge = folder.write("edge.toml", kEdge), blocked = folder.write("file", "x");
    const std::string none = folder / "none.toml", deep = folder / "no/folder/x.exr";
    check_refused({{"exact", none, "-o", folder / "x.exr"}, 3, {none}});
    check_refused({{"render", none, "--pattern", "random", "--spp", "4"}, 3, {none}});
    check_refused({{"run", none, "-o", folder / "out"}, 3, {none}});
    check_refused({{"exact", folder / "", "-o", folder / "x.exr"}, 3, {}});
    check_refused({{"exact", edge, "--pixels", none}, 3, {none}});
    check_refused({{"exact", edge, "-o", deep}, 3, {deep}});
    check_refused({{"render", edge, "--pattern", "random", "--spp", "4", "-o", deep}, 3, {deep}});
    check_refused({{"render", edge, "--pattern", "random", "--spp", "4", "--error", deep}, 3, {deep}});
    check_refused({{"render", edge, "--pattern", "random", "--spp", "4", "-o", "a.exr", "--error", "a.exr"},
                   2,
                   {"--error", "two names"}});
    const std::string long_name(300, 'n');
    check_refused({{"run", long_name, "-o", folder / "out"}, 2, {"STUDY"}});
    check_refused({{"run", "quick", "-o", blocked}, 3, {blocked}});
    check_refused({{"run", "quick", "-o", blocked + "/out"}, 3, {blocked}});
    check_refused({{"run", "quick", "-o", "/proc/moire"}, 3, {"/proc/moire"}});
    std::filesystem::create_directories(folder / "taken/results.jsonl");
    check_refused({{"run", "quick", "-o", folder / "taken"}, 3, {"results.jsonl"}});
    std::filesystem::create_directories(folder / "folder.exr");
    check_refused({{"exact", edge, "-o", folder / "folder.exr"}, 3, {"folder.exr"}});
  }

  TEST_CASE("a list of pixels is refused at its first line that is none") {
    const Folder folder;
    const std::string edge = folder.write("edge.toml", kEdge);
    const std::pair<std::string, std::string> lists[] = {
        {"1,2\n3\n", "2:2"},
        {"1;2\n", "1:2"},
        {"1.5,2\n", "1:2"},
        {"1,2,3\n", "1:4"},
        {"a,2\n", "1:1"},
        {"1, 2\n", "1:3"},
        {"\n1,2\n", "1:1"},
        {"1,2\n\n\n", "2:1"},
        {"9223372036854775808,0\n", "1:"},
        {"0,-9223372036854775809\n", "1:"},
        {"x,y\n1,2\n", "1:1"},
        {"1,2x", "1:4"},
    };
    for (const auto& [text, place] : lists) {
      const std::string file = folder.write("p.txt", text);
      check_refused({{"exact", edge, "--pixels", file}, 2, {file + ":" + place, "x,y"}});
    }
  }

  TEST_CASE("a study is refused where it is wrong, before anything is written") {
    const Folder folder;
    const std::string patterns = "patterns = [\"random\"]\n", scene = "[[scene]]\n" + kDisk;
    const std::pair<std::string, std::vector<std::string>> studies[] = {
        {"", {":1:1", "no patterns"}},
        {patterns, {"no scenes"}},
        {"patterns = [\"random\"\n", {"this is not TOML"}},
        {"patern = [\"random\"]\n" + scene, {":1:1", "did you mean patterns"}},
        {"patterns = [\"randm\"]\n" + scene, {":1:13", "did you mean random"}},
        {"patterns = [\"jittered\"]\nspp = [10]\n" + scene, {":1:13", "nearest: 9, 16"}},
        {patterns + "spp = [1000000000]\n" + scene, {":2:8", "1 to 16777216"}},
        {patterns + "filters = [\"bx\"]\n" + scene, {":2:12", "did you mean box"}},
        {patterns + "seed = \"one\"\n" + scene, {":2:8", "whole number"}},
        {patterns + "trials = 1000000\n" + scene, {"more than 1000000 rows"}},
        {patterns + scene + scene, {"stands above"}},
        {"name = \"two\\tcolumns\"\n" + patterns + scene, {":1:8", "control characters"}},
        {patterns + "images = \"none\"\nspp = [16777216]\n[[scene]]\nkind = \"disk\"\nwidth = 1048576\nheight = "
                    "1048576\ncenter = [1, 1]\n"
                    "radius = 1\n",
         {"at most 2^53"}},
        {patterns + "filters = [\"tent:radius=16\"]\n[[scene]]\nkind = \"disk\"\nwidth = 1048576\nheight = 8\n"
                    "center = [1, 1]\nradius = 1\n",
         {"at most 8", "GiB"}},
        {patterns + "[[scene]]\nfile = \"none.toml\"\n", {":3:8", "none.toml"}},
        {patterns + "[[scene]]\nkind = \"disk\"\nwidth = 8\nheight = 8\ncenter = [1, 1]\nradius = { from = 0, to = 1, "
                    "step = 1 }\n",
         {":7:10", "radius"}},
        {patterns + "[[scene]]\nkind = \"disk\"\nwidth = 8\nheight = 8\ncenter = [1, 1]\nradius = { from = 1, to = 2, "
                    "step = 1e-9 }\n",
         {":7:10", "more than 100000 scenes"}},
    };
    for (const auto& study : studies) {
      const std::string& text = study.first;
      CAPTURE(text);
      const std::string file = folder.write("study.toml", text);
      const bool missing_file = text.find("none.toml") != std::string::npos;
      const int code = missing_file ? 3 : 2;
      check_refused({{"run", file, "-o", folder / "out"}, code, study.second});
      check_refused({{"run", file, "--dry-run"}, code, study.second});
      CHECK_FALSE(std::filesystem::exists(folder / "out"));
    }
  }
}
