// One pass over the text, row by row; what is wrong is said where it stands.
#include "filters/kernel_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "core/args.h"
#include "core/error.h"

namespace moire {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;  // 4096 rows of 256 bytes

std::string read_all(const std::string& path, const std::string& place) {
  const auto fail = [&](std::string_view reason) {
    return Error(place, fmt::format("{}: the file cannot be read ({}); give a readable file of rows x,k", path, reason),
                 Exit::io);
  };
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw fail(std::strerror(errno));
  std::string text(kMaxBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw fail(std::strerror(errno));  // a folder opens and does not read
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxBytes) throw fail("it is above 1 MiB");
  return text;
}

// A part of a line without the blanks around it, and the column that it begins in, from 1.
struct Field {
  std::string_view text;
  std::size_t column;
};

Field trimmed(std::string_view line, std::size_t from, std::size_t to) {
  const auto blank = [&](std::size_t i) { return line[i] == ' ' || line[i] == '\t' || line[i] == '\r'; };
  while (from < to && blank(from)) ++from;
  while (to > from && blank(to - 1)) --to;
  return {line.substr(from, to - from), from + 1};
}

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t to = std::min(line.find(',', from), line.size());
    fields.push_back(trimmed(line, from, to));
    from = to + 1;
  }
  return fields;
}

// Whether it reads as a number, finite or not.
bool is_numeric(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double unused = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, unused);
  return result.ptr == end && result.ec != std::errc::invalid_argument;
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  void line(std::string_view text) {
    ++line_;
    const Field whole = trimmed(text, 0, text.size());
    if (whole.text.empty() || whole.text.starts_with('#')) return;
    const std::vector<Field> fields = fields_of(text);
    const bool header = std::none_of(fields.begin(), fields.end(), [](Field f) { return is_numeric(f.text); });
    if (std::exchange(first_, false) && header && fields.size() == 2) return;
    if (fields.size() != 2) {
      const Field& odd = fields.size() < 2 ? fields[0] : fields[2];
      throw error(odd.column, fmt::format("the row has {} fields; give two, x,k", fields.size()));
    }
    const double x = number(fields[0], "x"), k = number(fields[1], "k");
    add(x, k, fields[0].column);
  }

  std::vector<KernelRow> finish() {
    if (rows_.size() < 2 || rows_.front().x == rows_.back().x) {
      throw Error(path_, fmt::format("the kernel has {} row{}; give at least two, of different x", rows_.size(),
                                     rows_.size() == 1 ? "" : "s"));
    }
    if (rows_.front().x >= 0) mirror();
    const double radius = std::max(-rows_.front().x, rows_.back().x);
    if (radius < kMinKernelRadius) {
      throw Error(path_, fmt::format("the kernel ends at {} pixels; it must reach at least {}", shortest(radius),
                                     shortest(kMinKernelRadius)));
    }
    double peak = 0;
    for (const KernelRow& r : rows_) peak = std::max(peak, std::fabs(r.k));
    if (!(peak >= kLeastPeak && peak <= kMostPeak)) {
      throw Error(path_, fmt::format("the largest |k| is {}; it must be {} to {}", shortest(peak), shortest(kLeastPeak),
                                     shortest(kMostPeak)));
    }
    return rows_;
  }

 private:
  Error error(std::size_t column, const std::string& what) const {
    return Error(fmt::format("{}:{}:{}", path_, line_, column), what);
  }

  double number(const Field& f, std::string_view name) const {
    double value = 0;
    if (parse_number(f.text, value)) return value;
    if (f.text.empty()) throw error(f.column, fmt::format("{} is missing; give a number", name));
    throw error(f.column, fmt::format("{} is not {}: \"{}\"; give a finite number", name,
                                      is_numeric(f.text) ? "finite" : "a number", f.text));
  }

  void add(double x, double k, std::size_t column) {
    if (std::fabs(x) > kMaxKernelRadius) {
      throw error(column,
                  fmt::format("x is {} pixels; it must be -{} to {}", shortest(x), kMaxKernelRadius, kMaxKernelRadius));
    }
    if (static_cast<int>(rows_.size()) == kMaxKernelRows) {
      throw error(column, fmt::format("the kernel has more than {} rows; give fewer", kMaxKernelRows));
    }
    if (!rows_.empty()) {
      const double before = rows_.back().x;
      if (x < before) {
        throw error(column, fmt::format("x falls from {} to {}; sort the rows by x", shortest(before), shortest(x)));
      }
      if (x == before && rows_.size() >= 2 && rows_[rows_.size() - 2].x == x) {
        throw error(column, fmt::format("x is {} a third time; two rows make a jump", shortest(x)));
      }
      if (x > before && x - before < kLeastStep) {
        throw error(column, fmt::format("x is only {} pixels after the row before; give steps of at least 2^-20, or "
                                        "the same x twice for a jump",
                                        shortest(x - before)));
      }
      if (x == before && x == 0 && rows_.size() == 1) jump_at_0_ = line_;
    }
    rows_.push_back({x, k});
  }

  // Puts the left half of an even kernel before the right one.
  void mirror() {
    if (jump_at_0_ != 0) {
      throw Error(fmt::format("{}:{}:1", path_, jump_at_0_),
                  "a second row for x = 0 where no x is negative: an even kernel has no jump there; give one row");
    }
    if (rows_.front().x > 0 && 2 * rows_.front().x < kLeastStep) {
      throw Error(path_, fmt::format("x begins at {} pixels, too near to 0; give 0", shortest(rows_.front().x)));
    }
    std::vector<KernelRow> left;
    for (const KernelRow& r : rows_) {
      if (r.x != 0) left.push_back({-r.x, r.k});
    }
    rows_.insert(rows_.begin(), left.rbegin(), left.rend());
  }

  const std::string& path_;
  std::vector<KernelRow> rows_;
  int line_ = 0, jump_at_0_ = 0;
  bool first_ = true;
};

}  // namespace

std::vector<KernelRow> read_kernel_file(const std::string& path, const std::string& place) {
  const std::string text = read_all(path, place);
  Reader reader(path);
  for (std::size_t from = text.starts_with("\xef\xbb\xbf") ? 3 : 0; from < text.size();) {  // a byte order mark
    const std::size_t to = std::min(text.find('\n', from), text.size());
    reader.line(std::string_view(text).substr(from, to - from));
    from = to + 1;
  }
  return reader.finish();
}

}  // namespace moire
