#pragma once

#include <functional>
#include <span>

#include "estimator/phase/fit.hpp"
#include "experiments/signals/run_signals.hpp"
#include "recordings/models/phase_model.hpp"

namespace touchdown::experiments {

/// Whether something besides the ground may have carried the robot in a run: a tether or a force.
bool may_be_held(const recordings::RecordingInfo& info);

/// The phase filter's model from noiseless runs, each without its first `skip` seconds, and what it
/// was fitted to: scenarios, simulators, seeds, runs and seconds.
/// Errors: `InputError` for runs of reserved seeds, of different control periods, or without
/// rolling or flight; what `before_density` throws, as `fit_phase_model` says.
recordings::PhaseModelFile fit_phases(std::span<const RunSignals* const> runs,
                                      const PhaseFitConfig& config, double skip,
                                      const std::function<void()>& before_density = {});

}  // namespace touchdown::experiments
