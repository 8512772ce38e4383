#pragma once

#include <vector>

#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/phase/config.hpp"
#include "estimator/phase/model.hpp"
#include "estimator/phase/recursion.hpp"
#include "estimator/phase/tables.hpp"

namespace touchdown {

/// A model as one filter, or many side by side, run it: transitions and likelihoods at the filter's
/// rate, noise estimates that have seen nothing yet, and where each of their rungs lies among the
/// prepared densities (one entry if the noise is known).
struct PreparedPhaseModel {
  /// Throws InputError for a bad model or configuration, and for a sample rate that is not the
  /// model's divided by a whole number.
  PreparedPhaseModel(const PhaseModel& model, const PhaseFilterConfig& config);

  PhaseRecursion recursion;
  PhaseTorqueTables torque;
  PhaseAccelerationTables acceleration;
  NoiseEstimate<2> knee_noise;
  NoiseEstimate<2> wheel_noise;
  NoiseEstimate<1> acceleration_noise;
  std::vector<PhaseNoiseLevel> knee_levels;
  std::vector<PhaseNoiseLevel> wheel_levels;
  std::vector<PhaseNoiseLevel> acceleration_levels;
};

}  // namespace touchdown
