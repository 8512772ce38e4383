#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/columns.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/evaluation/summary.hpp"
#include "noise/grid.hpp"

namespace touchdown::experiments {

/// The columns of a noise setting: `torque_noise_nm`, `accelerometer_noise_mps2`.
Columns<noise::NoiseCell> noise_columns();

/// The separate levels of a setting, for tables of the knee × wheel grid: `knee_noise_nm`,
/// `wheel_noise_nm`.
Columns<noise::NoiseCell> knee_wheel_columns();

/// Scores of one condition in one noise cell, with intervals over runs or drops.
struct CellSummary {
  Condition condition;
  noise::NoiseCell cell;
  Interval success;  ///< accuracy
  Interval contact_precision;
  Interval contact_recall;
  Interval no_contact_precision;
  Interval no_contact_recall;
  double always_contact = 0.0;  ///< accuracy of "always contact" in the same runs

  /// Whether "always contact" is at least as accurate.
  bool loses() const { return success.estimate <= always_contact; }
};

/// A metric of a `CellSummary`, by name.
struct PointMetric {
  const char* name;
  Interval CellSummary::*interval;
  double (scoring::Classification::*of)() const;
};
inline constexpr std::array<PointMetric, 5> point_metrics = {{
    {"success", &CellSummary::success, &scoring::Classification::success},
    {"contact_precision", &CellSummary::contact_precision,
     &scoring::Classification::contact_precision},
    {"contact_recall", &CellSummary::contact_recall, &scoring::Classification::contact_recall},
    {"no_contact_precision", &CellSummary::no_contact_precision,
     &scoring::Classification::no_contact_precision},
    {"no_contact_recall", &CellSummary::no_contact_recall,
     &scoring::Classification::no_contact_recall},
}};

/// By condition, then cell.
std::vector<CellSummary> summarise(const std::vector<ConditionCounts>& counts,
                                   const std::vector<noise::NoiseCell>& cells,
                                   const scoring::BootstrapConfig& bootstrap);

/// The columns of `success.csv` and `classification.csv`: point-wise metrics in every noise cell.
Columns<CellSummary> success_columns();
Columns<CellSummary> classification_columns();
/// `views.csv`: point-wise metrics per wheel, pooled, and for the robot.
Columns<ScoreSummary> views_columns();
/// `transitions.csv`: precision, recall and number of takeoffs and landings.
Columns<ScoreSummary> transitions_columns();
/// `latency.csv`: mean and standard deviation over detected events.
Columns<ScoreSummary> latency_columns();
/// `calibration.csv`.
Columns<ScoreSummary> calibration_columns();

/// `reliability.csv`: a row per bin of the calibration. The summaries must outlive the bins.
struct ReliabilityBin {
  const ScoreSummary* summary = nullptr;
  std::size_t index = 0;
};
std::vector<ReliabilityBin> reliability_bins(const std::vector<ScoreSummary>& summaries);
Columns<ReliabilityBin> reliability_columns();

/// `differences.csv`: a row per pair of estimators and metric. The differences must outlive it.
struct MetricDifference {
  const Difference* pair = nullptr;
  std::size_t metric = 0;  ///< in the order of `metrics()`
};
std::vector<MetricDifference> metric_differences(const std::vector<Difference>& differences);
Columns<MetricDifference> difference_columns();

}  // namespace touchdown::experiments
