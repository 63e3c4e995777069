// Columns that more than one room writes or reads.
#include "study/columns.h"

#include <cmath>
#include <string>

namespace moire {
namespace {

// Sets <field>_<region>.
class Setter {
 public:
  Setter(Row& row, std::string_view region) : row_(row), ending_("_" + std::string(region)) {}
  void operator()(std::string_view field, Cell value) const {
    row_.set(std::string(field) + ending_, std::move(value));
  }

 private:
  Row& row_;
  std::string ending_;
};

}  // namespace

std::string sampler_of(const Row& row) {
  const std::string_view layout = row.text("layout");
  return std::string(row.text("pattern")) +
         (layout.empty() || layout == "pixel" ? "" : ", layout=" + std::string(layout));
}

void set_main_errors(Row& row, std::string_view region, const Errors& errors) {
  const Setter set(row, region);
  set("n_pixels", errors.n_pixels);
  set("bias", finite_cell(errors.bias));
  set("mse", finite_cell(errors.mse));
  set("rmse", finite_cell(errors.rmse));
  set("max_abs", finite_cell(errors.max_abs));
}

void set_errors(Row& row, std::string_view region, const Errors& errors) {
  const Setter set(row, region);
  const bool wrong = errors.max_x >= 0;
  set("n_pixels", errors.n_pixels);
  set("bias", finite_cell(errors.bias));
  set("mae", finite_cell(errors.mae));
  set("mse", finite_cell(errors.mse));
  set("rmse", finite_cell(errors.rmse));
  set("max_abs", finite_cell(errors.max_abs));
  set("max_x", wrong ? Cell(errors.max_x) : Cell());
  set("max_y", wrong ? Cell(errors.max_y) : Cell());
  set("max_got", finite_cell(errors.max_got));
  set("max_want", finite_cell(errors.max_want));
  set("p50", finite_cell(errors.p50));
  set("p90", finite_cell(errors.p90));
  set("p95", finite_cell(errors.p95));
  set("p99", finite_cell(errors.p99));
  set("p995", finite_cell(errors.p995));
  set("nan_count", errors.nan_count);
  set("outside_tolerance", errors.outside_tolerance);
}

}  // namespace moire
