// Results on disk: JSON Lines and CSV read back as they were, files appear whole, failures name path and reason.
#include <doctest/doctest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "core/error.h"
#include "folder.h"
#include "reports/csv.h"
#include "reports/file.h"
#include "reports/json.h"
#include "reports/provenance.h"

namespace moire {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

const std::string kHardTexts[] = {"plain",       "",          "mitchell:b=0.33,c=0.33",
                                  "say \"x\"",   "line\nend", "a\r\nb",
                                  "back\\slash", "tab\there", " spaces ",
                                  "|pipe|",      "\xc3\xa9",  std::string("nul\0in", 6)};

const double kHardNumbers[] = {0.0,
                               -0.0,
                               1.0,
                               -3.0,
                               0.1,
                               1e22,
                               1e-5,
                               5e-324,
                               std::numeric_limits<double>::max(),
                               std::numeric_limits<double>::min(),
                               0x1.fffffffffffffp-1,
                               1.0 / 3};

Row hard_row() {
  Row row;
  int i = 0;
  for (const std::string& text : kHardTexts) row.set("text" + std::to_string(i++), text);
  for (const double number : kHardNumbers) row.set("number" + std::to_string(i++), number);
  std::mt19937_64 random(1);
  for (int k = 0; k < 1000; ++k) {
    const double number = std::bit_cast<double>(random());
    if (std::isfinite(number)) row.set("random" + std::to_string(k), number);
  }
  row.set("smallest", std::numeric_limits<std::int64_t>::min());
  row.set("largest", std::numeric_limits<std::int64_t>::max());
  row.set("yes", true);
  row.set("no", false);
  row.set("missing", {});
  row.set("odd, \"name\"", 1.5);
  return row;
}

// Equal in name, order, type and every bit.
bool same(const Row& a, const Row& b) {
  if (a.cells().size() != b.cells().size()) return false;
  for (std::size_t i = 0; i < a.cells().size(); ++i) {
    const auto& [name_a, cell_a] = a.cells()[i];
    const auto& [name_b, cell_b] = b.cells()[i];
    if (name_a != name_b || cell_a.index() != cell_b.index()) return false;
    if (const auto* x = std::get_if<double>(&cell_a)) {
      if (std::bit_cast<std::uint64_t>(*x) != std::bit_cast<std::uint64_t>(std::get<double>(cell_b))) return false;
    } else if (cell_a != cell_b) {
      return false;
    }
  }
  return true;
}

struct Field {
  std::string text;
  bool quoted = false;
};

// A reader of RFC 4180 of its own: records of fields, whether they were quoted.
std::vector<std::vector<Field>> read_csv(const std::string& text) {
  std::vector<std::vector<Field>> records(1);
  Field field;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      field.quoted = true;
      for (++i; i < text.size(); ++i) {
        if (text[i] != '"') {
          field.text += text[i];
        } else if (i + 1 < text.size() && text[i + 1] == '"') {
          field.text += text[i++];
        } else {
          break;
        }
      }
    } else if (text[i] == ',' || text[i] == '\n') {
      records.back().push_back(field);
      field = {};
      if (text[i] == '\n') records.emplace_back();
    } else {
      field.text += text[i];
    }
  }
  records.pop_back();
  return records;
}

Exit exit_of(const std::function<void()>& action, std::string& message) {
  try {
    action();
  } catch (const Error& error) {
    message = error.what();
    return error.code();
  }
  return Exit::ok;
}

TEST_SUITE("unit") {
  TEST_CASE("a row reads back from its line of JSON with every name, type and bit") {
    const Row row = hard_row();
    const std::string line = json_row(row);
    CHECK(line.find('\n') == std::string::npos);
    CHECK(line.rfind("{\"kind\":\"row\",\"text0\":\"plain\",", 0) == 0);
    CHECK(same(parse_json_row(line, "test"), row));
    CHECK(same(parse_json_row(json_row(row, ""), "test"), row));
    CHECK(json_row({}, "") == "{}");
  }

  TEST_CASE("numbers that JSON does not have are null, and text that is not UTF-8 does no harm") {
    Row row;
    row.set("nan", std::nan(""));
    row.set("inf", -kInf);
    row.set("bad", std::string("a\xff z"));
    CHECK(json_row(row, "") == "{\"nan\":null,\"inf\":null,\"bad\":\"a\xef\xbf\xbd z\"}");
  }

  TEST_CASE("lines that are no row of results are refused at their place") {
    for (const char* line : {"", "[1]", "{\"a\":[1]}", "{\"a\":{}}", "{\"a\":1", "{\"a\":18446744073709551615}"}) {
      CAPTURE(line);
      std::string message;
      CHECK(exit_of([&] { parse_json_row(line, "results.jsonl:7"); }, message) == Exit::usage);
      CHECK(message.rfind("results.jsonl:7: ", 0) == 0);
    }
  }

  TEST_CASE("CSV reads back by RFC 4180, with missing values, empty texts and numbers told apart") {
    Table table{hard_row(), {}, {}};
    table[1].set("new", std::string("x"));
    table[1].set("text1", std::string("y"));
    table[2].set("new", std::nan(""));
    const auto records = read_csv(csv(table));
    REQUIRE(records.size() == 4);
    for (const auto& record : records) REQUIRE(record.size() == table[0].cells().size() + 1);
    CHECK(records[0].back().text == "new");
    CHECK(records[2].back().text == "x");
    CHECK(records[3].back().text.empty());
    CHECK(records[2][1].text == "y");
    CHECK(records[2][0].text.empty());
    for (std::size_t i = 0; i < table[0].cells().size(); ++i) {
      const std::string& name = table[0].cells()[i].first;
      const Cell& cell = table[0].cells()[i].second;
      const Field& field = records[1][i];
      CAPTURE(name);
      CHECK(records[0][i].text == name);
      if (const auto* text = std::get_if<std::string>(&cell)) {
        CHECK(field.text == *text);
        if (text->empty()) CHECK(field.quoted);
      } else if (const auto* number = std::get_if<double>(&cell)) {
        const double back = std::strtod(field.text.c_str(), nullptr);
        CHECK(std::bit_cast<std::uint64_t>(back) == std::bit_cast<std::uint64_t>(*number));
      } else if (const auto* integer = std::get_if<std::int64_t>(&cell)) {
        CHECK(field.text == std::to_string(*integer));
      } else if (const auto* truth = std::get_if<bool>(&cell)) {
        CHECK(field.text == (*truth ? "true" : "false"));
      } else {
        CHECK(field.text.empty());
        CHECK_FALSE(field.quoted);
      }
    }
    CHECK(csv({}).empty());
    CHECK(csv(table).find('\r') == csv(table).find("\r\nb"));  // only the one inside a text
  }

  TEST_CASE("the header says what defines the results and parses as JSON") {
    const std::string text = "name = \"s\"\n# \xc3\xa9\n";
    const auto header = nlohmann::json::parse(json_header(tool(), host(), {"s", text}));
    CHECK(header["kind"] == "header");
    CHECK(header["schema"] == "moire.results/1");
    CHECK(header["study"]["text"] == text);
    CHECK(header["study"]["sha256"] == sha256(text));
    CHECK(header["tool"]["fp_contract"] == "off");
    CHECK(header["tool"]["flags"].get<std::string>().find("-ffp-contract=off") != std::string::npos);
    CHECK(header["host"]["cores"] >= 1);
    CHECK(header.size() == 5);
    CHECK(json_header(tool(), host(), {"s", text}) == json_header(tool(), host(), {"s", text}));
  }

  TEST_CASE("SHA-256 agrees with FIPS 180's examples") {
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  }
}

TEST_SUITE("io") {
  TEST_CASE("results are readable while they grow, and in plan order at the end") {
    const Folder folder;
    Row first, second;
    first.set("trial", std::int64_t{0});
    second.set("trial", std::int64_t{1});
    JsonLines lines(folder.file("results.jsonl"), "{\"kind\":\"header\"}");
    CHECK(bytes_of(folder.file("results.jsonl")) == "{\"kind\":\"header\"}\n");
    lines.append(second);
    CHECK(bytes_of(folder.file("results.jsonl")) == "{\"kind\":\"header\"}\n{\"kind\":\"row\",\"trial\":1}\n");
    lines.append(first);
    lines.finish({first, second});
    CHECK(bytes_of(folder.file("results.jsonl")) ==
          "{\"kind\":\"header\"}\n{\"kind\":\"row\",\"trial\":0}\n{\"kind\":\"row\",\"trial\":1}\n");
    CHECK(folder.entries() == 1);
  }

  TEST_CASE("a results file that was cut anywhere reads back up to its last whole line, and goes on from there") {
    const Folder folder;
    const std::string path = folder.file("results.jsonl");
    const std::string header = json_header(tool(), host(), {"s", "text"});
    Row row;
    row.set("scene", std::string("s"));
    row.set("spp", std::int64_t{4});
    {
      JsonLines results(path, header);
      results.append(row);
      results.append(row);
    }
    const std::string whole = bytes_of(path);
    const std::size_t one = json_row(row).size() + 1, first = header.size() + 1;
    CHECK(read_results(folder.file("none.jsonl")).header.empty());
    for (std::size_t size = 0; size <= whole.size(); ++size) {
      std::ofstream(path, std::ios::binary) << whole.substr(0, size);
      const ResultsFile found = read_results(path);
      const std::size_t rows = size < first ? 0 : (size - first) / one;
      const std::size_t kept = size < first ? 0 : first + rows * one;
      CAPTURE(size);
      CHECK(found.header == (size < first ? "" : header));
      CHECK(found.rows.size() == rows);
      CHECK(found.whole_bytes == kept);
      CHECK(found.cut == whole.substr(kept, size - kept));
      if (found.header.empty()) continue;
      JsonLines results(path, found);
      results.append(row);
      CHECK(bytes_of(path) == whole.substr(0, kept) + json_row(row) + "\n");
    }
  }

  TEST_CASE("two headers belong together unless study, schema or build differ") {
    Tool build = tool();
    const StudyText study{"s", "text"};
    const std::string header = json_header(build, host(), study);
    CHECK(header_difference(header, header).empty());
    Host other = host();
    other.cpu += " II";
    other.cores += 1;
    CHECK(header_difference(json_header(build, other, study), header).empty());
    CHECK(header_difference(json_header(build, host(), {"s", "texts"}), header).rfind("another study (sha256", 0) == 0);
    CHECK(header_difference(json_header(build, host(), {"t", "text"}), header) ==
          "another name of the study (name \"t\", here \"s\")");
    build.compiler = "cc";
    CHECK(header_difference(json_header(build, host(), study), header).rfind("another build (compiler \"cc\"", 0) == 0);
    CHECK(header_difference("{}", header).rfind("another schema", 0) == 0);
  }

  TEST_CASE("a file is replaced whole, and stays as it was when its replacement fails") {
    const Folder folder;
    const std::string path = folder.file("a.txt");
    write_whole(path, "one");
    write_whole(path, "two");
    CHECK(bytes_of(path) == "two");
    const SmallFiles small(1000);
    std::string message;
    CHECK(exit_of([&] { write_whole(path, std::string(100000, 'x')); }, message) == Exit::io);
    CHECK(message == path + ": cannot be written: File too large");
    CHECK(bytes_of(path) == "two");
    CHECK(folder.entries() == 1);
  }

  TEST_CASE("a name as long as file systems take can be written") {
    const Folder folder;
    const std::string path = folder.file(std::string(255, 'n'));
    write_whole(path, "x");
    CHECK(bytes_of(path) == "x");
    CHECK(folder.entries() == 1);
  }

  TEST_CASE("a link to a file stays a link, and devices are written to, not replaced") {
    const Folder folder;
    write_whole(folder.file("real"), "old");
    std::filesystem::create_symlink("real", folder.file("link"));
    write_whole(folder.file("link"), "new");
    CHECK(std::filesystem::is_symlink(folder.file("link")));
    CHECK(bytes_of(folder.file("real")) == "new");
    write_whole("/dev/null", "gone");
    CHECK(std::filesystem::is_character_file("/dev/null"));
  }

  TEST_CASE("paths that cannot be written give an error with exit code 3, the path and the reason") {
    const Folder folder;
    write_whole(folder.file("file"), "x");
    for (const std::string& path : {folder.file("missing/a.txt"), folder.file("file/a.txt"), folder.file(""),
                                    std::string("/dev/full"), std::string("/proc/none")}) {
      CAPTURE(path);
      std::string message;
      CHECK(exit_of([&] { write_whole(path, "bytes"); }, message) == Exit::io);
      CAPTURE(message);
      CHECK(message.rfind(path + ": cannot be written: ", 0) == 0);
      CHECK(message.size() > path.size() + 20);
    }
    std::string message;
    CHECK(exit_of([&] { JsonLines(folder.file("missing/r.jsonl"), "{}"); }, message) == Exit::io);
    CHECK(exit_of([&] { JsonLines("/dev/full", "{}"); }, message) == Exit::io);
    CHECK(message == "/dev/full: cannot be written: No space left on device");
    CHECK(exit_of([&] { make_folder(folder.file("file/sub")); }, message) == Exit::io);
    CHECK(exit_of([&] { make_folder(folder.file("file")); }, message) == Exit::io);
    make_folder(folder.file("a/b/c"));
    make_folder(folder.file("a/b/c"));
    CHECK(std::filesystem::is_directory(folder.file("a/b/c")));
  }
}

}  // namespace
}  // namespace moire
