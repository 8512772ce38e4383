#include "experiments/studies/learning_curve/rows.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/plan/training_data.hpp"
#include "experiments/studies/learning_curve/config.hpp"
#include "experiments/studies/learning_curve/plan.hpp"

namespace touchdown::experiments {

namespace {

using PointsOfRuns = std::vector<scoring::Classification>;

/// The row of one condition and cell; nothing without scored runs.
std::optional<LearningCurveRow> row_of(const std::vector<CollectedCounts>& scenes,
                                       const Condition& first, std::size_t cell,
                                       const scoring::BootstrapConfig& bootstrap) {
  LearningCurveRow row;
  std::vector<Resampled> by_scene;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    const std::vector<PointsOfRuns> sets = points_by_fit(scenes[scene], first, cell);
    if (sets.empty() || sets.front().empty()) continue;
    by_scene.push_back(over_training_sets(sets, scene, bootstrap));
    for (const PointsOfRuns& set : sets) row.points += scoring::sum(set);
    row.draws = static_cast<int>(sets.size());
    row.runs += static_cast<int>(sets.front().size());
  }
  if (by_scene.empty()) return std::nullopt;
  std::vector<SceneValues> pointers;
  for (const Resampled& one : by_scene) pointers.push_back({&one});
  row.balanced_accuracy = interval_of(mean_over_scenes(pointers, bootstrap), bootstrap.level);
  row.simulator = first.test_simulator;
  row.estimator = first.estimator;
  return row;
}

/// The duration of the first training set of every size, by engine and size (s).
std::map<std::pair<std::string, int>, double> labelled_seconds(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const TrainingPieces pieces = training_pieces(evaluation.runs, experiment);
  std::map<std::pair<std::string, int>, double> seconds;
  for (const int size : experiment.studies.at<LearningCurveConfig>().sizes) {
    const auto set = training_set(pieces.runs, static_cast<std::size_t>(size));
    for (const RunSignals* run : set) {
      seconds[{run->info.simulator, size}] += used_seconds(*run, pieces.skip);
    }
  }
  return seconds;
}

}  // namespace

Resampled over_training_sets(const std::vector<std::vector<scoring::Classification>>& sets,
                             std::uint64_t scene, const scoring::BootstrapConfig& bootstrap) {
  Resampled result = balanced_accuracy_of_fits(sets, scene, bootstrap);
  result.estimate = 0.0;
  for (const PointsOfRuns& set : sets) {
    result.estimate += scoring::sum(set).balanced_accuracy() / static_cast<double>(sets.size());
  }
  return result;
}

std::vector<LearningCurveRow> learning_curve_rows(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const std::size_t group = evaluation.plan.group_called(learning_curve_name).value();
  const std::vector<CollectedCounts> scenes = counts_by_scene(evaluation, group);
  const auto seconds = labelled_seconds(evaluation);
  std::vector<LearningCurveRow> rows;
  for (const Condition& condition : evaluation.plan.groups[group].conditions) {
    if (condition.refit > 0) continue;
    const int size = static_cast<int>(evaluation.plan.training_sets.at(condition.fit));
    for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
      std::optional<LearningCurveRow> row =
          row_of(scenes, condition, cell, experiment.intervals.bootstrap);
      if (!row) continue;
      row->noise = experiment.highlights[cell];
      row->size = size;
      row->labelled = seconds.at({condition.fit_simulator, size});
      rows.push_back(*std::move(row));
    }
  }
  return rows;
}

}  // namespace touchdown::experiments
