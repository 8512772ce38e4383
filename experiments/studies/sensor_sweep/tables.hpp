#pragma once

#include <string>
#include <vector>

#include "experiments/evaluation/summary.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/sensor_sweep/plan.hpp"

namespace touchdown::experiments {

/// The scores of all estimators for one value, both wheels added, by engine.
struct SensorSweepPoint {
  SensorVariation variation;
  std::vector<ScoreSummary> scores;
};

/// Points in the order of `sensor_variations`.
std::vector<SensorSweepPoint> sensor_sweep(const Evaluation& evaluation);

/// Writes `sensor_sweep.csv`.
void write_tables(const std::vector<SensorSweepPoint>& points, const RunDirectory& directory);

/// A summary for the terminal: a table for every disturbance and engine.
std::string sensor_sweep_text(const std::vector<SensorSweepPoint>& points,
                              const Experiment& experiment);

}  // namespace touchdown::experiments
