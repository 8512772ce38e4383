#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "estimator/phase/config.hpp"
#include "estimator/phase/model.hpp"

namespace touchdown {

/// One run for the fit: its signals and the true contacts. The data must outlive the fit.
struct PhaseFitRun {
  std::span<const Signals> signals;     ///< one per step, free of sensor noise
  std::array<WheelContact, 2> contact;  ///< left, right wheel
  bool may_be_held = false;             ///< something besides the ground may carry the robot
  /// Normal force of each wheel (N). If it is unknown, no step gets the label `carried`.
  std::array<std::span<const double>, 2> normal_force;
  std::size_t skip = 0;  ///< steps at the beginning that are not used
};

/// How often phase j followed phase i. Each transition counts with its mirror image, so that left
/// and right are alike.
PhaseTransition count_transitions(std::span<const Phase> phases);

/// A_ij = (n_ij + c) / Σ_j (n_ij + c).
PhaseTransition transition_probabilities(const PhaseTransition& counts, double pseudo_count);

/// The samples of each density: torques of both legs in the left leg's sign, and accelerations.
struct PhaseSamples {
  std::array<std::vector<TorqueSample>, torque_density_count> torque;
  std::array<std::vector<double>, acceleration_density_count> acceleration;
};

/// Mixtures of each phase's kernel density with a uniform one, for each noise at the knee with each
/// at the wheel (N·m; all pairs with the first noise at the knee come first), on grids that cover
/// all samples. A phase without samples gets the uniform density. If the legs of a single-wheel
/// phase lack samples, they get the densities of rolling and of flight.
std::vector<PhaseTorqueDensity> fit_torque_densities(
    const PhaseSamples& samples, std::span<const double> knee_noise,
    std::span<const double> wheel_noise, const PhaseFitConfig& config,
    const std::function<void()>& before_density = {});
PhaseAccelerationDensity fit_acceleration_density(const PhaseSamples& samples, double noise,
                                                  const PhaseFitConfig& config);

/// Fits the whole model. `before_density` is called before each density; an exception from it ends
/// the fit. Throws InputError for runs without rolling or without flight, sequences of different
/// lengths, values that are not finite, and an invalid configuration.
PhaseModel fit_phase_model(std::span<const PhaseFitRun> runs, double sample_rate,
                           const PhaseFitConfig& config,
                           const std::function<void()>& before_density = {});

}  // namespace touchdown
