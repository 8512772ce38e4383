#pragma once

#include <string>
#include <vector>

#include "core/columns.hpp"
#include "experiments/plan/request.hpp"

namespace touchdown::experiments {

/// One measured number of one table: a row of `results.csv`, as texts. Texts are empty where the
/// table has none.
struct ResultRow {
  std::string study;  ///< the table, without `.csv`
  std::string simulator;
  std::string robot;
  std::string sensors;
  std::string scene;
  std::string estimator;  ///< or the contact source
  std::string noise;      ///< "1 N·m, 5 m/s²"
  std::string metric;     ///< the column; "difference_of_success" if a key names the metric
  std::string unit;
  std::string n;  ///< number of runs
  std::string estimate;
  std::string low;
  std::string high;
  std::string setting;  ///< the other keys: "policy=soft_landing; value=0.7"
};

/// Robot and sensors of an experiment, for tables without such columns.
struct ResultSetup {
  std::string robot;  ///< empty: the test scenarios have several
  std::string sensors;
};

/// The unit that a metric's name ends with: "ms" for `takeoff_latency_ms`, "1/min" for
/// `false_takeoffs_per_minute`; empty for pure numbers.
std::string unit_of(const std::string& metric);

/// A table as rows with one number each: row by row, metric by metric. `columns` describe the
/// table.
std::vector<ResultRow> long_rows(const std::string& study, const Table& table,
                                 const std::vector<ColumnInfo>& columns, const ResultSetup& setup);

/// Writes `results.csv` from all tables of the run directory with described columns, by name.
void write_results(const RunRequest& request, const RunDirectory& directory);

}  // namespace touchdown::experiments
