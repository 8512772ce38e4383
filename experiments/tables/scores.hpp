#pragma once

#include <vector>

#include "core/table.hpp"
#include "experiments/listening/summary.hpp"

namespace touchdown::experiments {

/// Full scores as CSV tables, every number with its interval.
/// `views.csv`: point-wise metrics per wheel, pooled, and for the robot.
Table views_table(const std::vector<ScoreSummary>& summaries);
/// `transitions.csv`: precision and recall of takeoffs and landings, and how many there were.
Table transitions_table(const std::vector<ScoreSummary>& summaries);
/// `latency.csv`: mean and standard deviation over detected events.
Table latency_table(const std::vector<ScoreSummary>& summaries);
/// `calibration.csv` and `reliability.csv`.
Table calibration_table(const std::vector<ScoreSummary>& summaries);
Table reliability_table(const std::vector<ScoreSummary>& summaries);
/// `differences.csv`: one row per pair of estimators and metric.
Table differences_table(const std::vector<Difference>& differences);

}  // namespace touchdown::experiments
