// moire filters: the table of metrics as a person and as a script get it.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "filters/filter.h"
#include "program.h"
#include "run_ok.h"

using namespace moire::cli;
using nlohmann::json;

TEST_SUITE("cli") {
  TEST_CASE("without names every variant of every filter has a line, as text and as JSON") {
    const std::vector<std::string> texts = moire::filter_variants();
    const json all = json::parse(run_ok({"filters", "--json"}).out);
    REQUIRE(all.is_array());
    REQUIRE(all.size() == texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
      CHECK(all[i].at("filter") == texts[i]);
      for (const char* name : {"radius", "pieces", "degree", "kernel_error", "integral", "ripple", "mean", "variance",
                               "nyquist_response", "l1_gain", "overshoot_percent", "smoothing", "postaliasing",
                               "noise_gain_1d", "noise_gain", "edge_alias_energy", "anisotropy"}) {
        CAPTURE(name);
        CHECK(all[i].at(name).is_number());
      }
      CHECK(all[i].size() == 18);
    }
    const std::vector<std::string> lines = lines_of(run_ok({"filters"}).out);
    REQUIRE(lines.size() > texts.size() + 2);
    for (std::size_t i = 0; i < texts.size(); ++i) CHECK(lines[i + 1].starts_with("  " + texts[i] + " "));
    // Below the table one line for each column but the name.
    CHECK(lines[texts.size() + 1].empty());
    for (std::size_t i = texts.size() + 2; i < lines.size(); ++i) {
      CHECK(lines[0].find(lines[i].substr(2, lines[i].find("  ", 2) - 2)) != std::string::npos);
    }
    CHECK(lines.size() == texts.size() + 2 + 12);
  }

  TEST_CASE("named filters come in the order given, with all digits of their numbers in JSON") {
    const json two = json::parse(run_ok({"filters", "tent", "--json", "box:width=2"}).out);
    REQUIRE(two.size() == 2);
    CHECK(two[0]["filter"] == "tent");
    CHECK(two[1]["filter"] == "box:width=2");
    CHECK(std::abs(two[0]["variance"].get<double>() - 1.0 / 6) < 1e-13);
    CHECK(std::abs(two[1]["noise_gain"].get<double>() - 0.25) < 1e-13);
    CHECK(two[0]["pieces"] == 2);
    CHECK(two[1]["degree"] == 0);
    const std::vector<std::string> lines = lines_of(run_ok({"filters", "tent", "box:width=2"}).out);
    CHECK(lines[1].starts_with("  tent "));
    CHECK(lines[2].starts_with("  box:width=2 "));
    CHECK(run_ok({"filters", "tent", "box:width=2"}).out == run_ok({"filters", "tent", "box:width=2"}).out);
  }

  TEST_CASE("a kernel from a file is measured like the filter that it copies") {
    const Folder folder;
    const std::string path = folder.write("tent.csv", "x,k\n-1,0\n0,7\n1,0\n");
    const json both = json::parse(run_ok({"filters", "tent", "tabulated:path=" + path, "--json"}).out);
    for (const auto& item : both[0].items()) {
      const std::string& name = item.key();
      if (name == "filter" || name == "integral" || name == "kernel_error") continue;
      CAPTURE(name);
      CHECK(std::abs(both[1][name].get<double>() - item.value().get<double>()) < 1e-13);
    }
    CHECK(both[1]["integral"] == 7.0);
  }

  TEST_CASE("what moire filters does not know it answers with the nearest name, on one line and with code 2") {
    const auto refused = [](const std::vector<std::string>& args, const std::string& part) {
      const Outcome outcome = run_program(args);
      CHECK(outcome.code == 2);
      CHECK(outcome.out.empty());
      CHECK(lines_of(outcome.err).size() == 1);
      CHECK(outcome.err.starts_with("error: "));
      CHECK(outcome.err.find(part) != std::string::npos);
    };
    refused({"filters", "mitchel"}, "did you mean mitchell?");
    refused({"filters", "box", "tent:radus=2"}, "radius");
    refused({"filters", "mitchell", "--jsn"}, "--json");
    refused({"filters", ""}, "a name is missing");
    refused({"filters", "tabulated"}, "path");
    CHECK(run_program({"filters", "tabulated:path=/nowhere.csv"}).code == 3);
  }
}
