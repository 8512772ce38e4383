#pragma once

#include "estimator/npz/npz.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// The arrays of a run for fitting, one row per step: `time`, `has_record`, the members of
/// `Signals` and the labels `contact` (left, right). Joints have six columns: hip, knee, wheel of
/// the left leg, then of the right leg. At steps with a record the values equal the input of
/// `ContactEstimator::update` bit for bit. At other steps the time is that of the step.
ModelArrays exported_arrays(const RunSignals& run);

/// The arrays of a run with noise.
ModelArrays exported_arrays(const RunSignals& run, const NoiseRun& noise,
                            const noise::SensorNoise& levels);

/// Upper bound of the size of a run's arrays on disk (bytes).
double bytes_of_exported(double steps);

}  // namespace touchdown::experiments
