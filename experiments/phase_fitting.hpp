#pragma once

#include <functional>
#include <span>

#include "estimator/phase_model.hpp"
#include "experiments/heard_run.hpp"
#include "recordings/phase_model_file.hpp"

namespace touchdown {

/// Whether something besides the ground may have carried the robot in a run: a tether or a force.
bool may_be_held(const RecordingInfo& info);

/// The phase filter's model from noiseless runs, each without its first `skip` seconds.
/// Errors: `InputError` for runs of reserved seeds, of different control periods, or without
/// rolling or flight; what `before_density` throws, as `fit_phase_model` says.
PhaseModel fit_phases(std::span<const HeardRun* const> runs, const PhaseFitConfig& config,
                      double skip, const std::function<void()>& before_density = {});

/// What such a model was fitted to: scenarios, simulators, seeds, runs and seconds.
ModelProvenance provenance_of(std::span<const HeardRun* const> runs, double skip);

}  // namespace touchdown
