#pragma once

#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// Writes `manifest.json`: versions, seeds, host, timings, runs that failed. Again when there are
/// more timings to tell.
void write_manifest(const ExperimentResult& result);

}  // namespace touchdown::experiments
