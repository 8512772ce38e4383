#pragma once

#include "experiments/signals/run_signals.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::experiments {

/// What estimators hear of a run that is fitted, and what is true: `time` and `heard` by step, the
/// members of `Signals`, joints in six columns (hip, knee, wheel of the left leg, then of the
/// right one), and the labels `contact` in two. To the bit what `ContactEstimator::update` is given
/// at the steps that are heard. At others there is no record, and the time is the step's.
recordings::NpzArrays exported_arrays(const RunSignals& run);

/// Likewise through noise.
recordings::NpzArrays exported_arrays(const RunSignals& run, const NoiseRun& noise,
                                   const noise::SensorNoise& levels);

/// The most that they take on a disk (bytes).
double bytes_of_exported(double steps);

}  // namespace touchdown::experiments
