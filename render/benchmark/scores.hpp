#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/interval.hpp"

namespace touchdown::render {

/// One row of a run directory's `benchmark.csv`: an in-domain score in one scene.
struct SceneScore {
  std::string simulator;
  std::string setting;  ///< "upkie, harsh sensors"
  std::string noise;    ///< "1 N·m, 5 m/s²"
  std::string scene;
  std::string estimator;
  bool is_unseen = false;  ///< no estimator was fitted to scenes like it
  Interval accuracy;
  double no_contact_precision = 0.0;
  double no_contact_recall = 0.0;
  double flight_f1 = 0.0;
  double extra_switches_per_minute = 0.0;
  double false_takeoffs_per_minute = 0.0;
  double takeoff_latency_median_ms = 0.0;
};

/// One row of `benchmark_standings.csv`.
struct Standing {
  std::string setting;
  std::string robot;
  std::string sensors;
  std::string noise;
  std::string estimator;
  Interval mean;
  double worst = 0.0;
  std::string worst_scene;
  std::string worst_simulator;
  bool is_not_significantly_worse = false;
  double excess_log_loss = 0.0;  ///< above the reference upper bound's (bits per wheel and step)
};

/// One row of `benchmark_differences.csv`. Without a scene, it is the difference of the means over
/// all scenes.
struct PairedBand {
  std::string setting;
  std::string noise;
  std::string scene;
  std::string first;
  std::string second;
  Interval difference;
};

/// A benchmark's results, read from its tables.
struct BenchmarkScores {
  std::vector<SceneScore> scenes;
  std::vector<Standing> standings;
  std::vector<PairedBand> pairs;
};

/// Empty where the run directory has no such tables. Errors: `InputError` for unreadable ones.
BenchmarkScores benchmark_scores(const std::filesystem::path& run_directory);

/// The distinct values of `name` over the rows, in the order of the rows.
template <typename Rows, typename Name>
std::vector<std::string> names(const Rows& rows, const Name& name) {
  std::vector<std::string> all;
  for (const auto& row : rows) {
    const std::string one = name(row);
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  }
  return all;
}

}  // namespace touchdown::render
