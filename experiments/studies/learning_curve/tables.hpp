#pragma once

#include <string>
#include <vector>

#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/learning_curve/rows.hpp"

namespace touchdown::experiments {

/// Writes `learning_curve.csv`.
void write_tables(const std::vector<LearningCurveRow>& rows, const RunDirectory& directory);

/// A summary for the terminal: a table for every engine and noise setting.
std::string learning_curve_text(const std::vector<LearningCurveRow>& rows,
                                const Experiment& experiment);

}  // namespace touchdown::experiments
