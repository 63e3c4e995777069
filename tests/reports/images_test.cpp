// Image files through the module moire_io: what is written is what is read, and the same bytes every time.
#include "reports/images.h"

#include <doctest/doctest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <thread>

#include "core/error.h"
#include "folder.h"

namespace moire {
namespace {

std::vector<float> hard_pixels(std::size_t count) {
  using Limits = std::numeric_limits<float>;
  std::vector<float> y{0.0f,
                       -0.0f,
                       1.0f,
                       -1.0f,
                       1e-30f,
                       Limits::denorm_min(),
                       -Limits::denorm_min(),
                       Limits::min(),
                       Limits::max(),
                       Limits::lowest(),
                       Limits::infinity(),
                       -Limits::infinity(),
                       Limits::quiet_NaN(),
                       0x1.fffffep-1f};
  std::mt19937 random(1);
  while (y.size() < count) y.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0xbfffffffu));
  y.resize(count);
  return y;
}

const std::vector<Attribute> kAttributes{{"moire:schema", "moire.exr/1"},
                                         {"moire:scene", "kind = \"edge\"\nnormal = [0.1, -3]"},
                                         {"moire:spp", std::int64_t{256}},
                                         {"moire:low", std::int64_t{-2147483648}},
                                         {"moire:bound", 1.0 / 3},
                                         {"moire:empty", ""},
                                         {"moire:seed", std::int64_t{1} << 40}};

const Attribute* find(const ExrImage& image, const std::string& name) {
  for (const Attribute& a : image.attributes) {
    if (a.first == name) return &a;
  }
  return nullptr;
}

std::string text_of(const Raster& raster, const std::string& keyword) {
  for (const auto& [key, text] : raster.text) {
    if (key == keyword) return text;
  }
  return "(none)";
}

TEST_SUITE("io") {
  TEST_CASE("EXR keeps every bit of every pixel, special values too") {
    const Folder folder;
    for (const Grid grid : {Grid{1, 1}, Grid{14, 1}, Grid{1, 40}, Grid{67, 53}, Grid{1 << 20, 2}}) {
      const auto y = hard_pixels(static_cast<std::size_t>(grid.width * grid.height));
      write_exr(folder.file("a.exr"), grid, y, kAttributes);
      const ExrImage back = read_exr(folder.file("a.exr"));
      CHECK(back.grid == grid);
      REQUIRE(back.y.size() == y.size());
      int different = 0;
      for (std::size_t i = 0; i < y.size(); ++i) {
        different += std::bit_cast<std::uint32_t>(y[i]) != std::bit_cast<std::uint32_t>(back.y[i]);
      }
      CHECK(different == 0);
    }
    CHECK(folder.entries() == 1);
  }

  TEST_CASE("EXR attributes read back with type and value, but long integers as text and empty texts not at all") {
    const Folder folder;
    write_exr(folder.file("a.exr"), {2, 1}, hard_pixels(2), kAttributes);
    const ExrImage back = read_exr(folder.file("a.exr"));
    for (const Attribute& a : kAttributes) {
      CAPTURE(a.first);
      const Attribute* found = find(back, a.first);
      if (a.first == "moire:empty") {
        CHECK(found == nullptr);
        continue;
      }
      REQUIRE(found != nullptr);
      if (a.first == "moire:seed") {
        CHECK(std::get<std::string>(found->second) == "1099511627776");
      } else {
        CHECK(found->second == a.second);
      }
    }
    const Attribute* software = find(back, "Software");
    REQUIRE(software != nullptr);
    CHECK(std::get<std::string>(software->second).rfind("moire ", 0) == 0);
    CHECK(back.attributes.size() == kAttributes.size());  // Software in, the empty one out
  }

  TEST_CASE("the same image gives the same bytes at another time, with no date in them") {
    const Folder folder;
    const auto y = hard_pixels(64 * 64);
    Raster raster{{64, 64}, 1, std::vector<std::uint8_t>(64 * 64, 7), {{"moire:kind", "reconstruction"}}};
    write_exr(folder.file("a.exr"), {64, 64}, y, kAttributes);
    write_png(folder.file("a.png"), raster);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // time stamps count seconds
    write_exr(folder.file("b.exr"), {64, 64}, y, kAttributes);
    write_png(folder.file("b.png"), raster);
    const std::string exr = bytes_of(folder.file("a.exr")), png = bytes_of(folder.file("a.png"));
    CHECK(!exr.empty());
    CHECK(exr == bytes_of(folder.file("b.exr")));
    CHECK(png == bytes_of(folder.file("b.png")));
    for (const std::string trace : {"capDate", "DateTime", "hostComputer", "OpenImageIO", "/tmp"}) {
      CAPTURE(trace);
      CHECK(exr.find(trace) == std::string::npos);
      CHECK(png.find(trace) == std::string::npos);
    }
    CHECK(png.find("tIME") == std::string::npos);
  }

  TEST_CASE("PNG keeps every pixel and its text, grey and in colour") {
    const Folder folder;
    for (const int channels : {1, 3}) {
      Raster raster{{13, 7}, channels, {}, {{"moire:range", "0.0123"}, {"moire:kind", "error"}}};
      for (int i = 0; i < 13 * 7 * channels; ++i) raster.pixels.push_back(static_cast<std::uint8_t>(37 * i));
      write_png(folder.file("a.png"), raster);
      const Raster back = read_png(folder.file("a.png"));
      CHECK(back.grid == raster.grid);
      CHECK(back.channels == channels);
      CHECK(back.pixels == raster.pixels);
      CHECK(text_of(back, "moire:range") == "0.0123");
      CHECK(text_of(back, "moire:kind") == "error");
      CHECK(text_of(back, "Software").rfind("moire ", 0) == 0);
    }
  }

  TEST_CASE("images from several threads at once come out whole") {
    const Folder folder;
    const auto y = hard_pixels(64 * 64);
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i) {
      threads.emplace_back([&, i] { write_exr(folder.file(std::to_string(i) + ".exr"), {64, 64}, y, kAttributes); });
    }
    for (auto& thread : threads) thread.join();
    for (int i = 1; i < 8; ++i)
      CHECK(bytes_of(folder.file(std::to_string(i) + ".exr")) == bytes_of(folder.file("0.exr")));
  }

  TEST_CASE("image files that cannot be written or read give an error with exit code 3 and the path, on one line") {
    const Folder folder;
    std::ofstream(folder.file("not.exr")) << "no image";
    const Raster dot{{1, 1}, 1, {0}, {}};
    const std::pair<std::string, std::function<void(const std::string&)>> cases[] = {
        {folder.file("missing/a.exr"),
         [](const std::string& p) {
           write_exr(p, {1, 1}, hard_pixels(1), {});
         }},
        {folder.file("missing/a.png"), [&](const std::string& p) { write_png(p, dot); }},
        {folder.file("not.exr"), [](const std::string& p) { read_exr(p); }},
        {folder.file("absent.exr"), [](const std::string& p) { read_exr(p); }},
    };
    for (const auto& path_and_action : cases) {
      const std::string& path = path_and_action.first;
      CAPTURE(path);
      bool thrown = false;
      try {
        path_and_action.second(path);
      } catch (const Error& error) {
        thrown = true;
        const std::string message = error.what();
        CAPTURE(message);
        CHECK(error.code() == Exit::io);
        CHECK(message.rfind(path + ": cannot be ", 0) == 0);
        CHECK(message.find('\n') == std::string::npos);
        CHECK(message.find(".part") == std::string::npos);
        CHECK(message.back() != ' ');
      }
      CHECK(thrown);
    }
    CHECK(folder.entries() == 1);
  }

  TEST_CASE("a full disk is an error, and leaves no part of an image") {
    const Folder folder;
    const std::vector<float> y = hard_pixels(200 * 200);
    Raster raster{{200, 200}, 1, {}, {}};
    for (const float v : y) raster.pixels.push_back(static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(v) >> 9));
    {
      const SmallFiles small(4096);
      CHECK_THROWS_AS(write_exr(folder.file("a.exr"), {200, 200}, y, {}), Error);
      CHECK_THROWS_AS(write_png(folder.file("a.png"), raster), Error);
    }
    CHECK(folder.entries() == 0);
    write_exr(folder.file("a.exr"), {200, 200}, y, {});
    write_png(folder.file("a.png"), raster);
    CHECK(folder.entries() == 2);
  }

  // Run by the next case from a copy of this program in a folder of its own.
  TEST_CASE("without its module, writing an image names the missing file" * doctest::skip()) {
    try {
      write_png("never.png", {{1, 1}, 1, {0}, {}});
      FAIL("nothing was thrown");
    } catch (const Error& error) {
      const auto here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
      CHECK(error.code() == Exit::io);
      CHECK(std::string(error.what()).rfind((here / "moire_io.so").string() + ": ", 0) == 0);
    }
  }

  TEST_CASE("a program without moire_io beside it fails with the module's path") {
    const Folder folder;
    std::filesystem::copy_file(std::filesystem::read_symlink("/proc/self/exe"), folder.file("alone"));
    const std::string command = folder.file("alone") + " -ns -tc='without its module*' > /dev/null";
    CHECK(std::system(command.c_str()) == 0);
  }
}

}  // namespace
}  // namespace moire
