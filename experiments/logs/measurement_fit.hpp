#pragma once

#include <span>

#include "estimator/bayes/config.hpp"
#include "experiments/logs/fit_log.hpp"

namespace touchdown::experiments {

/// `fit` (experiments/listening/fitting.hpp) for logs, at a memory that does not grow with them:
/// each is read twice. A torque that is not finite is left out with its leg's step; after a gap in
/// time, or a step back, the torque's low-pass starts anew, as in the filter. Errors: `InputError`
/// for logs of reserved seeds, without ground truth where none is declared, without one of the two
/// classes, or unreadable; standard input cannot be read twice.
MeasurementModel fit_measurement_to_logs(std::span<const FitLog> logs,
                                         const BayesFilterConfig& filter,
                                         const LogFitConfig& config, LogFitReport& report);

}  // namespace touchdown::experiments
