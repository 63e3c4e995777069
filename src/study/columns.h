// Columns that more than one room writes or reads, and the rules behind them, said once.
#pragma once

#include <string>
#include <string_view>

#include "measure/error.h"
#include "study/results.h"

namespace moire {

// Sets <field>_<region> for every field of Errors, e.g. rmse_active. Values that do not exist are empty cells.
void set_errors(Row& row, std::string_view region, const Errors& errors);

// The same for n_pixels, bias, mse, rmse and max_abs alone.
void set_main_errors(Row& row, std::string_view region, const Errors& errors);

// What a row's samples are called in tables: the pattern, and the layout where it is not `pixel`.
std::string sampler_of(const Row& row);

// The columns of the measure `spectrum` (noise_measures.h), which stand in the last trial's row.
inline constexpr std::string_view kSpectrumColumns[] = {"spectrum_window",
                                                        "noise_power",
                                                        "noise_power_lo",
                                                        "noise_power_hi",
                                                        "expected_noise_power",
                                                        "structured_power",
                                                        "low_frequency_ratio",
                                                        "low_frequency_ratio_lo",
                                                        "low_frequency_ratio_hi",
                                                        "low_frequency_noise",
                                                        "low_frequency_noise_lo",
                                                        "low_frequency_noise_hi",
                                                        "structured_fraction",
                                                        "structured_fraction_error",
                                                        "structured_fraction_chance",
                                                        "peak_fx",
                                                        "peak_fy",
                                                        "peak_frequency",
                                                        "peak_direction",
                                                        "peak_height_db",
                                                        "peak_p",
                                                        "peak_significant",
                                                        "csf_rms"};

// True where an error is so small that the reference's own bound (absolute, guaranteed) may show in it.
constexpr bool reference_limited(double rmse, double error_bound) { return rmse < 10 * error_bound; }

}  // namespace moire
