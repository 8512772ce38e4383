#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// Robot and sensors of an experiment, for tables without such columns.
struct ResultSetup {
  std::string robot;  ///< empty: the test scenarios have several
  std::string sensors;
};

/// The unit that a metric's name ends with: "ms" for `takeoff_latency_ms`, "1/min" for
/// `false_takeoffs_per_minute`; empty for pure numbers.
std::string unit_of(const std::string& metric);

/// The columns of `results.csv`, which has a row per measured number of every table. `study` is the
/// table, without `.csv`; `estimator` may be a contact source; `noise` is "1 N·m, 5 m/s²"; `metric`
/// is the column, or "difference_of_success" if a key names the metric; `n` is the number of runs;
/// `setting` has the other keys: "policy=soft_landing; value=0.7".
inline const std::vector<std::string> long_header = {
    "study",  "simulator", "robot", "sensors",  "scene", "estimator", "noise",
    "metric", "unit",      "n",     "estimate", "low",   "high",      "setting"};

/// The numbers of one line of a table as rows of `results.csv`, metric by metric. Cells are empty
/// where the table has none.
std::vector<std::vector<std::string>> long_rows(const std::string& study, const Table& table,
                                                std::size_t line, const ResultSetup& setup);

/// Writes `results.csv` from all tables of the run directory with described columns, by name.
void write_results(const RunRequest& request, const RunDirectory& directory);

}  // namespace touchdown::experiments
