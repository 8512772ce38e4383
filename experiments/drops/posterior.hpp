#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "estimator/phase/phase.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/drops/drops.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// The phase filter's belief through one drop; one entry per step of the window.
struct DropPosterior {
  std::string simulator;
  noise::NoiseCell noise;
  std::vector<double> time;  ///< since takeoff (s)
  std::array<std::vector<std::uint8_t>, models::wheel_count>
      contact;                             ///< of each wheel, by its label
  std::vector<Phase> truth;                ///< the phase by the labels
  std::vector<PhaseProbabilities> phases;  ///< P(phase | heard so far)
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
