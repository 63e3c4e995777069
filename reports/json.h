// Results as JSON Lines (jsonlines.org): a header line, then one line per row. Grows while a run goes on.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "reports/provenance.h"
#include "study/results.h"

namespace moire {

// {"kind":"header","schema":"moire.results/1",...}: what the same study, seed and build always give; no line end.
std::string json_header(const Tool& tool, const Host& host, const StudyText& study);

// One row as one line of JSON, cells in their order, without a line end. Doubles are the shortest that read back as
// the same bits, with a point or exponent; NaN, infinities and empty cells are null; text that is not UTF-8 has its
// bad bytes replaced. `kind`: "row" puts "kind":"row" first; "" leaves it out.
std::string json_row(const Row& row, std::string_view kind = "row");

// The row of such a line, without "kind". Numbers with a point or exponent are doubles, others 64-bit integers.
// Throws Error at `place` for anything but an object of numbers, texts, booleans and nulls.
Row parse_json_row(std::string_view line, const std::string& place);

// A results file: rows are there as soon as they are appended, in any order; finish() writes the file again, whole and
// in plan order. All throw Error (Exit::io) naming path and reason.
class JsonLines {
 public:
  JsonLines(std::string path, std::string header);
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
