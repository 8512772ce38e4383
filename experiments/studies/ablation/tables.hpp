#pragma once

#include <string>
#include <vector>

#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/ablation/rows.hpp"

namespace touchdown::experiments {

/// Writes `ablation.csv`.
void write_tables(const std::vector<AblationRow>& rows, const RunDirectory& directory);

/// A summary for the terminal: balanced accuracy and gain of every step.
std::string ablation_text(const std::vector<AblationRow>& rows, const Experiment& experiment);

}  // namespace touchdown::experiments
