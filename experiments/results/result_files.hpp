#pragma once

#include <string>

#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// Writes an experiment's result into its run directory: `tables/` and `models/`.
void write_result_files(const ExperimentResult& result);

}  // namespace touchdown::experiments
