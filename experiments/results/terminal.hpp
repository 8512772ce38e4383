#pragma once

#include <string>

#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// What a terminal shows of a result: for each engine the highlighted cells and the first
/// estimator's noise grid, then what studies say, how it was scored, and which runs were not used.
std::string summary_text(const ExperimentResult& result);

/// The same in one table, the last highlighted cell in all engines, for the end of a long command.
std::string closing_text(const ExperimentResult& result);

}  // namespace touchdown::experiments
