// The answer on a terminal.
#include "reports/terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/cases.h"
#include "reports/contrast.h"

namespace moire {
namespace {

// A cell's text, and the number that competes for best in its column (NaN: does not).
struct Entry {
  std::string text;
  double value = 0;
};

// Line by line, the first line the header.
using Lines = std::vector<std::vector<Entry>>;

Entry error_entry(const Row* row) {
  const double rmse = row == nullptr ? std::nan("") : row->number("rmse_active");
  if (!std::isfinite(rmse)) return {"-", std::nan("")};
  return {fmt::format("{:.2e}{}", rmse, row->flag("reference_limited") ? "~" : ""), rmse};
}

Entry slope_entry(const Row* row) {
  const double slope = row == nullptr ? std::nan("") : row->number("slope");
  if (!std::isfinite(slope)) return {"-", std::nan("")};
  const double half = (row->number("slope_hi") - row->number("slope_lo")) / 2;
  // Without an interval: as wide as with one, so that the slopes line up.
  return {fmt::format("{:.2f}", slope) + (std::isfinite(half) ? fmt::format(" +-{:.2f}", half) : std::string(7, ' ')),
          slope};
}

// Code points, which is columns for the names that occur.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string set_out(Lines& lines, bool bold) {
  const std::size_t columns = lines.front().size();
  std::vector<std::size_t> widths(columns, 0);
  std::vector<double> best(columns, std::nan(""));
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < columns; ++i) {
      widths[i] = std::max(widths[i], width(line[i].text) + 1);
      best[i] = std::fmin(best[i], line[i].value);
    }
  }
  std::string text;
  for (const auto& line : lines) {
    std::string out = line[0].text + std::string(widths[0] - width(line[0].text), ' ');
    for (std::size_t i = 1; i < columns; ++i) {
      const bool is_best = line[i].value == best[i];
      out += std::string(widths[i] - width(line[i].text), ' ');
      out += is_best && bold ? "\x1b[1m" + line[i].text + "*\x1b[0m" : line[i].text + (is_best ? "*" : " ");
    }
    out.erase(out.find_last_not_of(' ') + 1);
    text += "  " + out + "\n";
  }
  return text;
}

// Lines of at most 110 characters, broken at blanks.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kWidth = 110;
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > kWidth) {
      const std::size_t blank = text.rfind(' ', begin + kWidth);
      end = blank != std::string::npos && blank > begin ? blank : std::min(text.find(' ', begin), end);
    }
    out += text.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return out;
}

}  // namespace

std::string terminal_tables(const Summary& summary, bool bold) {
  const Cases cases(summary.rows), slopes(summary.slopes);
  const double none = std::nan("");
  std::string text = wrapped(slope_contrast(summary, ""));
  for (const std::string& scene : cases.scenes()) {
    for (const Reconstruction& kernel : cases.kernels()) {
      Lines lines;
      lines.push_back({{"pattern", none}});
      for (const std::int64_t spp : cases.spp()) lines[0].push_back({std::to_string(spp), none});
      lines[0].push_back({"slope", none});
      for (const std::string& pattern : cases.patterns()) {
        std::vector<Entry> line{{pattern, none}};
        bool any = false;
        for (const std::int64_t spp : cases.spp()) {
          const Row* row = cases.first(scene, pattern, kernel, spp);
          any |= row != nullptr;
          line.push_back(error_entry(row));
        }
        line.push_back(slope_entry(slopes.first(scene, pattern, kernel)));
        if (any) lines.push_back(std::move(line));
      }
      if (lines.size() > 1) text += scene + ", " + kernel.label() + "\n" + set_out(lines, bold) + "\n";
    }
  }
  if (!text.empty())
    text += "RMSE over active pixels by samples per pixel; * best; ~ within 10 times the reference's bound\n";
  return text;
}

}  // namespace moire
