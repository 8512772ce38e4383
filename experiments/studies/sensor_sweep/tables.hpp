#pragma once

#include <string>
#include <vector>

#include "experiments/evaluation/summary.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/sensor_sweep/plan.hpp"

namespace touchdown::experiments {

/// What every estimator makes of one value, both wheels added, engine by engine.
struct SensorSweepPoint {
  SensorVariation variation;
  std::vector<ScoreSummary> scores;
};

/// In the order of `sensor_variations`.
std::vector<SensorSweepPoint> sensor_sweep(const Evaluation& evaluation);

/// `sensor_sweep.csv`.
void write_tables(const std::vector<SensorSweepPoint>& points, const RunDirectory& directory);

/// The same in short, for people: a table for every disturbance and engine.
std::string sensor_sweep_text(const std::vector<SensorSweepPoint>& points,
                              const Experiment& experiment);

}  // namespace touchdown::experiments
