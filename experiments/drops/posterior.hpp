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

/// What one step says of every phase: log likelihoods as the filter weighs them, the same constant
/// apart for all phases.
struct PhaseEvidence {
  PhaseProbabilities left{};          ///< by the left leg's torques
  PhaseProbabilities right{};         ///< by the right leg's
  PhaseProbabilities acceleration{};  ///< by the vertical acceleration

  double sum(Phase phase) const {
    return left[index(phase)] + right[index(phase)] + acceleration[index(phase)];
  }
};

/// Where the most probable phase is wrong about a wheel: by how much each ingredient prefers it to
/// the true one. Logarithms of ratios, which add up to that of the two probabilities; all zero
/// where it is right about both wheels.
struct LogLikelihoodError {
  double left = 0.0;
  double right = 0.0;
  double acceleration = 0.0;
  double memory = 0.0;  ///< by what was believed before, and by what may follow what
};

/// The phase filter's belief through one drop; one entry per step of the window.
struct DropPosterior {
  std::string simulator;
  noise::NoiseCell noise;
  std::optional<double> at = {};  ///< the moment that was asked for instead of a drop (s)
  std::vector<double> time;       ///< since takeoff, or that moment (s)
  std::array<std::vector<std::uint8_t>, models::wheel_count>
      contact;                             ///< of each wheel, by its label
  std::vector<Phase> truth;                ///< the phase by the labels
  std::vector<PhaseEvidence> evidence;     ///< of the step alone
  std::vector<PhaseProbabilities> phases;  ///< P(phase | heard so far)
  std::vector<LogLikelihoodError> log_likelihood_error;              ///< why they are wrong, where they are
  std::array<std::vector<double>, models::wheel_count>
      p_contact;  ///< what these add up to, by wheel
};

/// Lets the phase filter listen to the whole run through the noise that the study hears, with the
/// model that was fitted in the same engine, and keeps the window around the drop. True phases are
/// cut as they were for fitting (`PhaseLabelConfig`), so that they look ahead: nobody can know an
/// unloading for sure before its takeoff.
/// Errors: `InputError` when the run has no such drop.
DropPosterior drop_posterior(const Experiment& experiment, const PosteriorConfig& config,
                             const RunSignals& run, const FittedModels& models);

}  // namespace touchdown::experiments
