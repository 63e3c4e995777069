// The measure `spectrum`.
#include "study/noise_measures.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

std::string_view name_of(SpectrumWindow window) { return window == SpectrumWindow::hann ? "hann" : "none"; }

}  // namespace

void set_spectrum(Row& row, const Spectra& spectra, double pixels_per_degree) {
  row.set("spectrum_window", std::string(name_of(spectra.window)));
  row.set("noise_power", mean_cell(spectra.noise));
  row.set("structured_power", mean_cell(spectra.structured));
  const LowFrequencyRatio low = low_frequency_ratio(spectra);
  row.set("low_frequency_ratio", finite_cell(low.ratio));
  row.set("low_frequency_ratio_lo", low.interval ? Cell(low.interval->lo) : Cell());
  row.set("low_frequency_ratio_hi", low.interval ? Cell(low.interval->hi) : Cell());
  const double* noise = std::get_if<double>(row.find("noise_power"));
  row.set("low_frequency_noise", noise != nullptr ? finite_cell(low.ratio * *noise) : Cell());
  const StructuredFraction structured = structured_fraction(spectra);
  row.set("structured_fraction", finite_cell(structured.fraction));
  row.set("structured_fraction_error", finite_cell(structured.error));
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
    row.set("noise_lo", ring.noise_interval ? Cell(ring.noise_interval->lo) : Cell());
    row.set("noise_hi", ring.noise_interval ? Cell(ring.noise_interval->hi) : Cell());
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
  Spectra finished = spectra.finish(study_.patterns[c.pattern].varies());
  under_way_.erase(key);
  set_spectrum(result.row, finished, study_.spectrum.pixels_per_degree);
  return finished;
}

}  // namespace moire
