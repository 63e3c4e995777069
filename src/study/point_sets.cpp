// Sets of points from a file or from standard input, line by line: files may be larger than memory likes.
#include "study/point_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace moire {
namespace {

constexpr std::size_t kMaxLine = 4096;  // bytes; an end to lines that never end
constexpr std::string_view kBlanks = " \t";

// The columns of a line. Where a column would begin and there is none, it is empty.
struct Fields {
  std::string_view column[4];
  std::size_t count = 0;  // 4 stands for more than 3
};

Fields split(std::string_view line) {
  Fields fields;
  const auto skip_blanks = [&line] { line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size())); };
  skip_blanks();
  for (bool more = true; more && fields.count < 4;) {
    std::string_view& column = fields.column[fields.count++];
    column = line.substr(0, std::min(line.find_first_of(" \t,"), line.size()));
    line.remove_prefix(column.size());
    skip_blanks();
    more = !line.empty();
    if (line.starts_with(',')) {
      line.remove_prefix(1);
      skip_blanks();
    }
  }
  return fields;
}

bool is_header(const Fields& fields) {
  if (fields.count != 2 && fields.count != 3) return false;
  for (std::size_t i = 0; i < fields.count; ++i) {
    const std::string_view column = fields.column[i];
    if (column.size() != 1 || std::tolower(static_cast<unsigned char>(column[0])) != "xyt"[i]) return false;
  }
  return true;
}

// A line without the byte order mark of UTF-8 (RFC 3629, section 6), with which some editors begin a file. `first`:
// whether the line is the file's first; false then.
std::string_view without_mark(std::string_view line, bool& first) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (std::exchange(first, false) && line.starts_with(kMark)) line.remove_prefix(kMark.size());
  return line;
}

class Parser {
 public:
  explicit Parser(const std::string& file) : file_(file) {}

  void line(std::string_view text) {
    ++number_;
    if (text.size() > kMaxLine) refuse_length();
    if (text.ends_with('\r')) text.remove_suffix(1);
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return;
    if (text[first] == '#') return end_set();
    line_ = text;
    const Fields fields = split(text);
    const bool header = set_.x.empty() && !had_header_ && is_header(fields);
    if (columns_ == 0) columns_ = fields.count;
    if (columns_ < 2 || columns_ > 3 || fields.count != columns_) refuse_columns(fields);
    if (header) {
      had_header_ = true;
      return;
    }
    set_.x.push_back(coordinate(fields.column[0]));
    set_.y.push_back(coordinate(fields.column[1]));
    if (columns_ == 3) set_.t.push_back(coordinate(fields.column[2]));
    if (++points_ > kMaxSetPoints) {
      throw Error(file_, fmt::format("has more points than can be read; give {} at most", kMaxSetPoints));
    }
  }

  std::vector<PointSet> finish() {
    end_set();
    if (sets_.empty()) throw Error(file_, "has no points; write lines x,y or x,y,t");
    return std::move(sets_);
  }

 private:
  [[noreturn]] void refuse_length() const {
    throw Error(fmt::format("{}:{}:1", file_, number_),
                fmt::format("the line is longer than {} bytes; write lines x,y or x,y,t", kMaxLine));
  }

  void end_set() {
    if (!set_.x.empty()) sets_.push_back(std::move(set_));
    if (sets_.size() > kMaxPointSets) {
      throw Error(file_, fmt::format("has more sets than can be read; give {} at most", kMaxPointSets));
    }
    set_ = {};
    had_header_ = false;
  }

  Error error(std::string_view at, const std::string& what) const {
    return Error(fmt::format("{}:{}:{}", file_, number_, at.data() - line_.data() + 1), what);
  }

  [[noreturn]] void refuse_columns(const Fields& fields) const {
    const bool first = columns_ == fields.count;  // no earlier line said how many
    const std::size_t wanted = first ? 3 : columns_;
    const std::string_view at = fields.column[std::min(fields.count - 1, wanted)];
    const std::string count = fields.count > 3 ? "more than 3" : fmt::format("{}", fields.count);
    throw error(at, fmt::format("the line has {} column{}; write {}", count, fields.count == 1 ? "" : "s",
                                first ? "x,y or x,y,t" : fmt::format("{} as in the lines before", wanted)));
  }

  double coordinate(std::string_view text) const {
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || end != text.data() + text.size()) {
      throw error(text, fmt::format("\"{}\" is no number; write x,y or x,y,t, each in [0, 1)", text.substr(0, 60)));
    }
    // Also false for NaN. What rounds to 1 is outside as well.
    if (!(value >= 0 && value < 1)) {
      throw error(text, fmt::format("{} is outside [0, 1); points of the unit square are needed", text.substr(0, 60)));
    }
    return value + 0.0;  // -0 becomes +0
  }

  const std::string& file_;
  std::string_view line_;
  std::size_t number_ = 0, points_ = 0;
  std::size_t columns_ = 0;  // of all lines; 0: not known yet
  bool had_header_ = false;  // of the set that is being read
  PointSet set_;
  std::vector<PointSet> sets_;
};

}  // namespace

std::vector<PointSet> parse_point_sets(const std::function<std::size_t(char* bytes, std::size_t size)>& read,
                                       const std::string& file) {
  Parser parser(file);
  bool first = true;
  std::string buffer(std::size_t{1} << 18, '\0');
  std::size_t kept = 0;  // bytes of a line that is not whole yet, at the front
  for (;;) {
    const std::size_t got = read(buffer.data() + kept, buffer.size() - kept);
    std::string_view rest(buffer.data(), kept + got);
    for (std::size_t end; (end = rest.find('\n')) != std::string_view::npos; rest.remove_prefix(end + 1)) {
      parser.line(without_mark(rest.substr(0, end), first));
    }
    if (got == 0) {
      if (!rest.empty()) parser.line(without_mark(rest, first));
      return parser.finish();
    }
    if (rest.size() > kMaxLine) parser.line(rest);  // which refuses it
    kept = rest.size();
    std::memmove(buffer.data(), rest.data(), kept);
  }
}

std::vector<PointSet> read_point_sets(const std::string& path) {
  const bool standard = path == "-";
  const std::string name = standard ? "standard input" : path;
  const auto fail = [&](int reason) {
    return Error(name, fmt::format("cannot be read ({}); give a readable file", std::strerror(reason)), Exit::io);
  };
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdin) std::fclose(file);
    }
  };
  const std::unique_ptr<std::FILE, Close> file(standard ? stdin : std::fopen(path.c_str(), "rb"));
  if (!file) throw fail(errno);
  return parse_point_sets(
      [&](char* bytes, std::size_t size) {
        const std::size_t got = std::fread(bytes, 1, size, file.get());
        if (got == 0 && std::ferror(file.get()) != 0) throw fail(errno);
        return got;
      },
      name);
}

}  // namespace moire
