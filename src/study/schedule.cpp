// Which cases of a plan are computed, when an earlier run has left rows and images.
#include "study/schedule.h"

#include "study/file_names.h"

namespace moire {

Schedule make_schedule(const Study& study, const std::vector<Case>& cases, const Table& earlier,
                       const Observer& observer) {
  const std::size_t n = cases.size();
  const auto is_finished = [&](std::size_t i) { return i < earlier.size() && !earlier[i].cells().empty(); };
  Schedule s;
  s.due.resize(n);
  s.image.resize(n);
  s.moments.resize(n);
  s.needs_truth.resize(study.scenes.size() * study.filters.size());
  // The trials of a case lie together in the plan.
  for (std::size_t i = 0; i < n;) {
    const std::size_t last = i + trials_of(study, cases[i].scene, cases[i].pattern) - 1;
    const bool spectra = observer.spectra && study.measures.has(Measure::spectrum) && study.images != Images::none &&
                         !(observer.has_spectra && observer.has_spectra(cases[last]));
    const bool whole = !is_finished(last) || spectra;
    for (; i <= last; ++i) {
      const Case& c = cases[i];
      const bool has_image = is_finished(i) && observer.has_case_image && observer.has_case_image(c);
      s.image[i] = observer.case_image && keeps_images(study, c.trial) && !has_image;
      s.moments[i] = whole;
      s.due[i] = whole || !is_finished(i) || s.image[i];
      if (!s.due[i]) continue;
      ++s.due_count;
      s.needs_truth[c.scene * study.filters.size() + c.filter] = true;
    }
  }
  return s;
}

}  // namespace moire
