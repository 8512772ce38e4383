#pragma once

#include <span>

#include "estimator/phase/config.hpp"
#include "experiments/logs/fit_log.hpp"
#include "recordings/models/phase_model.hpp"

namespace touchdown::experiments {

/// `fit_phases` for logs, which have to have ground truth and are held in memory (0.25 MB/s at
/// 1 kHz). Errors: `InputError` as above, and for values that are not finite, gaps in time, or logs
/// without a takeoff.
recordings::PhaseModelFile fit_phases_to_logs(std::span<const FitLog> logs,
                                              const PhaseFitConfig& phases,
                                              const LogFitConfig& config, LogFitReport& report);

}  // namespace touchdown::experiments
