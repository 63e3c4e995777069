// A report page read back: base64, gzip, halves and planes of bytes undone, by other ways than they were done.
#pragma once

#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace moire::page {

using Json = nlohmann::ordered_json;

inline std::string from_base64(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int known = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) throw std::runtime_error("no base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    known += 6;
    if (known < 8) continue;
    known -= 8;
    bytes += static_cast<char>(bits >> known & 0xffU);
  }
  return bytes;
}

inline std::string gunzip(const std::string& packed) {
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) throw std::runtime_error("inflateInit2");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string bytes;
  std::vector<unsigned char> block(1 << 16);
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = block.data();
    stream.avail_out = static_cast<uInt>(block.size());
    status = inflate(&stream, Z_NO_FLUSH);
    bytes.append(reinterpret_cast<const char*>(block.data()), block.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status != Z_STREAM_END || stream.avail_in != 0) throw std::runtime_error("no gzip");
  return bytes;
}

// What a half means, by its definition in IEEE 754.
inline double half_value(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double sign = (bits >> 15) == 0 ? 1 : -1;
  if (exponent == 31) return fraction == 0 ? sign * HUGE_VAL : std::nan("");
  return sign * (exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25));
}

// The value, unpacked where it is packed.
inline Json unpacked(const Json& value) {
  return value.is_object() && value.contains("gz")
             ? Json::parse(gunzip(from_base64(value["gz"].get_ref<const std::string&>())))
             : value;
}

// The cell of a table by columns.
inline Json cell(const Json& table, const std::string& column, std::size_t row) {
  const Json& cells = table.at("columns").at(column);
  return cells.is_object() ? cells.at("all") : cells.at(row);
}

// The values of `pixels`, row by row.
inline std::vector<double> pixel_values(const Json& pixels) {
  std::string bytes = from_base64(pixels.at("data").get_ref<const std::string&>());
  if (pixels.at("gzip").get<bool>()) bytes = gunzip(bytes);
  const std::size_t width = pixels.at("type") == "f16" ? 2 : 4, count = bytes.size() / width;
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t bits = 0;
    for (std::size_t b = 0; b < width; ++b) {
      const std::size_t at = pixels.at("shuffle").get<bool>() ? b * count + i : i * width + b;
      bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at))) << (8 * b);
    }
    float value;
    std::memcpy(&value, &bits, sizeof value);
    const double stored = width == 2 ? half_value(static_cast<std::uint16_t>(bits)) : static_cast<double>(value);
    values.push_back(stored * pixels.at("scale").get<double>());
  }
  return values;
}

// The data of a page.
inline Json data_of(std::string_view html) {
  constexpr std::string_view kBegin = "id=\"moire-report\">";
  const std::size_t begin = html.find(kBegin);
  if (begin == std::string_view::npos) throw std::runtime_error("no page");
  const std::size_t end = html.find('<', begin + kBegin.size());
  return Json::parse(html.substr(begin + kBegin.size(), end - begin - kBegin.size()));
}

// Everything but what comes of times, as one text; tables unpacked.
inline std::string without_times(const Json& data) {
  Json copy = data;
  for (Json& run : copy.at("runs")) {
    for (auto& [name, table] : run.at("tables").items()) {
      table = unpacked(table);
      Json kept = Json::object();
      for (const auto& [column, cells] : table.at("columns").items()) {
        if (!column.starts_with("time_") && column.find("equal_time") == std::string::npos) kept[column] = cells;
      }
      table["columns"] = kept;
    }
  }
  return copy.dump();
}

}  // namespace moire::page
