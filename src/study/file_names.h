// Names of the image files of a study, relative to the folder of its results.
#pragma once

#include <string>
#include <string_view>

#include "study/study.h"

namespace moire {

// Characters outside [a-z0-9.=-] become "-". The underscore is among them: it separates the parts of a file name, so
// that files of two cases are the same only when a part is.
std::string file_part(std::string_view text);

// images/<scene>_<pattern>_<spp>_<filter>_t<trial>, followed by .got.exr, .error.exr, ...; an estimator other than
// `ratio` follows the filter as _<estimator>, and _image after it says that layout.
std::string image_stem(const Study& study, const Case& c);

// The same without the trial, followed by .spectrum.exr, ...
std::string spectra_stem(const Study& study, const Case& c);

// images/<scene>_<filter>, followed by .exact.exr, ...
std::string exact_stem(const Study& study, std::uint32_t scene, std::uint32_t filter);

// Whether the study's images setting keeps the images of this trial.
bool keeps_images(const Study& study, std::uint32_t trial);

// Throws Error when the scene's image has more than kMaxImagePixels pixels, to be held densely; `place` is for the
// message.
void check_image_size(const NamedScene& scene, const std::string& place);

// Throws Error when two scenes, patterns, filters or estimators would share files, when a file's name would be longer
// than file systems take (255 bytes), or when an image is too large to be written (kMaxImagePixels).
void check_file_names(const Study& study);

}  // namespace moire
