#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/tables/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/evaluation/summary.hpp"

namespace touchdown::experiments {

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

// As CSV tables, every number with its interval.

/// `success.csv` and `classification.csv`: point-wise metrics in every noise cell.
Table success_table(const std::vector<CellSummary>& summaries);
Table classification_table(const std::vector<CellSummary>& summaries);
/// `views.csv`: point-wise metrics per wheel, pooled, and for the robot.
Table views_table(const std::vector<ScoreSummary>& summaries);
/// `transitions.csv`: precision, recall and number of takeoffs and landings.
Table transitions_table(const std::vector<ScoreSummary>& summaries);
/// `latency.csv`: mean and standard deviation over detected events.
Table latency_table(const std::vector<ScoreSummary>& summaries);
/// `calibration.csv` and `reliability.csv`.
Table calibration_table(const std::vector<ScoreSummary>& summaries);
Table reliability_table(const std::vector<ScoreSummary>& summaries);
/// `differences.csv`: one row per pair of estimators and metric.
Table differences_table(const std::vector<Difference>& differences);

}  // namespace touchdown::experiments
