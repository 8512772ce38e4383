#pragma once

#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// Writes `manifest.json`: versions, seeds, host, timings, failed runs. Call it again to add later
/// timings.
void write_manifest(const ExperimentResult& result);

}  // namespace touchdown::experiments
