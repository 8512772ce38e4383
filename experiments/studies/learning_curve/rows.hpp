#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

/// One estimator, fitted to training sets of one size, in one engine and noise setting.
struct LearningCurveRow {
  std::string simulator;
  noise::NoiseCell noise;
  std::string estimator;
  int size = 0;           ///< segments or runs
  double labelled = 0.0;  ///< duration of the first set (s)
  /// The mean over scenes and training sets. Its interval covers the choice of scenes, and of one
  /// training set.
  Interval balanced_accuracy;
  scoring::Classification points;  ///< over all scenes and training sets
  int draws = 0;                   ///< training sets
  int runs = 0;                    ///< scored test runs
};

/// The balanced accuracy of one scene, with the counts of every training set in the same runs.
Resampled over_training_sets(const std::vector<std::vector<scoring::Classification>>& sets,
                             std::uint64_t scene, const scoring::BootstrapConfig& bootstrap);

/// Rows by engine, estimator, size, then noise. A condition without scored runs has no rows.
std::vector<LearningCurveRow> learning_curve_rows(const Evaluation& evaluation);

}  // namespace touchdown::experiments
