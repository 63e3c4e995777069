// EXR files through OpenImageIO; part of the module moire_io.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>

#include "reports/image_io.h"

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
  spec.attribute("DateTime", 0);
  spec.attribute("Software", software);
  for (const Attribute& attribute : attributes) set_attribute(spec, attribute);
  if (!out->open("image.exr", spec)) return out->geterror();
  if (!out->write_image(OIIO::TypeDesc::FLOAT, y.data())) return out->geterror();
  if (!out->close()) return out->geterror();
  return {};
}

std::string read_exr_file(const std::string& path, ExrImage& image) {
  const auto in = OIIO::ImageInput::open(path);
  if (!in) return OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.nchannels != 1) return "has " + std::to_string(spec.nchannels) + " channels instead of one";
  image.grid = {spec.width, spec.height};
  image.y.resize(spec.image_pixels());
  if (!in->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, image.y.data())) return in->geterror();
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
