#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/benchmark/plan.hpp"
#include "experiments/listening/tasks.hpp"
#include "experiments/run_directory/directory.hpp"
#include "scoring/close_score.hpp"

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
  Interval balanced_accuracy;
  scoring::Score score;
  scoring::CloseScore close;
  int runs = 0;    ///< that were played
  int failed = 0;  ///< of these; they are not scored
};

/// By setting, scene, engine, estimator, then noise. A scene without any run to score has no rows.
std::vector<BenchmarkRow> benchmark(const Listened& listened);

/// `benchmark.csv`, and where measurement models were fitted, `density_overlap.csv`: how much the
/// densities of every two robots and sensors have in common, ∫ min(p, q), in contact and in the
/// air.
void write_tables(const std::vector<BenchmarkRow>& rows, const FittedModels& models,
                  const Listened& listened, const RunDirectory& directory);

/// For people: balanced accuracy of every estimator by scene, a table for every setting, engine and
/// noise.
std::string benchmark_text(const std::vector<BenchmarkRow>& rows, const Experiment& experiment);

}  // namespace touchdown::experiments
