// Writing the images of cases: float EXR with what defines the image, and PNG previews.
#pragma once

#include <cstdint>
#include <string>

#include "study/run.h"
#include "study/study.h"

namespace moire {

// All throw Error (Exit::io). Zero is written +0.0.

// The exact image of a scene and filter of the study.
void write_exact_exr(const std::string& path, const Study& study, std::uint32_t scene, std::uint32_t filter,
                     const Truth& truth);
// The reconstruction, and reconstruction minus exact (taken in double, then rounded).
void write_got_exr(const std::string& path, const Study& study, const Case& c, const Truth& truth,
                   const CaseResult& result);
void write_error_exr(const std::string& path, const Study& study, const Case& c, const Truth& truth,
                     const CaseResult& result);

// The same with previews, under the names of file_names.h in `folder`.
void write_exact_images(const std::string& folder, const Study& study, std::uint32_t scene, std::uint32_t filter,
                        const Truth& truth);
void write_case_images(const std::string& folder, const Study& study, const Case& c, const Truth& truth,
                       const CaseResult& result);

// The spectra of a case's errors: .spectrum.exr (total), .structured.exr and .noise.exr where there is the split, a
// .spectrum.png of the total over its mean and the radial means as .spectrum.csv.
void write_spectra_files(const std::string& folder, const Study& study, const Case& c, const Spectra& spectra);

// Whether those files are there. They appear whole, so that one that is there is finished.
bool has_exact_images(const std::string& folder, const Study& study, std::uint32_t scene, std::uint32_t filter);
bool has_spectra_files(const std::string& folder, const Study& study, const Case& c);
bool has_case_images(const std::string& folder, const Study& study, const Case& c);

}  // namespace moire
