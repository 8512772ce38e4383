#pragma once

#include "estimator/bayes/config.hpp"
#include "estimator/bayes/measurement_model.hpp"
#include "experiments/estimators/fit_runs.hpp"

namespace touchdown::experiments {

/// Fits the measurement model of a configuration to noiseless runs, as in the paper's Section III.
/// Errors: `InputError` when the runs lack contact or flight.
MeasurementModel fit_torques(const FitRuns& runs, const MeasurementConfig& config);

}  // namespace touchdown::experiments
