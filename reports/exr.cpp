// EXR files through OpenImageIO; part of the module moire_io.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "reports/image_io.h"
#include "reports/image_size.h"
#include "reports/memory_reader.h"

namespace moire {
namespace {

void set_attribute(OIIO::ImageSpec& spec, const Attribute& attribute) {
  const auto& [name, value] = attribute;
  if (const auto* text = std::get_if<std::string>(&value)) {
    spec.attribute(name, *text);
  } else if (const auto* number = std::get_if<double>(&value)) {
    spec.attribute(name, OIIO::TypeDesc::DOUBLE, number);
  } else {
    const std::int64_t integer = std::get<std::int64_t>(value);
    if (integer >= INT32_MIN && integer <= INT32_MAX) {
      spec.attribute(name, static_cast<int>(integer));
    } else {
      spec.attribute(name, std::to_string(integer));  // EXR's own integers have 32 bits
    }
  }
}

std::uint32_t word_at(std::span<const unsigned char> bytes, std::size_t at) {
  return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
         std::uint32_t{bytes[at + 3]} << 24;
}

std::string refuse_channels(std::int64_t count) {
  return count == 1 ? "" : "has " + std::to_string(count) + " channels instead of one";
}

// What is wrong with one attribute's value, "" when nothing is. OpenEXR takes memory for some rows of all channels
// before anybody can ask for the image's size.
std::string refuse_attribute(std::string_view name, std::span<const unsigned char> value) {
  if (name == "dataWindow" && value.size() == 16) {  // the first and last column and row, two's complement
    const auto side = [&](std::size_t at) {
      return std::int64_t{static_cast<std::int32_t>(word_at(value, at + 8))} -
             static_cast<std::int32_t>(word_at(value, at)) + 1;
    };
    return refuse_size(side(0), side(4));
  }
  if (name == "channels") {  // each a name, its 0 and 16 bytes; then a 0
    std::int64_t count = 0;
    while (!value.empty() && value[0] != 0) {
      const auto length = static_cast<std::size_t>(std::find(value.begin(), value.end(), 0) - value.begin());
      value = value.subspan(std::min(value.size(), length + 1 + 16));
      ++count;
    }
    return refuse_channels(count);
  }
  return {};
}

// What is wrong with the headers, "" when nothing is. OpenEXR takes as much memory as an attribute claims to be long,
// up to 2 GiB, before it looks whether there are as many bytes. Layout: "OpenEXR File Layout" (openexr.com): eight
// bytes, then attributes (name, 0, type, 0, four bytes of length, value) up to an empty name; of files with several
// parts up to an empty header.
std::string refuse_attributes(std::span<const unsigned char> bytes) {
  constexpr std::size_t kBegin = 8, kLongestName = 255;
  constexpr unsigned char kSeveralParts = 0x10;  // of the sixth byte
  if (bytes.size() < kBegin) return "is too short for an EXR file";
  const bool several = (bytes[5] & kSeveralParts) != 0;
  std::span<const unsigned char> rest = bytes.subspan(kBegin);
  const auto take_name = [&rest](std::string& name) {  // to behind its 0
    const auto end = std::find(rest.begin(), rest.end(), 0);
    const auto length = static_cast<std::size_t>(end - rest.begin());
    if (end == rest.end() || length > kLongestName) return false;
    name.assign(rest.begin(), end);
    rest = rest.subspan(length + 1);
    return true;
  };
  std::string name, type;
  for (bool first = true; !rest.empty(); first = false) {
    if (rest[0] == 0) {  // the end of a header
      rest = rest.subspan(1);
      if (!several || first || rest.empty() || rest[0] == 0) return {};
      continue;
    }
    if (!take_name(name) || !take_name(type) || rest.size() < 4) break;
    const std::uint32_t length = word_at(rest, 0);
    if (length > rest.size() - 4) break;
    if (std::string refused = refuse_attribute(name, rest.subspan(4, length)); !refused.empty()) return refused;
    rest = rest.subspan(4 + length);
  }
  return "is no EXR file, or its header is damaged";
}

}  // namespace

std::string write_exr_file(Grid grid, std::span<const float> y, const std::vector<Attribute>& attributes,
                           const std::string& software, ImageBytes& bytes) {
  OIIO::Filesystem::IOVecOutput memory(bytes);  // outlives the writer, which may still use it when it gives up
  const auto out = OIIO::ImageOutput::create("exr");
  if (!out) return OIIO::geterror();
  if (!out->set_ioproxy(&memory)) return "this OpenImageIO cannot write EXR to memory";
  OIIO::ImageSpec spec(grid.width, grid.height, 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Y"};
  spec.attribute("compression", "zip");
  // Without a DateTime the writer puts in the clock's. One of a type that it does not write keeps both out of the file;
  // the debug build's complaint about it is switched off.
  OIIO::attribute("debug", 0);
  // Threads of OpenEXR's own that compress: all cores for large images, none for those of which several are written at
  // a time (app/image_files.cpp). There every sixteen lines would wake and wait for one.
  OIIO::attribute("exr_threads", spec.image_pixels() > kSmallImage ? 0 : -1);
  spec.attribute("DateTime", 0);
  spec.attribute("Software", software);
  for (const Attribute& attribute : attributes) set_attribute(spec, attribute);
  if (!out->open("image.exr", spec)) return out->geterror();
  if (!out->write_image(OIIO::TypeDesc::FLOAT, y.data())) return out->geterror();
  if (!out->close()) return out->geterror();
  return {};
}

std::string read_exr_file(std::span<const unsigned char> bytes, ExrImage& image) {
  if (std::string refused = refuse_attributes(bytes); !refused.empty()) return refused;
  MemoryReader<OIIO::Filesystem::IOMemReader> memory(bytes);  // outlives the reader
  const auto in = OIIO::ImageInput::create("exr");
  if (!in) return OIIO::geterror();
  if (!in->set_ioproxy(&memory)) return "this OpenImageIO cannot read EXR from memory";
  OIIO::ImageSpec spec;
  if (!in->open("image.exr", spec)) return in->geterror();
  if (std::string refused = refuse_size(spec); !refused.empty()) return refused;
  if (spec.deep) return "is a deep image; give a flat one";
  if (std::string refused = refuse_channels(spec.nchannels); !refused.empty()) return refused;
  image.grid = {spec.width, spec.height};
  image.y.resize(spec.image_pixels());
  if (!read_pixels(*in, spec, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT), image.y.data())) return in->geterror();
  image.attributes.clear();
  for (const OIIO::ParamValue& p : spec.extra_attribs) {
    const std::string name = p.name().string();
    if (name.rfind("moire:", 0) != 0 && name != "Software") continue;
    if (p.type() == OIIO::TypeDesc::INT) {
      image.attributes.emplace_back(name, std::int64_t{p.get_int()});
    } else if (p.type() == OIIO::TypeDesc::DOUBLE) {
      image.attributes.emplace_back(name, p.get<double>());
    } else {
      image.attributes.emplace_back(name, p.get_string(0));
    }
  }
  return {};
}

}  // namespace moire
