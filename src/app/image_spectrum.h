// The spectrum of an image's error, for `moire spectrum IMAGE`.
#pragma once

#include <string>

#include "app/spectrum_output.h"

namespace moire {

// Of image minus reference, or of the image itself where `reference` is "": an error already. Both are .exr (one
// channel) or .png (8 bits, sRGB, decoded to linear coverage; colours count by their luminance) of one size. One
// realisation has no interval, and no window is applied. Throws Error for files that cannot be read (Exit::io) and for
// sizes that differ.
SpectrumOutput image_spectrum(const std::string& path, const std::string& reference);

}  // namespace moire
