// moire spectrum: patterns, points and images as a person and as a script meet them.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.h"
#include "reports/images.h"
#include "run_ok.h"

using namespace moire::cli;
using nlohmann::json;

namespace {

json spectrum_of(std::vector<std::string> args) {
  args.insert(args.begin(), "spectrum");
  args.push_back("--json");
  return json::parse(run_ok(args).out);
}

std::string attribute(const moire::ExrImage& image, const std::string& name) {
  for (const auto& [key, value] : image.attributes) {
    if (key != name) continue;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* number = std::get_if<std::int64_t>(&value)) return std::to_string(*number);
  }
  return "(none)";
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a pattern's spectrum as JSON has its sizes and arrays, a number for each ring") {
    const json object = spectrum_of({"jittered", "--n", "64", "--trials", "4", "--seed", "9"});
    CHECK(object["what"] == "jittered");
    CHECK(object["n"] == 64);
    CHECK(object["sets"] == 4);
    CHECK(object["frequencies"] == 64);
    CHECK(object["seed"] == 9);
    for (const char* name :
         {"frequency", "bins", "degrees", "power", "power_lo", "power_hi", "anisotropy_db", "expected"}) {
      CAPTURE(name);
      CHECK(object.at(name).size() == 31);
    }
    CHECK(object["frequency"][0] == 1);
    CHECK(object["bins"][0] == 8);
    CHECK(object["degrees"][0] == 32);
    for (std::size_t k = 0; k < 31; ++k) {
      CHECK(object["power_lo"][k].get<double>() < object["power"][k].get<double>());
      CHECK(object["power"][k].get<double>() < object["power_hi"][k].get<double>());
    }
    CHECK(object["expected"][0].get<double>() < 0.1);
    CHECK(object == spectrum_of({"jittered", "--n", "64", "--trials", "4", "--seed", "9"}));
    CHECK(object != spectrum_of({"jittered", "--n", "64", "--trials", "4", "--seed", "10"}));
  }

  TEST_CASE("random points have 16 sets and an expected power of 1, other patterns have no expectation") {
    const json random = spectrum_of({"random", "--n", "16"});
    CHECK(random["sets"] == 16);
    for (const json& value : random["expected"]) CHECK(value == 1.0);
    CHECK_FALSE(spectrum_of({"n-rooks", "--n", "16"}).contains("expected"));
  }

  TEST_CASE("a pattern that does not vary has one set and no interval") {
    const json object = spectrum_of({"regular", "--n", "64", "--trials", "5"});
    CHECK(object["sets"] == 1);
    // 4 of the 48 bins of ring 8 are on the lattice, with N = 64 each: the integers with 7.5^2 <= m^2 + n^2 < 8.5^2.
    const double bins = object["bins"][7].get<double>();
    CHECK(std::abs(object["power"][7].get<double>() - 4 * 64 / bins) < 1e-10);
    CHECK(object["expected"][7].get<double>() == 4 * 64 / bins);
    CHECK(object["power"][6].get<double>() < 1e-20);
    CHECK(object["anisotropy_db"][6].is_null());  // of nothing
    for (const json& value : object["power_lo"]) CHECK(value.is_null());
    const std::string text = run_ok({"spectrum", "regular", "--n", "64"}).out;
    CHECK(lines_of(text)[0] == "regular, 64 points, 1 set: power at 64 x 64 frequencies");
    CHECK(text.find("e-") == std::string::npos);  // rounding is not shown as power
  }

  TEST_CASE("the table for a person has a line for each ring and explains its columns") {
    const std::vector<std::string> lines =
        lines_of(run_ok({"spectrum", "random", "--n", "4", "--frequencies", "32"}).out);
    REQUIRE(lines.size() == 2 + 15 + 1 + 7);
    CHECK(lines[0] == "random, 4 points, 16 sets: power at 32 x 32 frequencies");
    CHECK(lines[1].starts_with("  frequency  bins"));
    CHECK(lines[2].starts_with("  1 "));
    CHECK(lines[16].starts_with("  15 "));
    CHECK(lines[18].starts_with("  frequency "));
  }

  TEST_CASE("points from a file and from standard input give what the pattern gives itself") {
    const Folder folder;
    std::string text;
    for (const char* trial : {"0", "1", "2"})
      text += "# trial\n" + run_ok({"points", "jittered", "--n", "36", "--trial", trial}).out;
    const std::string path = folder.write("sets.csv", text);
    const json pattern = spectrum_of({"jittered", "--n", "36", "--trials", "3"});
    const json points = spectrum_of({"--points", path});
    CHECK(points["what"] == path);
    CHECK(points["n"] == 36);
    CHECK(points["sets"] == 3);
    for (const char* name : {"frequency", "power", "power_lo", "anisotropy_db"}) CHECK(points[name] == pattern[name]);
    const std::string out = folder / "out.json";
    const std::string command =
        std::string("\"") + MOIRE_PROGRAM + "\" spectrum --points - --json < \"" + path + "\" > \"" + out + "\"";
    REQUIRE(std::system(command.c_str()) == 0);
    json piped = json::parse(read_file(out));
    CHECK(piped["what"] == "standard input");
    piped["what"] = path;
    CHECK(piped == points);
  }

  TEST_CASE("sets of different sizes are averaged, without a size of their own") {
    const Folder folder;
    const json object =
        spectrum_of({"--points", folder.write("sets.txt", "0.1 0.2\n#\n0.3 0.4\n0.5 0.6\n"), "--frequencies", "8"});
    CHECK(object["n"].is_null());
    CHECK(object["sets"] == 2);
    CHECK(object["frequency"] == json({1, 2, 3}));
  }

  TEST_CASE("the folder gets the plane as EXR and PNG, zero frequency in the middle, and the rings as CSV") {
    const Folder folder;
    const std::string out = folder / "deep/out";
    const json object = spectrum_of({"jittered", "--n", "25", "--trials", "2", "-o", out});
    const moire::ExrImage plane = moire::read_exr(out + "/spectrum.exr");
    REQUIRE(plane.grid.width == 64);
    REQUIRE(plane.grid.height == 64);
    CHECK(plane.y[32 * 64 + 32] == 25);
    CHECK(plane.y[31 * 64 + 30] == plane.y[33 * 64 + 34]);
    CHECK(attribute(plane, "moire:kind") == "spectrum");
    CHECK(attribute(plane, "moire:pattern") == "jittered");
    CHECK(attribute(plane, "moire:sets") == "2");
    const moire::Raster picture = moire::read_png(out + "/spectrum.png");
    CHECK(picture.grid.width == 64);
    CHECK(picture.pixels[32 * 64 + 32] == 0);
    const std::vector<std::string> rows = lines_of(read_file(out + "/radial.csv"));
    REQUIRE(rows.size() == 32);
    CHECK(rows[0] == "frequency,bins,degrees,power,power_lo,power_hi,anisotropy_db,expected");
    CHECK(rows[1].starts_with("1,8,16,"));
    const std::string bytes = read_file(out + "/spectrum.exr");
    spectrum_of({"jittered", "--n", "25", "--trials", "2", "-o", out});
    CHECK(read_file(out + "/spectrum.exr") == bytes);
  }

  TEST_CASE("an image's error is the image, or the image less its reference") {
    const Folder folder;
    // cos(2 pi 3 x / 16) / 4 + 1/8 over 16 x 8 pixels: A^2/4 x pixels = 2 in each of two bins of ring 3.
    const moire::Grid grid{16, 8};
    std::vector<float> error, got, exact;
    for (int i = 0; i < 16 * 8; ++i) {
      const double e = 0.25 * std::cos(2 * 3.14159265358979323846 * 3 * (i % 16) / 16) + 0.125;
      error.push_back(static_cast<float>(e));
      exact.push_back(0.5F);
      got.push_back(static_cast<float>(e + 0.5));
    }
    moire::write_exr(folder / "error.exr", grid, error, {});
    moire::write_exr(folder / "got.exr", grid, got, {});
    moire::write_exr(folder / "exact.exr", grid, exact, {});
    const json alone = spectrum_of({folder / "error.exr", "-o", folder / "out"});
    const json less = spectrum_of({folder / "got.exr", "--reference", folder / "exact.exr"});
    CHECK(alone["width"] == 16);
    CHECK(alone["window"] == "none");
    CHECK(alone["reference"].is_null());
    for (const json* object : {&alone, &less}) {
      // Single precision of the files: 2^-25 at most in each pixel of `got`.
      CHECK(std::abs((*object)["bias"].get<double>() - 0.125) < 1e-7);
      CHECK(std::abs((*object)["rmse"].get<double>() - std::sqrt(1.0 / 32 + 1.0 / 64)) < 1e-7);
      const double bins = (*object)["bins"][2].get<double>();
      CHECK(std::abs((*object)["frequency"][2].get<double>() - 3.0 / 16) < 1e-15);
      CHECK(std::abs((*object)["power"][2].get<double>() * bins - 4) < 1e-5);
      CHECK((*object)["power"][3].get<double>() < 1e-10);
    }
    const moire::ExrImage plane = moire::read_exr(folder / "out/spectrum.exr");
    CHECK(std::abs(plane.y[4 * 16 + 8 + 3] - 2) < 1e-5F);
    CHECK(std::abs(plane.y[4 * 16 + 8] - 128.0F / 64) < 1e-5F);  // the mean error, squared, times pixels
    CHECK(lines_of(run_ok({"spectrum", folder / "error.exr"}).out)[0].find("16 x 8 pixels: RMS 0.2165") !=
          std::string::npos);
  }

  TEST_CASE("an image's window and the display's pixels per degree can be chosen, and are told") {
    const Folder folder;
    // A constant error of 1/4: at zero frequency alone, with either window.
    moire::write_exr(folder / "flat.exr", {16, 16}, std::vector<float>(256, 0.25F), {});
    for (const std::string window : {"none", "hann"}) {
      const json flat = spectrum_of({folder / "flat.exr", "--window", window, "--pixels-per-degree", "24.5"});
      CHECK(flat["window"] == window);
      CHECK(flat["pixels_per_degree"] == 24.5);
      CHECK(flat["rmse"] == 0.25);
      // The sensitivity at zero, 0.04992 / 0.98087787655726166; a few roundings.
      CHECK(std::abs(flat["csf_rms"].get<double>() / (0.25 * 0.04992 / 0.98087787655726166) - 1) < 1e-14);
      CHECK(flat["power"][0].is_null() == (window == "hann"));  // the ring has the bins of the mean error alone
      // 1e-13 of the amplitude at most (dft.h), squared.
      for (std::size_t k = 1; k < flat["power"].size(); ++k) CHECK(flat["power"][k].get<double>() <= 1e-26 * 16);
    }
    // A tone at 3/16 cycle per pixel is seen best at 8 cycles per degree: 42 pixels per degree.
    std::vector<float> tone;
    for (int i = 0; i < 256; ++i)
      tone.push_back(static_cast<float>(std::cos(2 * 3.14159265358979323846 * 3 * (i % 16) / 16)));
    moire::write_exr(folder / "tone.exr", {16, 16}, tone, {});
    const auto seen = [&](const char* per_degree) {
      return spectrum_of({folder / "tone.exr", "--pixels-per-degree", per_degree})["csf_rms"].get<double>();
    };
    CHECK(seen("42") > seen("32"));
    CHECK(seen("42") > seen("60"));
    CHECK(spectrum_of({folder / "tone.exr"})["pixels_per_degree"] == 32);
    CHECK(seen("32") == spectrum_of({folder / "tone.exr"})["csf_rms"].get<double>());
    CHECK(run_ok({"spectrum", folder / "tone.exr", "--window", "hann"}).out.find("16 x 16 pixels, window hann: RMS") !=
          std::string::npos);
  }

  TEST_CASE("names of images in capitals are names of images") {
    const Folder folder;
    moire::write_png(folder / "grey.png", {{4, 4}, 1, std::vector<std::uint8_t>(16, 188), {}});
    moire::write_exr(folder / "flat.exr", {4, 4}, std::vector<float>(16, 0.25F), {});
    std::filesystem::rename(folder / "grey.png", folder / "GREY.PNG");
    std::filesystem::rename(folder / "flat.exr", folder / "flat.Exr");
    CHECK(spectrum_of({folder / "GREY.PNG"})["width"] == 4);
    CHECK(spectrum_of({folder / "flat.Exr"})["rmse"] == 0.25);
  }

  TEST_CASE("a single point has the same power at all frequencies, and no anisotropy") {
    const Folder folder;
    const json object = spectrum_of({"--points", folder.write("one.txt", "0.3 0.7\n"), "--frequencies", "16"});
    for (const json& value : object["power"]) CHECK(std::abs(value.get<double>() - 1) < 4e-14);  // point_spectrum.h
    // It was -323 dB: the scatter of rounding.
    for (const json& value : object["anisotropy_db"]) CHECK(value.is_null());
  }

  TEST_CASE("a PNG is decoded to linear coverage") {
    const Folder folder;
    moire::Raster grey{{4, 4}, 1, std::vector<std::uint8_t>(16, 188), {}};  // 188 is about 1/2 of linear light
    moire::write_png(folder / "grey.png", grey);
    moire::Raster rgb{{4, 4}, 3, std::vector<std::uint8_t>(48, 188), {}};
    moire::write_png(folder / "rgb.png", rgb);
    const double want = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
    CHECK(std::abs(spectrum_of({folder / "grey.png"})["bias"].get<double>() - want) < 1e-14);
    CHECK(std::abs(spectrum_of({folder / "rgb.png", "--reference", folder / "grey.png"})["rmse"].get<double>()) <
          1e-14);
  }

  TEST_CASE("what moire spectrum cannot do is refused on one line, with the place and the choices") {
    const Folder folder;
    const auto refused = [](const std::vector<std::string>& args, const std::string& part, int code = 2) {
      CAPTURE(part);
      std::vector<std::string> all = {"spectrum"};
      all.insert(all.end(), args.begin(), args.end());
      const Outcome outcome = run_program(all);
      CHECK(outcome.code == code);
      CHECK(outcome.out.empty());
      CHECK(lines_of(outcome.err).size() == 1);
      CHECK(outcome.err.starts_with("error: "));
      CAPTURE(outcome.err);
      CHECK(outcome.err.find(part) != std::string::npos);
    };
    refused({}, "one of a pattern, an image and --points");
    refused({"jittered", "--points", "-"}, "one of a pattern");
    refused({"jitered", "--n", "16"}, "did you mean jittered");
    refused({"jittered"}, "--n is missing");
    refused({"jitered"}, "did you mean jittered");
    refused({"jittered:amont=1"}, "amount");
    refused({"jittered", "--n", "16", "--window", "hann"}, "--window: does not go with a pattern");
    refused({"--points", "-", "--pixels-per-degree", "32"}, "--pixels-per-degree: does not go with --points");
    refused({"none.exr", "--window", "hamming"}, "choose from none, hann");
    refused({"none.exr", "--pixels-per-degree", "0.5"}, "give a number, 1 to 1000");
    refused({"none.exr", "--pixels-per-degree", "nan"}, "give a number, 1 to 1000");
    refused({"dart-throwing", "--n", "10000000", "--frequencies", "64"}, "2 such sets are possible");
    refused({"jittered", "--n", "15"}, "nearest: 9, 16");
    refused({"jittered", "--n", "16", "--frequencies", "7"}, "even");
    refused({"jittered", "--n", "16", "--frequencies", "5000"}, "4 to 4096");
    refused({"jittered", "--n", "16", "--trials", "0"}, "--trials");
    refused({"jittered", "--n", "16", "--reference", "a.exr"}, "--reference: does not go with a pattern");
    refused({"random", "--n", "16777216", "--frequencies", "1024"}, "at most 1048576 points");
    refused({"random", "--n", "1", "--trials", "1000000", "--frequencies", "4096"}, "at most 65536 points");
    refused({"--points", "-", "--n", "4"}, "--n: does not go with --points");
    refused({"--points", "-"}, "standard input: has no points");
    refused({"--points", folder / "none.txt"}, "none.txt", 3);
    refused({"--points", folder.write("bad.txt", "0.5 0.5\n0.5 1\n")}, "bad.txt:2:5: ");
    refused({"none.exr"}, "none.exr", 3);
    refused({"none.png", "--n", "4"}, "--n: does not go with an image");
    moire::write_exr(folder / "a.exr", {4, 3}, std::vector<float>(12, 0.0F), {});
    moire::write_exr(folder / "b.exr", {3, 4}, std::vector<float>(12, 0.0F), {});
    std::vector<float> nan(12, 0.0F);
    nan[5] = std::nanf("");
    moire::write_exr(folder / "nan.exr", {4, 3}, nan, {});
    refused({folder / "a.exr", "--reference", folder / "b.exr"}, "3 x 4 pixels");
    refused({folder / "nan.exr"}, "pixel (1, 1) is not finite");
    refused({"random", "--n", "4", "-o", folder.write("file", "") + "/x"}, "file", 3);
  }
}
