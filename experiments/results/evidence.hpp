#pragma once

#include <string>
#include <vector>

#include "core/tables/columns.hpp"
#include "experiments/estimators/fitted_model.hpp"

namespace touchdown::experiments {

/// The value of one evidence curve at one of its knots.
struct EvidencePoint {
  std::string simulator = {};
  std::string estimator = {};
  std::string targets = {};  ///< `targets_of` the set of curves
  std::string channel = {};
  std::string scale = {};  ///< ms; empty for noise levels
  std::string unit = {};   ///< of the value
  double value = 0.0;
  double evidence = 0.0;  ///< nats
};

/// All curves of models that have any, in the units of their channels. The range is that of the
/// fitted rows without the outermost two in a thousand.
std::vector<EvidencePoint> evidence_points(const FittedModels& models);

/// The columns of `evidence.csv`.
Columns<EvidencePoint> evidence_columns();

}  // namespace touchdown::experiments
