// Input that was made to hurt: each is refused soon, in little memory and with its limit. Beside each stands what the
// program did before there was a limit.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstdint>

#include "program.h"

using namespace moire::cli;

namespace {

const std::string kScene = "[[scene]]\n" + kEdge;
const std::string kHead = "patterns = [\"random\"]\nspp = [1]\nimages = \"none\"\n";

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

// "0,1,...,": numbers below `end`, each with something before it.
std::string counted(const std::string& before, int end, const std::string& after = ",") {
  std::string text;
  for (int i = 0; i < end; ++i) text += before + std::to_string(i) + after;
  return text;
}

// One line, soon and without much memory. Sanitizers take addresses as they like, and time.
void check_refused(const std::vector<std::string>& words, int code, const std::string& says) {
  CAPTURE(words[1]);
  const Outcome outcome = run_program(words, "", 100, {}, [] {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    const rlimit most{rlim_t{4} << 30, rlim_t{4} << 30};
    ::setrlimit(RLIMIT_AS, &most);
#endif
  });
  CAPTURE(outcome.err.substr(0, 1000));
  CHECK_FALSE(outcome.late);
  CHECK(outcome.code == code);
  CHECK(outcome.out.empty());
  const std::vector<std::string> lines = lines_of(outcome.err);
  REQUIRE_FALSE(lines.empty());
  CHECK(lines.back().starts_with("error: "));
  CHECK(lines.back().find(says) != std::string::npos);
}

void check_study_refused(const std::string& text, int code, const std::string& says) {
  const Folder folder;
  check_refused({"run", folder.write("s.toml", text), "-o", folder / "out"}, code, says);
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

std::string png_chunk(const std::string& kind_and_data) {
  std::uint32_t crc = 0xffffffff;  // PNG, annex D
  for (const char c : kind_and_data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xedb88320U & (0U - (crc & 1U)));
  }
  const auto big_endian = [](std::uint32_t n) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(n >> shift);
    return bytes;
  };
  return big_endian(static_cast<std::uint32_t>(kind_and_data.size()) - 4) + kind_and_data + big_endian(~crc);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("tables within tables are refused however they are written and whatever strings stand before them") {
    const std::string deep = repeated("b.", 200000) + "b = 1";
    // The first ended before there was a limit to dots; the others got around it: SIGSEGV, the stack was used up.
    check_study_refused("x." + deep + "\n", 2, "dotted parts");
    check_study_refused("x = { a = \"\\\"\", " + deep + " }\n", 2, "dotted parts");
    check_study_refused("x = { a = \"\"\"\n\"\"\", " + deep + " }\n", 2, "dotted parts");
    check_study_refused("x = { a = '''\n'''''', " + deep + " }\n", 2, "");  // no TOML, which may be said first
    check_study_refused("x = " + repeated("{ " + repeated("a.", 60) + "a = ", 250) + "1" + repeated(" }", 250) + "\n",
                        2, "nested more than 16 deep");
    check_study_refused("x = " + repeated("[", 100000) + "\n", 2, "nested more than 16 deep");
    // What only looks deep.
    check_study_refused("# " + deep + repeated("[", 100) + "\nx = 1\n", 2, "\"x\" is not known");
    check_study_refused("name = '''" + deep + "\n" + repeated("[", 100) + "'''\nx = 1\n", 2, "\"x\" is not known");
  }

  TEST_CASE("lists without end are refused: work on them grows with the square of their length") {
    // The first two took many seconds, and a hundred times as many when ten times as long.
    check_study_refused("patterns = [\"random\"]\nspp = [" + counted("", 100000) + "]\n" + kScene, 2,
                        "spp has 100000 entries; give at most 4096");
    check_study_refused("patterns = [\"jittered:" + counted("a", 100000, "=1,") + "b=1\"]\n" + kScene, 2,
                        "more than 64 parameters");
    check_study_refused("patterns = [" + counted("\"p", 100000, "\",") + "]\n" + kScene, 2,
                        "patterns has 100000 entries; give at most 4096");
  }

  TEST_CASE("ranges beside long lists are refused: each scene holds the whole list") {
    // 50,000 scenes of 20,000 disks: memory without end.
    check_study_refused(kHead +
                            "[[scene]]\nkind = \"disks\"\nwidth = { from = 8, to = 50000, step = 1 }\nheight = 8\n" +
                            "disks = [" + counted("[", 20000, ".5, 4, 1],") + "]\n",
                        2, "at most 8388608 together");
  }

  TEST_CASE("files that a study names are regular files, and no file is read without end") {
    const Folder folder;
    // The first read 256 MiB for each scene, the second waited for ever.
    check_refused({"run", folder.write("a.toml", kHead + "[[scene]]\nfile = \"/dev/zero\"\n"), "-o", folder / "out"}, 3,
                  "no regular file");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    check_refused({"run", folder.write("b.toml", kHead + "[[scene]]\nfile = \"pipe\"\n"), "-o", folder / "out"}, 3,
                  "no regular file");
    check_refused(
        {"run", folder.write("k.toml", kHead + "filters = [\"tabulated:path=pipe\"]\n" + kScene), "-o", folder / "out"},
        3, "no regular file");
    check_refused({"run", folder.write("d.toml", std::string(9 << 20, '#')), "-o", folder / "out"}, 3,
                  "it is above 8 MiB");
    check_refused({"exact", "/dev/zero", "-o", folder / "x.exr"}, 3, "it is above 8 MiB");
  }

  TEST_CASE("an image that only claims to be large is refused by its size") {
    // 60 bytes: 105 s and 10.7 GB, until the end of the file was noticed. The file has all its chunks.
    const std::string claim("\0\0\xea\x60\0\0\xea\x60\x08\x02\0\0\0", 13);
    const Folder folder;
    const std::string file = folder.write(
        "huge.png", "\x89PNG\r\n\x1a\n" + png_chunk("IHDR" + claim) +
                        png_chunk("IDAT" + std::string("\x78\x9c\x63\0\0\0\x02\0\x01", 9)) + png_chunk("IEND"));
    check_refused({"spectrum", file}, 3, "has 60000 x 60000 pixels; at most 67108864 can be read");
    // A text of 2 GiB in a file of 40 bytes: 1.9 GB were taken before its end was noticed.
    const std::string attribute(
        "\x76\x2f\x31\x01\x02\0\0\0comments\0string\0\xf0\xff\xff\x6f"
        "abc",
        31);
    check_refused({"spectrum", folder.write("huge.exr", attribute)}, 3, "its header is damaged");
    // 24 million pixels in three rows, in 290 bytes: a buffer for 256 rows took 8.3 GB.
    check_refused({"spectrum", std::string(MOIRE_SEEDS) + "/image/wide.exr"}, 3,
                  "has 8126468 x 3 pixels; at most 67108864 can be read, 1048576 a side");
    // Read as whatever its bytes said, by one of some thirty readers.
    check_refused({"spectrum", folder.write("other.png", "GIF89a\x01\0\x01\0\0\0\0;")}, 3, "cannot be read");
  }

  TEST_CASE("names of pictures that no file system takes are refused before the work") {
    // Ended with code 3 in the middle of the run.
    check_study_refused("patterns = [\"dart-throwing:bank=" + std::string(300, '0') +
                            "4\"]\nn = [4]\ntrials = 2\nmeasures = [\"star-l2\"]\n",
                        2, "a file name above 240 bytes");
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("a study has no more than 64 MiB with the files that it names") {
    const Folder folder;
    // One file named a thousand times was held a thousand times. Its length is that of a string, which parses fast.
    folder.write("big.toml", kEdge + "name = '" + std::string(7 << 20, 'n') + "'\n");
    std::string scenes;
    for (int i = 0; i < 1000; ++i) scenes += "[[scene]]\nfile = \"big.toml\"\nname = \"n" + std::to_string(i) + "\"\n";
    check_refused({"run", folder.write("c.toml", kHead + scenes), "-o", folder / "out"}, 2, "more than 64 MiB");
  }

  TEST_CASE("a board whose squares are below all pixels is refused by the number of active pixels") {
    // A million by a million active pixels: hours, then memory.
    const Folder folder;
    const std::string board = folder.write("s.toml",
                                           "kind = \"checkerboard\"\nwidth = 1048576\nheight = 1048576\n"
                                           "homography = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n");
    check_refused({"render", board, "--pattern", "regular", "--spp", "1"}, 2, "more than 134217728 pixels' windows");
  }
}
