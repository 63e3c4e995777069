// Filter metrics as rows.
#include "study/filter_table.h"

#include "measure/filter_metrics.h"

namespace moire {

Table filter_table(std::span<const Filter> filters) {
  Table table;
  for (const Filter& filter : filters) {
    const Kernel& kernel = filter.kernel();
    const FilterMetrics m = filter_metrics(kernel);
    Row row;
    row.set("filter", filter.text());
    row.set("radius", m.radius);
    row.set("pieces", std::int64_t{kernel.pieces()});
    row.set("degree", std::int64_t{kernel.degree()});
    row.set("kernel_error", kernel.k_error());
    row.set("integral", m.integral);
    row.set("ripple", m.ripple);
    row.set("mean", m.mean);
    row.set("variance", m.variance);
    row.set("nyquist_response", m.nyquist_response);
    row.set("l1_gain", m.l1_gain);
    row.set("overshoot_percent", m.overshoot_percent);
    row.set("smoothing", m.smoothing);
    row.set("postaliasing", m.postaliasing);
    row.set("noise_gain_1d", m.noise_gain_1d);
    row.set("noise_gain", m.noise_gain);
    row.set("edge_alias_energy", m.edge_alias_energy);
    row.set("anisotropy", m.anisotropy);
    table.push_back(std::move(row));
  }
  return table;
}

}  // namespace moire
