#pragma once

#include <memory>
#include <vector>

#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/phase/config.hpp"
#include "estimator/phase/model.hpp"
#include "estimator/phase/recursion.hpp"
#include "estimator/phase/tables.hpp"

namespace touchdown {

/// A model in the form that filters run, one or many side by side. It holds transitions and
/// likelihoods at the filter's rate, fresh noise estimates, and the position of each of their
/// levels among the levels of the densities (one entry if the noise is known). Copies, and all
/// others that were prepared from the same model, share its densities.
struct PreparedPhaseModel {
  /// `shared` must be a model that `check_phase_model` accepts. Throws InputError for an invalid
  /// configuration, and for a sample rate that is not the model's divided by a whole number.
  PreparedPhaseModel(std::shared_ptr<const PhaseModel> shared, const PhaseFilterConfig& config);

  std::shared_ptr<const PhaseModel> model;
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
