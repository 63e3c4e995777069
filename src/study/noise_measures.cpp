// The measure `spectrum`.
#include "study/noise_measures.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/sum.h"
#include "measure/contrast_sensitivity.h"
#include "measure/radial_spectrum.h"
#include "measure/spectral_peak.h"
#include "measure/spectral_shares.h"

namespace moire {
namespace {

Cell mean_cell(const std::vector<double>& power) {
  if (power.empty()) return {};
  Sum sum;
  for (const double p : power) sum.add(p);
  return finite_cell(sum.value() / static_cast<double>(power.size()));
}

// Signed errors of all pixels, row-major. Pixels without a value of their own are exact.
std::vector<double> dense_error(const Truth& truth, const CaseResult& result) {
  const Grid grid = truth.rows.grid();
  std::vector<double> error(static_cast<std::size_t>(std::int64_t{grid.width} * grid.height));
  std::size_t active = 0;
  for_each_rendered(truth.rows, result.got, [&](int x, int y, Cover cover, double value) {
    const double want = cover == Cover::partial ? truth.exact.value[active++] : cover == Cover::all ? 1.0 : 0.0;
    error[static_cast<std::size_t>(std::int64_t{y} * grid.width + x)] = value - want;
  });
  return error;
}

void set_interval(Row& row, const std::string& name, const std::optional<Interval>& interval) {
  row.set(name + "_lo", interval ? Cell(interval->lo) : Cell());
  row.set(name + "_hi", interval ? Cell(interval->hi) : Cell());
}

}  // namespace

std::int64_t spectrum_bytes(const Study& study, std::uint32_t scene) {
  const Grid grid = study.scenes[scene].image.grid();
  const auto cases = static_cast<std::int64_t>(study.layouts.size() * study.filters.size() * study.estimators.size());
  return cases * grid.width * grid.height * ErrorSpectra::bytes_per_pixel(study.trials);
}

void require_spectra(const Study& study) {
  if (!study.measures.has(Measure::spectrum)) return;
  for (std::uint32_t i = 0; i < study.scenes.size(); ++i) {
    const NamedScene& scene = study.scenes[i];
    const Grid grid = scene.image.grid();
    if (!has_spectrum(grid)) {
      throw Error("measures", fmt::format("scene \"{}\" has {} x {} pixels, too many for a spectrum; give at most {} "
                                          "pixels, and {} to a side, or leave out \"spectrum\"",
                                          scene.name, grid.width, grid.height, kMaxSpectrumPixels, kMaxSpectrumSide));
    }
    if (spectrum_bytes(study, i) > kMaxSpectrumBytes) {
      throw Error("measures",
                  fmt::format("the spectra of scene \"{}\" ({} x {} pixels in {} layouts, {} filters and {} "
                              "estimators, {} bytes per pixel over {} trials) would take {} MiB at once; {} are "
                              "possible: fewer of these, a smaller image, or no \"spectrum\"",
                              scene.name, grid.width, grid.height, study.layouts.size(), study.filters.size(),
                              study.estimators.size(), ErrorSpectra::bytes_per_pixel(study.trials), study.trials,
                              spectrum_bytes(study, i) >> 20, kMaxSpectrumBytes >> 20));
    }
  }
}

void set_spectrum(Row& row, const Spectra& spectra, double pixels_per_degree) {
  row.set("spectrum_window", std::string(name_of(spectra.window)));
  row.set("noise_power", mean_cell(spectra.noise));
  set_interval(row, "noise_power", noise_power_interval(spectra));
  row.set("expected_noise_power", mean_cell(spectra.expected));
  row.set("structured_power", mean_cell(spectra.structured));
  const LowFrequencyRatio low = low_frequency_ratio(spectra);
  row.set("low_frequency_ratio", finite_cell(low.ratio));
  set_interval(row, "low_frequency_ratio", low.interval);
  row.set("low_frequency_noise", finite_cell(low.low));
  set_interval(row, "low_frequency_noise", low.low_interval);
  const StructuredFraction structured = structured_fraction(spectra);
  row.set("structured_fraction", finite_cell(structured.fraction));
  row.set("structured_fraction_error", finite_cell(structured.error));
  row.set("structured_fraction_chance", finite_cell(structured.chance));
  const std::optional<SpectralPeak> peak = strongest_peak(spectra);
  row.set("peak_fx", peak ? Cell(peak->fx) : Cell());
  row.set("peak_fy", peak ? Cell(peak->fy) : Cell());
  row.set("peak_frequency", peak ? Cell(std::hypot(peak->fx, peak->fy)) : Cell());
  row.set("peak_direction", peak ? Cell(peak->direction) : Cell());
  row.set("peak_height_db", peak ? finite_cell(peak->height_db) : Cell());
  row.set("peak_p", peak ? finite_cell(peak->p_value) : Cell());
  row.set("peak_significant", peak && peak->significant ? Cell(*peak->significant) : Cell());
  row.set("csf_rms", finite_cell(csf_weighted_rms(spectra, pixels_per_degree)));
}

Table radial_rows(const Spectra& spectra) {
  Table rows;
  for (const RadialSpectrum& ring : radial_spectrum(spectra)) {
    Row row;
    row.set("frequency", ring.frequency);
    row.set("bins", ring.total.bins);
    row.set("total", finite_cell(ring.total.mean));
    row.set("structured", finite_cell(ring.structured));
    row.set("structured_error", finite_cell(ring.structured_error));
    row.set("noise", finite_cell(ring.noise));
    set_interval(row, "noise", ring.noise_interval);
    row.set("expected", finite_cell(ring.expected));
    row.set("degrees", finite_cell(ring.degrees));
    row.set("anisotropy_db", finite_cell(ring.total.anisotropy_db));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::optional<Spectra> NoiseMeasures::add(const Case& c, std::uint32_t trials, const Truth& truth, CaseResult& result) {
  if (!study_.measures.has(Measure::spectrum)) return std::nullopt;
  const Grid grid = truth.rows.grid();
  const std::tuple key(c.layout, c.scene, c.filter, c.estimator);
  ErrorSpectra& spectra = under_way_.try_emplace(key, grid.width, grid.height, study_.spectrum.window).first->second;
  spectra.add(dense_error(truth, result));
  if (c.trial + 1 < trials) return std::nullopt;
  Spectra finished = spectra.finish(varies(study_, c.scene, c.pattern));
  under_way_.erase(key);
  finished.expected = theory_.of(c);
  set_spectrum(result.row, finished, study_.spectrum.pixels_per_degree);
  return finished;
}

}  // namespace moire
