#pragma once

#include <string>
#include <vector>

#include "core/columns.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// Measures decisions against other definitions of contact: force thresholds of 0.1, 1, 5 and 10 N,
/// each with debounces of 0, 2, 5 and 10 ms. Estimators stay as fitted, only the truth changes. It
/// measures in-domain predictions at the first highlighted noise setting with the first noise
/// realisation; a score is of type `scoring::Classification`, both wheels added.
Measure label_measure();

/// Point-wise scores of one estimator in one engine by one definition, with intervals over runs.
struct LabelRow {
  std::string simulator;
  std::string estimator;
  scoring::LabelConfig labels;
  Interval success;
  Interval no_contact_precision;
  Interval no_contact_recall;
};

/// By engine, estimator, definition.
std::vector<LabelRow> label_rows(const Evaluation& evaluation);

/// The columns of `labels.csv`.
Columns<LabelRow> label_columns();

}  // namespace touchdown::experiments
