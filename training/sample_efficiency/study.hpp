#pragma once

#include <filesystem>

#include "training/config/sample_efficiency.hpp"
#include "training/train.hpp"

namespace touchdown::training {

/// Trains, fits and tests with every amount of data. Writes `tables/sample_efficiency.csv` and the
/// figure `figures/sample_efficiency` into the run directory, which it returns. A filter
/// without contact or without flight in its data gets no score. Errors: `Stopped`; as `roll_out`.
std::filesystem::path sample_efficiency(const SampleEfficiencyConfig& config,
                                        const TrainingRequest& request);

}  // namespace touchdown::training
