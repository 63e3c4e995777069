// The images of a run in a page.
#include "reports/page_images.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/args.h"
#include "core/error.h"
#include "core/parallel.h"
#include "reports/images.h"
#include "reports/json.h"
#include "reports/page_encoding.h"
#include "reports/page_json.h"

namespace moire {
namespace {

// Images that are read together.
constexpr std::size_t kBatch = 32;

// The file's name without its folder and ".exr".
std::string id_of(const RunPlace& place, const std::string& file) {
  const std::size_t slash = file.rfind('/') + 1;
  return place.id + "/" + file.substr(slash, file.size() - slash - std::string_view(".exr").size());
}

std::string pixels_json(const EncodedPixels& pixels) {
  JsonObject object;
  object.add("w", std::to_string(pixels.grid.width));
  object.add("h", std::to_string(pixels.grid.height));
  object.add_text("type", pixels.half ? "f16" : "f32");
  object.add("shuffle", pixels.shuffle ? "true" : "false");
  object.add("gzip", pixels.gzip ? "true" : "false");
  object.add("scale", shortest(pixels.scale));
  object.add_text("data", pixels.data);
  return std::move(object).text();
}

// All but the place among the errors, which is known when the image is kept.
JsonObject image_object(const PageImage& image, const RunPlace& place) {
  const Row& row = *image.row;
  const bool exact = image.kind == PageImage::Kind::exact;
  JsonObject object;
  object.add_text("id", id_of(place, image.file));
  object.add_text("kind", name_of(image.kind));
  for (const char* key : {"scene", "filter"}) object.add_text(key, row.text(key));
  if (!exact) {
    for (const char* key : {"pattern", "layout", "estimator"}) object.add_text(key, row.text(key));
    object.add("spp", json_cell(*row.find("spp")));
  }
  if (image.kind == PageImage::Kind::error) {
    object.add("trial", json_cell(*row.find("trial")));
    if (!image.exact.empty()) object.add_text("of", id_of(place, image.exact));
    if (std::isfinite(row.number("p995_active"))) object.add("range", json_cell(*row.find("p995_active")));
  }
  object.add_text("file", place.link + image.file);
  return object;
}

struct Read {
  std::optional<EncodedPixels> pixels;
  std::string fault;
};

Read read(const PageImage& image, const RunPlace& place) {
  try {
    const ExrImage exr = read_exr(place.folder + "/" + image.file);
    const bool exact = image.kind == PageImage::Kind::exact;
    return {exact ? encode_floats(exr.grid, exr.y) : encode_halves(exr.grid, exr.y), ""};
  } catch (const Error& e) {
    return {std::nullopt, e.what()};
  }
}

}  // namespace

PageImages page_images(std::span<const PageImage> images, const RunPlace& place, std::size_t budget) {
  PageImages result;
  std::size_t errors = 0;
  int misses = 0;
  const auto leave_out = [&](const PageImage& image) { result.left_out.push_back(image); };
  const auto is_large = [](const PageImage& image) {
    return image.row->number("width") * image.row->number("height") > kMaxPagePixels;
  };
  for (std::size_t begin = 0; begin < images.size(); begin += kBatch) {
    const auto batch = images.subspan(begin, std::min(kBatch, images.size() - begin));
    if (misses >= kMostMisses) {
      std::for_each(batch.begin(), batch.end(), leave_out);
      continue;
    }
    std::vector<Read> reads(batch.size());
    parallel_for(batch.size(), [&](std::size_t i) {
      if (!is_large(batch[i])) reads[i] = read(batch[i], place);
    });
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (!reads[i].fault.empty()) {
        result.unreadable.push_back(reads[i].fault);
        continue;
      }
      if (is_large(batch[i]) || misses >= kMostMisses) {
        leave_out(batch[i]);
        continue;
      }
      JsonObject object = image_object(batch[i], place);
      if (batch[i].kind == PageImage::Kind::error) object.add("row", std::to_string(errors));
      object.add("pixels", pixels_json(*reads[i].pixels));
      std::string json = std::move(object).text();
      const std::size_t size = json.size() + 1 + (batch[i].kind == PageImage::Kind::error ? kRowBytes : 0);
      if (result.bytes + size > budget) {
        ++misses;
        leave_out(batch[i]);
        continue;
      }
      result.bytes += size;
      errors += batch[i].kind == PageImage::Kind::error ? 1 : 0;
      result.kept.push_back({batch[i], std::move(json)});
    }
  }
  return result;
}

}  // namespace moire
