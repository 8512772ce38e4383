#pragma once

#include <span>

#include "experiments/estimators/entry.hpp"
#include "experiments/logs/fit_log.hpp"

namespace touchdown::experiments {

/// The model that an estimator needs, fitted to logs. Errors: `InputError` for an estimator that
/// needs none, and as the two kinds of fits say.
FittedModel fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                        const LogFitConfig& config, LogFitReport& report);

}  // namespace touchdown::experiments
