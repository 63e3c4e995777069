// Results as JSON Lines (jsonlines.org): a header line, then one line per row. Grows while a run goes on.
#pragma once

#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/provenance.h"
#include "study/results.h"

namespace moire {

// {"kind":"header","schema":"moire.results/1",...}: what the same study, seed and build always give; no line end.
// `schema` names what the lines after it are.
inline constexpr std::string_view kResultsSchema = "moire.results/1", kBenchSchema = "moire.bench/1",
                                  kStressSchema = "moire.stress/1";
std::string json_header(const Tool& tool, const Host& host, const StudyText& study,
                        std::string_view schema = kResultsSchema);

// One row as one line of JSON, cells in their order, without a line end. Doubles are the shortest that read back as
// the same bits, with a point or exponent; NaN, infinities and empty cells are null; text that is not UTF-8 has its
// bad bytes replaced. `kind`: "row" puts "kind":"row" first; "" leaves it out.
std::string json_row(const Row& row, std::string_view kind = "row");

// A JSON array of such objects. Throws Error at `place`.
Table parse_json_rows(std::string_view array, const std::string& place);

// A cell, and a text with its quotes, as they stand in such a line.
std::string json_cell(const Cell& cell);
std::string json_text(std::string_view text);

// The text at a JSON pointer (RFC 6901) of a JSON object; "" where there is none, and for what is no object.
std::string text_at(std::string_view object, const char* pointer);

// Throws Error at `place` for what is no header of results: study, tool and host with the texts that a page shows.
void check_header(std::string_view header, const std::string& place);

// Several tables under one header: as lines, told apart by "kind", and as one object, {"header":...,"NAME":[...],...}.
struct JsonTable {
  std::string_view name, kind;
  const Table* rows;
};
std::string json_lines(const std::string& header, std::initializer_list<JsonTable> tables);
std::string json_object(const std::string& header, std::initializer_list<JsonTable> tables);

// The row of such a line, without "kind". Numbers with a point or exponent are doubles, others 64-bit integers.
// Throws Error at `place` for anything but an object of numbers, texts, booleans and nulls.
Row parse_json_row(std::string_view line, const std::string& place);

// A results file as a run that was stopped left it.
struct ResultsFile {
  std::string header;              // its first line, without the line end; "" when that is not whole
  Table rows;                      // row i stands in line i + 2
  std::uintmax_t whole_bytes = 0;  // of header and rows
  std::string cut;                 // a last line that is not whole
};

// Reads a results file; one that is not there is empty. A last line without its end, or that is no JSON object, is
// taken for one that was being written as the program was killed. Throws Error with PATH:LINE for anything else that is
// no header or row, and (Exit::io) for a file that cannot be read.
ResultsFile read_results(const std::string& path);

// A file of a header and rows of several kinds, such as bench.jsonl: the kinds in the order of their first rows.
struct JsonTables {
  std::string header;
  std::vector<std::pair<std::string, Table>> tables;
};

// Throws Error with PATH:LINE for what is no header or row, and (Exit::io) for a file that cannot be read.
JsonTables read_json_tables(const std::string& path);

// In which way the headers of two runs differ, so that their rows do not belong together: "another study (...)",
// "another build (...)", ...; "" when they do belong together. The kind of machine may differ: rows depend on it in
// their times alone.
std::string header_difference(const std::string& found, const std::string& expected);

// The results file of a run that goes on: rows are there as soon as they are appended, in any order; finish() writes
// the file again, whole and in plan order. All throw Error (Exit::io) naming path and reason.
class JsonLines {
 public:
  // A new file, in place of an old one.
  JsonLines(std::string path, std::string header);
  // Goes on with a file that has a header, cutting it to its whole lines first.
  JsonLines(std::string path, const ResultsFile& found);

  void append(const Row& row);
  void finish(const Table& rows);

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  void put(const std::string& line);

  std::string path_, header_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace moire
