#pragma once

#include <string>
#include <vector>

#include "core/tables/columns.hpp"
#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// Point-wise scores of one engine and estimator for one definition of contact; intervals over
/// runs.
struct LabelSensitivity {
  std::string simulator;
  std::string estimator;
  scoring::LabelConfig labels;
  Interval success;
  Interval no_contact_precision;
  Interval no_contact_recall;
};

/// Scores for other definitions of contact: force thresholds of 0.1, 1, 5 and 10 N, each with
/// debounces of 0, 2, 5 and 10 ms. Noise is the first highlighted setting with its first seed.
/// Estimators stay as fitted; only the truth changes. Reads the recordings of the run directory.
/// Errors: `InputError` when one is missing.
std::vector<LabelSensitivity> label_sensitivity(const ExperimentResult& result);

/// The columns of `labels.csv`.
Columns<LabelSensitivity> label_sensitivity_columns();

}  // namespace touchdown::experiments
