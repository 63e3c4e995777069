// The spectrum of an image's error, for `moire spectrum IMAGE`.
#pragma once

#include <string>
#include <string_view>

#include "app/spectrum_output.h"
#include "measure/spectrum.h"

namespace moire {

// Whether a word is the name of an image: ends in .exr or .png, in small letters or capitals.
bool is_image_name(std::string_view word);

// Of image minus reference, or of the image itself where `reference` is "": an error already. Both are .exr (one
// channel) or .png (8 bits, sRGB, decoded to linear coverage; colours count by their luminance) of one size. One
// realisation has no interval. bias and rmse are those of the image as it is; power, and csf_rms with it, of the image
// through the window. Throws Error for files that cannot be read (Exit::io) and for sizes that differ.
SpectrumOutput image_spectrum(const std::string& path, const std::string& reference, SpectrumWindow window,
                              double pixels_per_degree);

}  // namespace moire
