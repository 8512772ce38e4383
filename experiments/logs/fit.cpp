#include "experiments/logs/fit.hpp"

#include "experiments/logs/measurement_fit.hpp"
#include "experiments/logs/phase_fit.hpp"

namespace touchdown::experiments {

FittedModel fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                        const LogFitConfig& config, LogFitReport& report) {
  if (entry.config) return {fit_measurement_to_logs(logs, *entry.config, config, report), nullptr};
  return {{},
          std::make_shared<const recordings::PhaseModelFile>(
              fit_phases_to_logs(logs, entry.phase->fit, config, report))};
}

}  // namespace touchdown::experiments
