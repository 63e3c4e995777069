// The published formula of a filter of the catalogue, with its parameters and presets.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

#include "filters/filter.h"
#include "stress/filter_forms.h"

namespace moire::stress {

inline std::string preset_of(const Filter& filter) {
  return filter.args().find("preset") == nullptr ? "none" : std::string(filter.args().text("preset"));
}

template <class T>
Form<T> mitchell_form(const Filter& filter) {
  const Args& a = filter.args();
  return bc_form(bc_parameter<T>(a.number("b")), bc_parameter<T>(a.number("c")), a.number("radius"));
}

template <class T>
Form<T> gaussian_form_of(const Filter& filter) {
  const Args& a = filter.args();
  const std::string preset = preset_of(filter);
  if (preset == "none") return gaussian_form<T>(a.number("sigma"), a.number("radius"), a.text("cut") == "offset");
  if (preset == "pbrt") return gaussian_form<T>(0.5, 1.5, true);
  if (preset == "mitsuba") return gaussian_form<T>(0.5, 2, true);
  if (preset == "imagemagick") return gaussian_form<T>(0.5, 2, false);
  if (preset == "ospray") return gaussian_form<T>(0.5, 1.5, false);
  if (preset == "renderman" || preset == "arnold") return gaussian_form<T>(0.5, 1, false);
  if (preset == "cycles") return gaussian_form<T>(0.375, 2.25, false);
  if (preset == "oiio") return gaussian_form<T>(0.75, 1.5, false);
  if (preset == "oiio-sharp") return gaussian_form<T>(std::sqrt(0.125), 1, false);  // exp(-4 x^2)
  throw std::invalid_argument("no form of preset " + preset);
}

// ImageMagick's numbers for the presets of lanczos and jinc.
inline int preset_lobes(const std::string& preset) { return preset == "imagemagick-sharp" ? 3 : 2; }
inline double preset_blur(const std::string& preset) {
  return preset == "imagemagick-sharp" ? 0.9812505644269356 : preset == "imagemagick2-sharp" ? 0.9549963639785485 : 1;
}

template <class T>
Form<T> radial_bc_form(const Filter& filter) {
  const std::string preset = preset_of(filter);
  if (preset == "none") return mitchell_form<T>(filter);
  if (preset == "renderman-catmull-rom") return bc_form(T(0.0), T(0.5), 2);
  if (preset == "imagemagick-robidoux") return bc_form(T(0.37821575509399867), T(0.31089212245300067), 2);
  if (preset == "imagemagick-robidoux-sharp") return bc_form(T(0.2620145123990142), T(0.3689927438004929), 2);
  // OSPRay clamps Mitchell's filter: negative from 8/7 on, its support ends at the double next to that.
  Form<T> f = bc_form(bc_parameter<T>(1.0 / 3), bc_parameter<T>(1.0 / 3), 2);
  f.breaks = {0, 1, 8.0 / 7};
  return f;
}

// `jinc_zero` gives the zero of that number of the jinc, from 1, to the nearest double. Throws std::invalid_argument
// for a filter that it does not know.
template <class T>
Form<T> form_of(const Filter& filter, double (*jinc_zero)(int)) {
  const std::string_view name = filter.info().name;
  const Args& a = filter.args();
  const std::string preset = preset_of(filter);
  const bool none = preset == "none";
  const auto keys = [](double slope) { return bc_form(T(0.0), T(-slope), 2); };
  if (name == "box") return {{0, a.number("width") / 2}, [](int, const T&) { return T(1.0); }};
  if (name == "disk") return {{0, a.number("radius")}, [](int, const T&) { return T(1.0); }};
  if (name == "tent" || name == "cone") {
    const double r = none ? a.number("radius") : 2;
    return {{0, r}, [r](int, const T& x) { return T(r) - x; }};
  }
  if (name == "bspline") return bspline_form<T>(static_cast<int>(a.integer("order")));
  if (name == "mitchell") return mitchell_form<T>(filter);
  if (name == "catmull-rom") return keys(-0.5);
  if (name == "simon") return keys(-0.75);
  if (name == "rifman") return keys(-1);
  if (name == "keys") return keys(a.number("a"));
  if (name == "hermite") {
    return {{0, 1}, [](int, const T& x) { return (T(1.0) - x) * (T(1.0) - x) * (T(1.0) + T(2.0) * x); }};
  }
  if (name == "notch") return bc_form(T(1.5), T(-0.25), 2);
  if (name == "robidoux") return bc_form(T(0.37821575509399867), T(0.31089212245300067), 2);
  if (name == "robidoux-sharp") return bc_form(T(0.2620145123990142), T(0.3689927438004929), 2);
  if (name == "lagrange") return lagrange_form<T>(static_cast<int>(a.integer("order")));
  if (name == "o-moms") return o_moms_form<T>();
  if (name == "cubic-spline") return cubic_spline_form<T>(static_cast<int>(a.integer("lobes")));
  if (name == "magic-kernel-sharp") return magic_form<T>(a.text("version") == "2021");
  if (name == "gaussian") return gaussian_form_of<T>(filter);
  if (name == "radial-gaussian") {
    return gaussian_form<T>(a.number("sigma"), a.number("radius"), a.text("cut") == "offset");
  }
  if (name == "blackman-harris" || name == "radial-blackman-harris") {
    const double r = (none ? a.number("width") : 3) / 2;
    return {{0, r}, [r](int, const T& x) { return cosines(blackman_harris_terms(), x / T(r)); }};
  }
  if (name == "lanczos") {
    const double lobes = none ? a.number("a") : preset_lobes(preset),
                 blur = none ? a.number("blur") : preset_blur(preset);
    return lanczos_form<T>(lobes, blur, lobes * blur);
  }
  if (name == "radial-lanczos") return lanczos_form<T>(a.number("a"), 1, a.number("a"));
  if (name == "pbrt-sinc") return lanczos_form<T>(a.number("tau"), 1, a.number("radius"));
  if (name == "sinc") {
    // The RenderMan specification prints sin(x) / x, without pi.
    if (preset == "renderman") return {{0, 2}, [](int, const T& x) { return sinc_of(x); }};
    const double r = none ? a.number("radius") : preset == "imagemagick" ? 4 : 2;
    return {{0, r}, [](int, const T& x) { return sinc_pi(x); }};
  }
  if (name == "windowed-sinc") {
    const std::string window(a.text("window"));
    if (none) return windowed_sinc_form<T>(window, a.number("radius"), a.number("beta"));
    return windowed_sinc_form<T>(window, window == "welch" || window == "cosine" ? 3 : 4, 6.5);
  }
  if (name == "radial-bc") return radial_bc_form<T>(filter);
  if (name == "jinc") {
    const int lobes = none ? static_cast<int>(a.integer("lobes")) : preset_lobes(preset);
    return jinc_form<T>(jinc_zero(1), jinc_zero(lobes), none ? a.number("blur") : preset_blur(preset));
  }
  throw std::invalid_argument("no form of filter " + std::string(name));
}

}  // namespace moire::stress
