// PNG files through OpenImageIO; part of the module moire_io.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "reports/image_io.h"

namespace moire {

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

std::string read_png_file(const std::string& path, Raster& raster) {
  const auto in = OIIO::ImageInput::open(path);
  if (!in) return OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  raster.grid = {spec.width, spec.height};
  raster.channels = spec.nchannels;
  raster.pixels.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, raster.pixels.data())) return in->geterror();
  raster.text.clear();
  for (const OIIO::ParamValue& p : spec.extra_attribs) {
    if (p.type() == OIIO::TypeDesc::STRING) raster.text.emplace_back(p.name().string(), p.get_string(0));
  }
  return {};
}

}  // namespace moire
