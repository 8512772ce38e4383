#pragma once

#include <functional>
#include <span>

#include "estimator/bayes/config.hpp"
#include "estimator/bayes/measurement_model.hpp"
#include "estimator/labelled_run.hpp"
#include "estimator/models/model.hpp"
#include "estimator/models/parameters.hpp"
#include "estimator/phase/fit.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

/// Whether a tether or a force may have carried the robot in a run.
bool may_be_held(const logs::RecordingInfo& info);

/// Fits the phase filter's model to noiseless runs, each without its first `skip` seconds. Its
/// provenance lists scenarios, simulators, seeds, runs and seconds.
/// Errors: `InputError` for runs of different control periods, or without rolling or flight;
/// exceptions from `before_density`, see `fit_phase_model`.
Model fit_phases(std::span<const RunSignals* const> runs, const PhaseFitConfig& config, double skip,
                 const std::function<void()>& before_density = {});

/// Fits the measurement model of a configuration to noiseless runs, as in the paper's Section III.
/// Errors: `InputError` when the runs lack contact or flight.
MeasurementModel fit(std::span<const RunSignals* const> runs, const MeasurementConfig& config,
                     const scoring::ScoringConfig& scoring);

/// Fits an estimator's named parameters to labelled runs.
using FitParameters = std::function<Parameters(std::span<const LabelledRun> runs)>;

/// Fits the model of an entry with parameters of its own, and records its provenance. It uses whole
/// runs, each without its beginning. Errors: those of `fit`.
Model fit_parameters(const EstimatorEntry& entry, const FitRuns& runs, const FitParameters& fit);

}  // namespace touchdown::experiments
