#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// The scores of odometry in one scene and engine, with one contact source.
struct OdometryRow {
  std::string simulator;
  std::string scene;
  std::string contact;  ///< the source: "always", "truth", "truth_delayed_20ms", an estimator
  bool is_oracle = false;
  std::string robot;
  std::string sensors;
  Interval rms;                    ///< m
  Interval error_per_metre;        ///< m/m
  scoring::TrajectoryScore score;  ///< of all runs
  int runs = 0;
  int failed = 0;  ///< of these; not scored
};

/// Setup by setup, scene by scene, engine by engine; the best first.
std::vector<OdometryRow> odometry_rows(const Evaluation& evaluation);

/// Writes `odometry.csv`.
void write_tables(const std::vector<OdometryRow>& rows, const RunDirectory& directory);

/// A summary for the terminal.
std::string odometry_text(const std::vector<OdometryRow>& rows, const Experiment& experiment);

}  // namespace touchdown::experiments
