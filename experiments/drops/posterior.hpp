#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "estimator/phase/phase.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/drops/drops.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// Log likelihoods of every phase at one step, weighted as in the filter, up to a constant that all
/// phases share.
struct PhaseEvidence {
  PhaseProbabilities left{};          ///< by the left leg's torques
  PhaseProbabilities right{};         ///< by the right leg's
  PhaseProbabilities acceleration{};  ///< by the vertical acceleration

  double sum(Phase phase) const {
    return left[index(phase)] + right[index(phase)] + acceleration[index(phase)];
  }
};

/// Log-likelihood ratio of the most probable phase to the true phase, by source, where the most
/// probable phase is wrong about a wheel. The terms add up to the log ratio of the two
/// probabilities. All are zero where the phase is right about both wheels.
struct LogLikelihoodError {
  double left = 0.0;
  double right = 0.0;
  double acceleration = 0.0;
  double memory = 0.0;  ///< from the previous belief and the transition probabilities
};

/// The phase filter's belief through one drop; one entry per step of the window.
struct DropPosterior {
  std::string simulator;
  noise::NoiseCell noise;
  std::optional<double> at = {};  ///< a time that the file names instead of a drop (s)
  std::vector<double> time;       ///< since takeoff, or since `at` (s)
  std::array<std::vector<std::uint8_t>, models::wheel_count>
      contact;                                                     ///< of each wheel, by its label
  std::vector<Phase> truth;                                        ///< the phase by the labels
  std::vector<PhaseEvidence> evidence;                             ///< of each step alone
  std::vector<PhaseProbabilities> phases;                          ///< P(phase | signals so far)
  std::vector<LogLikelihoodError> log_likelihood_error;            ///< zero where `phases` is right
  std::array<std::vector<double>, models::wheel_count> p_contact;  ///< sums of `phases`, by wheel
};

/// Runs the phase filter on the whole run with the noise of the study, and keeps the window around
/// the drop. The model is the one that was fitted in the same engine. True phases are those of
/// fitting (`PhaseLabelConfig`). They look ahead: an unloading is certain only after its takeoff.
/// Errors: `InputError` when the run has no such drop.
DropPosterior drop_posterior(const Experiment& experiment, const PosteriorConfig& config,
                             const RunSignals& run, const FittedModels& models);

}  // namespace touchdown::experiments
