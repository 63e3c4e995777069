// PNG files through OpenImageIO; part of the module moire_io.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <string_view>

#include "reports/image_io.h"
#include "reports/image_size.h"
#include "reports/memory_reader.h"

namespace moire {
namespace {

// What is wrong with the chunks, "" when nothing is: a signature, then chunks (four bytes of length, type, data, four
// bytes of checksum) to IEND, which must all be there. PNG specification, section 5. Where the bytes end too soon, the
// reader leaves its own function by a jump that frees nothing.
std::string refuse_chunks(std::span<const unsigned char> bytes) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n", kEnd = "IEND";
  constexpr std::size_t kAround = 12;  // bytes of a chunk that are not its data
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!rest.starts_with(kSignature)) return "is no PNG file";
  rest.remove_prefix(kSignature.size());
  while (rest.size() >= kAround) {
    std::size_t length = 0;
    for (const char c : rest.substr(0, 4)) length = length << 8 | static_cast<unsigned char>(c);
    if (length > rest.size() - kAround) break;
    if (rest.substr(4, 4) == kEnd) return {};
    rest.remove_prefix(kAround + length);
  }
  return "is a PNG file whose end is missing";
}

}  // namespace

std::string write_png_file(const Raster& raster, const std::string& software, ImageBytes& bytes) {
  OIIO::Filesystem::IOVecOutput memory(bytes);  // outlives the writer, which may still use it when it gives up
  const auto out = OIIO::ImageOutput::create("png");
  if (!out) return OIIO::geterror();
  if (!out->set_ioproxy(&memory)) return "this OpenImageIO cannot write PNG to memory";
  OIIO::ImageSpec spec(raster.grid.width, raster.grid.height, raster.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("Software", software);
  for (const auto& [keyword, text] : raster.text) spec.attribute(keyword, text);
  if (!out->open("image.png", spec)) return out->geterror();
  if (!out->write_image(OIIO::TypeDesc::UINT8, raster.pixels.data())) return out->geterror();
  if (!out->close()) return out->geterror();
  return {};
}

std::string read_png_file(std::span<const unsigned char> bytes, Raster& raster) {
  if (std::string refused = refuse_chunks(bytes); !refused.empty()) return refused;
  MemoryReader<OIIO::Filesystem::IOMemReader> memory(bytes);  // outlives the reader
  const auto in = OIIO::ImageInput::create("png");
  if (!in) return OIIO::geterror();
  if (!in->set_ioproxy(&memory)) return "this OpenImageIO cannot read PNG from memory";
  OIIO::ImageSpec spec;
  if (!in->open("image.png", spec)) return in->geterror();
  if (std::string refused = refuse_size(spec); !refused.empty()) return refused;
  raster.grid = {spec.width, spec.height};
  raster.channels = spec.nchannels;
  raster.pixels.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!read_pixels(*in, spec, OIIO::TypeDesc(OIIO::TypeDesc::UINT8), raster.pixels.data())) return in->geterror();
  raster.text.clear();
  for (const OIIO::ParamValue& p : spec.extra_attribs) {
    if (p.type() == OIIO::TypeDesc::STRING) raster.text.emplace_back(p.name().string(), p.get_string(0));
  }
  return {};
}

}  // namespace moire
