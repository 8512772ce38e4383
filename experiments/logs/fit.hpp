#pragma once

#include <span>

#include "experiments/estimators/entry.hpp"
#include "experiments/logs/fit_log.hpp"

namespace touchdown::experiments {

/// Fits an estimator's model to logs. Errors: `InputError` for unknown hyperparameters, and for
/// logs that are unreadable, of reserved seeds, without ground truth or a declared class, or with
/// labels of other times.
///
/// A measurement model is fitted as in experiments; only the torques of both legs are held in
/// memory (32 kB/s at 1 kHz). A torque that is not finite, or beyond
/// `SignalGuardConfig::largest_torque`, is left out with its leg's step. After a gap in time, or a
/// step back, the torque's low-pass restarts, as in the filter. Errors: `InputError` for logs
/// without one of the two classes.
///
/// A phase model is fitted to logs with ground truth, held in memory (0.25 MB/s at 1 kHz). Errors:
/// `InputError` for values that are not finite, gaps in time, or logs without a takeoff.
///
/// Parameters are fitted to logs in memory, of one class or with ground truth. Unusable steps are
/// left out as during estimation. Errors: `InputError` for logs without one of the classes.
Model fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                  const LogFitConfig& config, LogFitReport& report);

}  // namespace touchdown::experiments
