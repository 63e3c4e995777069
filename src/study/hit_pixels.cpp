// The measure `edge-ratio`.
#include "study/hit_pixels.h"

#include <vector>

#include "core/parallel.h"
#include "core/sum.h"
#include "measure/discrepancy/edge_l2.h"

namespace moire {

bool has_edge_ratio(const Study& study, const Case& c) {
  if (study.filters[c.filter].is_radial()) return false;
  const Kernel& kernel = study.filters[c.filter].kernel();
  const bool own_samples = kernel.degree() == 0 && kernel.pieces() == 1 && kernel.radius() == 0.5;
  const TestImage& scene = study.scenes[c.scene].image;
  return own_samples && scene.info().name == "edge" && !scene.moves() &&
         (study.layouts[c.layout] == Layout::pixel || study.estimators[c.estimator].value == Estimator::ratio);
}

HitPixels hit_pixels(const Truth& truth, const CaseResult& result, Samples samples, bool same_samples) {
  struct Sums {
    std::int64_t count = 0;
    Sum squares, discrepancies;
  };
  const ActiveRows& rows = truth.rows;
  std::vector<Sums> of_row(static_cast<std::size_t>(rows.grid().height));
  double same = -1;
  if (same_samples) {
    RowSamples first;
    samples.get(0, 1, 0, first);
    same = edge_l2_squared({first.x, first.y}, LineLaw::isotropic);
  }
  parallel_for(of_row.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    auto index = static_cast<std::size_t>(rows.first_active(y));
    RowSamples own;
    for (const Run& run : rows.row(y)) {
      if (run.cover != Cover::partial) continue;
      for (std::int32_t x = run.x0; x < run.x1; ++x, ++index) {
        const double exact = truth.exact.value[index], bound = truth.exact.bound[index];
        if (!(exact > bound && exact < 1 - bound)) continue;  // touched, or hit by less than can be told
        double discrepancy = same;
        if (!same_samples) {
          samples.get(x, x + 1, y, own);
          if (own.x.empty()) continue;
          discrepancy = edge_l2_squared({own.x, own.y}, LineLaw::isotropic);
        }
        Sums& sums = of_row[row];
        ++sums.count;
        sums.squares.add(result.error[index] * result.error[index]);
        sums.discrepancies.add(discrepancy);
      }
    }
  });
  HitPixels hit;
  Sum squares, discrepancies;
  for (const Sums& sums : of_row) {
    hit.count += sums.count;
    squares.add(sums.squares.value());
    discrepancies.add(sums.discrepancies.value());
  }
  hit.mse = squares.value() / static_cast<double>(hit.count);
  hit.discrepancy_square = discrepancies.value() / static_cast<double>(hit.count);
  return hit;
}

void set_hit_pixels(Row& row, const HitPixels& hit) {
  row.set("hit_pixels", hit.count);
  row.set("hit_mse", hit.count > 0 ? finite_cell(hit.mse) : Cell());
  row.set("hit_edge_l2_sq", hit.count > 0 ? finite_cell(hit.discrepancy_square) : Cell());
}

}  // namespace moire
