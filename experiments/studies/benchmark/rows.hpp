#pragma once

#include <string>
#include <vector>

#include "experiments/studies/benchmark/joint_bootstrap.hpp"
#include "experiments/studies/benchmark/plan.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "scoring/extended_score.hpp"

namespace touchdown::experiments {

/// One estimator in one scene, on one robot with its sensors, in one engine and noise setting; both
/// wheels added.
struct BenchmarkRow {
  std::string simulator;
  std::string robot;
  std::string sensors;
  std::string scene;
  /// Whether scenes like it were fitted, other draws of which are tested here, or none: "test",
  /// "unseen".
  std::string split;
  noise::NoiseCell noise;
  std::string estimator;
  /// Where it was fitted: "own", or the other engine or robot and sensors.
  std::string fitted_on;
  Resampled balanced_accuracy;
  scoring::Score score;
  scoring::ExtendedScore close;
  std::size_t refits = 0;  ///< that were resampled together with the runs
  int runs = 0;            ///< that were played
  int failed = 0;          ///< of these; they are not scored
};

/// By setting, scene, engine, estimator, then noise. A scene without any run to score has no rows.
std::vector<BenchmarkRow> benchmark(const Evaluation& evaluation);

}  // namespace touchdown::experiments
