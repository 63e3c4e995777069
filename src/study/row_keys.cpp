// Which case a row is of.
#include "study/row_keys.h"

#include <fmt/format.h>

namespace moire {

std::string image_row_key(const Row& row) {
  return fmt::format("{} {} {:.0f} {} {} {:.0f}{}", row.text("scene"), row.text("pattern"), row.number("spp"),
                     row.text("filter"), row.text("estimator"), row.number("trial"),
                     row.text("layout") == "image" ? " image" : "");
}

std::string set_row_key(const Row& row) {
  return fmt::format("{} {:.0f} {:.0f} {} {:.0f}", row.text("pattern"), row.number("n"), row.number("dims"),
                     row.text("measure"), row.number("trial"));
}

bool is_set_row(const Row& row) { return row.find("measure") != nullptr; }

}  // namespace moire
