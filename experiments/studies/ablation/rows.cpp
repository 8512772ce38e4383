#include "experiments/studies/ablation/rows.hpp"

#include <utility>

#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/studies/ablation/config.hpp"

namespace touchdown::experiments {

namespace {

struct Step {
  Resampled balanced_accuracy;
  int runs = 0;
};

/// The mean of one estimator over scenes and engines with scored runs.
Step step_of(const std::vector<CollectedCounts>& scenes, const std::string& estimator,
             std::size_t cell, const Experiment& experiment) {
  Step step;
  std::vector<std::vector<Resampled>> by_scene;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    std::vector<Resampled> of_engines;
    for (const std::string& simulator : experiment.simulators) {
      const FitsAndRuns scores =
          fits_and_runs(points_by_fit(scenes[scene], {simulator, simulator, estimator}, cell));
      if (scores.runs.empty()) continue;
      of_engines.push_back(balanced_accuracy(scores, stream_of(scene, simulator, experiment),
                                             experiment.intervals.bootstrap));
      step.runs += static_cast<int>(scores.runs.size());
    }
    if (!of_engines.empty()) by_scene.push_back(std::move(of_engines));
  }
  std::vector<SceneValues> pointers;
  for (const std::vector<Resampled>& of_engines : by_scene) {
    SceneValues& values = pointers.emplace_back();
    for (const Resampled& one : of_engines) values.push_back(&one);
  }
  step.balanced_accuracy = mean_over_scenes(pointers, experiment.intervals.bootstrap);
  return step;
}

}  // namespace

std::vector<AblationRow> ablation_rows(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const double level = experiment.intervals.bootstrap.level;
  const std::vector<CollectedCounts> scenes = counts_by_scene(evaluation, 0);
  std::vector<AblationRow> rows;
  for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
    std::string name_before;
    Step before;
    for (const std::string& estimator :
         steps_of(experiment.studies.at<AblationConfig>(), experiment.estimators)) {
      Step step = step_of(scenes, estimator, cell, experiment);
      AblationRow row{experiment.highlights[cell],
                      estimator,
                      interval_of(step.balanced_accuracy, level),
                      name_before,
                      {},
                      step.runs};
      if (!name_before.empty()) {
        row.gain = interval_of(step.balanced_accuracy - before.balanced_accuracy, level);
      }
      rows.push_back(std::move(row));
      name_before = estimator;
      before = std::move(step);
    }
  }
  return rows;
}

}  // namespace touchdown::experiments
