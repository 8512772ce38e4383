#include "render/studies/registry.hpp"

#include "experiments/results/result_files.hpp"

namespace touchdown::render {

const std::vector<StudyPictures>& study_pictures() {
  static const std::vector<StudyPictures> all = {cross_simulator_pictures(), benchmark_pictures(),
                                                 moments_pictures(), closed_loop_pictures()};
  return all;
}

void draw_and_report(experiments::ExperimentResult& result, bool with_films,
                     const std::atomic<bool>* stop) {
  const auto subject = [&] {
    ReportSubject read = read_subject(result.directory.path());
    // Estimators written in Python can be run here, if Python runs the experiment.
    read.experiment.external_estimators = result.experiment.external_estimators;
    return read;
  };
  std::vector<FilmedRun> filmed;
  if (result.experiment.video.enabled) filmed = filmed_runs(subject());
  draw_pictures(result, filmed, study_pictures(), with_films, stop);
  experiments::write_manifest(result);
  make_report(subject(), filmed, study_pictures(), {.film = with_films});
}

}  // namespace touchdown::render
