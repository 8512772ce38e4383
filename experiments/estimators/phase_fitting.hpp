#pragma once

#include <functional>
#include <span>

#include "estimator/phase/fit.hpp"
#include "experiments/signals/run_signals.hpp"
#include "recordings/models/phase_model.hpp"

namespace touchdown::experiments {

/// Whether a tether or a force may have carried the robot in a run.
bool may_be_held(const recordings::RecordingInfo& info);

/// Fits the phase filter's model to noiseless runs, each without its first `skip` seconds. Its
/// provenance lists scenarios, simulators, seeds, runs and seconds.
/// Errors: `InputError` for runs of reserved seeds, of different control periods, or without
/// rolling or flight; exceptions from `before_density`, see `fit_phase_model`.
recordings::PhaseModelFile fit_phases(std::span<const RunSignals* const> runs,
                                      const PhaseFitConfig& config, double skip,
                                      const std::function<void()>& before_density = {});

}  // namespace touchdown::experiments
