#pragma once

#include "experiments/signals/run_signals.hpp"
#include "noise/disturbance.hpp"

namespace touchdown::experiments {

/// A run's noise with heavy tails: a tenth of the samples, of all channels at once, are outliers.
NoiseRun with_heavy_tails(NoiseRun noise, const noise::NoiseKey& key);

/// `noisy` with everything of the disturbance but its heavy tails, which are the noise's own.
Signals disturbed(const RunSignals& run, const NoiseRun& noise, const noise::SensorNoise& levels,
                  std::size_t step, const noise::Disturbance& disturbance);

}  // namespace touchdown::experiments
