#pragma once

#include <span>

#include "estimator/bayes/config.hpp"
#include "estimator/bayes/measurement_model.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

struct RunSignals;

/// Fits the measurement model of a configuration to noiseless runs, as in the paper's Section III.
/// Errors: `InputError` when the runs lack contact or flight.
MeasurementModel fit(std::span<const RunSignals* const> runs, const MeasurementConfig& config,
                     const scoring::ScoringConfig& scoring);

}  // namespace touchdown::experiments
