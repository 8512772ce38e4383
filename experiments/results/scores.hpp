#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/columns.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/evaluation/summary.hpp"
#include "experiments/run_directory/directory.hpp"
#include "noise/sensor_noise.hpp"

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
  Interval balanced_accuracy;
  double always_contact = 0.0;  ///< accuracy of "always contact" in the same runs

  /// Whether "always contact" is at least as accurate.
  bool loses() const { return success.estimate <= always_contact; }
  /// Whether it reports hardly any of the flight.
  bool is_silent() const { return no_contact_recall.estimate < 0.02; }
};

/// A metric of a `CellSummary`, by name. `title` stands in sentences.
struct PointMetric {
  const char* name;
  const char* title;
  Interval CellSummary::*interval;
  double (scoring::Classification::*of)() const;
};
inline constexpr std::array<PointMetric, 6> point_metrics = {{
    {"success", "success rate", &CellSummary::success, &scoring::Classification::success},
    {"contact_precision", "precision of contact", &CellSummary::contact_precision,
     &scoring::Classification::contact_precision},
    {"contact_recall", "recall of contact", &CellSummary::contact_recall,
     &scoring::Classification::contact_recall},
    {"no_contact_precision", "precision of air", &CellSummary::no_contact_precision,
     &scoring::Classification::no_contact_precision},
    {"no_contact_recall", "recall of air", &CellSummary::no_contact_recall,
     &scoring::Classification::no_contact_recall},
    {"balanced_accuracy", "balanced accuracy", &CellSummary::balanced_accuracy,
     &scoring::Classification::balanced_accuracy},
}};

/// The metric that the experiment's heatmaps show.
const PointMetric& mapped_metric(const Experiment& experiment);

/// By condition, then cell.
std::vector<CellSummary> summarise(const std::vector<ConditionCounts>& counts,
                                   const std::vector<noise::NoiseCell>& cells,
                                   const scoring::BootstrapConfig& bootstrap);

/// Writes the tables of these scores: `success.csv` and `classification.csv` (point-wise metrics in
/// every noise cell); of the highlighted ones `ranking.csv`, `views.csv` (per wheel, pooled, and
/// for the robot), `transitions.csv`, `latency.csv` (over detected events), `calibration.csv`,
/// `reliability.csv` and `differences.csv`.
void write_score_tables(const std::vector<CellSummary>& cells,
                        const std::vector<ScoreSummary>& scores,
                        const std::vector<Difference>& differences, const RunDirectory& directory);

}  // namespace touchdown::experiments
