#pragma once

#include <string>

#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// A result for the terminal: for each engine the highlighted cells and the first estimator's noise
/// grid, then the studies' texts, the scoring conditions, and the runs that were not used.
std::string summary_text(const ExperimentResult& result);

/// One table of the last highlighted cell in all engines, for the end of a long command.
std::string closing_text(const ExperimentResult& result);

}  // namespace touchdown::experiments
