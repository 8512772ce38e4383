#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/studies/benchmark/plan.hpp"
#include "scoring/extended_score.hpp"

namespace touchdown::experiments {

/// One estimator in one scene, on one robot with its sensors, in one engine and noise setting; both
/// wheels added.
struct BenchmarkRow {
  std::string simulator;
  std::string robot;
  std::string sensors;
  std::string scene;
  /// "test": other draws of this scene are in the fit; "unseen": none are.
  std::string split;
  noise::NoiseCell noise;
  std::string estimator;
  /// Where the estimator was fitted: "own", or the name of another engine or setup.
  std::string fitted_on;
  Resampled balanced_accuracy;
  scoring::Score score;
  scoring::ExtendedScore extended;
  std::size_t refits = 0;  ///< resampled together with the runs
  int runs = 0;            ///< simulated
  int failed = 0;          ///< of these; not scored

  bool is_scored() const { return !std::isnan(balanced_accuracy.estimate); }
};

/// Extra switches per minute and wheel; NaN without scored time.
double extra_switches_per_minute(const BenchmarkRow& row);

/// Rows by setup, scene, engine, estimator, then noise. If every run of a scene failed, its scores
/// are NaN.
std::vector<BenchmarkRow> benchmark(const Evaluation& evaluation);

}  // namespace touchdown::experiments
