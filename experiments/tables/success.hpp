#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/listening/tasks.hpp"
#include "experiments/plan/condition.hpp"

namespace touchdown::experiments {

/// What one condition achieved in one noise cell, with intervals over runs or drops.
struct CellSummary {
  Condition condition;
  noise::NoiseCell cell;
  Interval success;
  Interval contact_precision;
  Interval contact_recall;
  Interval no_contact_precision;
  Interval no_contact_recall;
  double always_contact = 0.0;  ///< success rate of "always contact" in the same runs

  /// Whether one does no worse with "always contact".
  bool loses() const { return success.estimate <= always_contact; }
};

/// By condition, then cell.
std::vector<CellSummary> summarise(const std::vector<ConditionCounts>& counts,
                                   const std::vector<noise::NoiseCell>& cells,
                                   const scoring::BootstrapConfig& bootstrap);

/// `tables/success.csv` and `tables/classification.csv`.
Table success_table(const std::vector<CellSummary>& summaries);
Table classification_table(const std::vector<CellSummary>& summaries);

/// For the terminal: every estimator of one engine in one cell.
Table cell_text_table(const std::vector<CellSummary>& summaries, const std::string& simulator,
                      const noise::NoiseCell& cell);

/// For the terminal: one estimator's success rate over the noise grid.
Table grid_text_table(const std::vector<CellSummary>& summaries, const std::string& simulator,
                      const std::string& estimator, const noise::NoiseGridConfig& noise);

}  // namespace touchdown::experiments
