// Filter metrics as rows.
#include "study/filter_table.h"

#include "measure/radial_metrics.h"

namespace moire {
namespace {

// The cells of either kind of kernel; then its metrics.
template <class K>
FilterMetrics describe_kernel(Row& row, const K& kernel) {
  row.set("radius", kernel.radius());
  row.set("pieces", std::int64_t{kernel.pieces()});
  row.set("degree", std::int64_t{kernel.degree()});
  row.set("kernel_error", kernel.k_error());
  return filter_metrics(kernel);
}

}  // namespace

Table filter_table(std::span<const Filter> filters) {
  Table table;
  for (const Filter& filter : filters) {
    Row row;
    row.set("filter", filter.text());
    const FilterMetrics m =
        filter.is_radial() ? describe_kernel(row, filter.radial_kernel()) : describe_kernel(row, filter.kernel());
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
