#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// What odometry makes of the runs of one scene in one engine, told about contact by one source.
struct OdometryRow {
  std::string simulator;
  std::string scene;
  std::string contact;  ///< who tells: "always", "truth", "truth_20ms_late", an estimator
  bool is_oracle = false;
  std::string robot;
  std::string sensors;
  Interval rms;                    ///< m
  Interval error_per_metre;        ///< m/m
  scoring::TrajectoryScore score;  ///< of all runs
  int runs = 0;
  int failed = 0;  ///< of these; nothing is heard of them
};

/// RobotAndSensors by setting, scene by scene, engine by engine; the best first.
std::vector<OdometryRow> odometry_rows(const Evaluation& evaluation);

/// `odometry.csv`.
void write_tables(const std::vector<OdometryRow>& rows, const RunDirectory& directory);

/// The same in short, for people.
std::string odometry_text(const std::vector<OdometryRow>& rows, const Experiment& experiment);

}  // namespace touchdown::experiments
