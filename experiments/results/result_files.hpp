#pragma once

#include <string>

#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// Writes what an experiment found out into its run directory: `tables/` and `models/`.
void write_result_files(const ExperimentResult& result);

}  // namespace touchdown::experiments
