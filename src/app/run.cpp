// moire run: a study's results, pictures and report.
#include "app/commands.h"
#include "app/run_discrepancies.h"
#include "app/run_images.h"
#include "app/studies.h"

namespace moire {

Exit execute(const RunOptions& options) {
  return std::visit([&](const auto& study) { return run_study(options, study); }, load_study(options.study));
}

}  // namespace moire
