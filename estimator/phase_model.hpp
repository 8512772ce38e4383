#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "estimator/axis.hpp"
#include "estimator/phase.hpp"
#include "estimator/phase_filter_config.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

/// Log densities of (knee, wheel) torque in every phase, through sensors with one level of noise at
/// the knee and one at the wheel.
/// log_density[(i · knee.count + j) · torque_density_count + phase] belongs to wheel[i], knee[j];
/// the density's unit is 1/(N·m)².
struct PhaseTorqueDensity {
  TorqueSample noise;      ///< standard deviations (N·m)
  TorqueSample bandwidth;  ///< total widths of the kernels (N·m)
  Axis knee;
  Axis wheel;
  std::vector<float> log_density;
};

/// Log densities of vertical acceleration in every phase, likewise:
/// log_density[i · acceleration_density_count + phase] belongs to axis[i], in log 1/(m/s²).
struct PhaseAccelerationDensity {
  double noise = 0.0;      ///< m/s²
  double bandwidth = 0.0;  ///< m/s²
  Axis axis;
  std::vector<float> log_density;
};

/// transition[i][j] = P(phase j at the next step | phase i).
using PhaseTransition = std::array<PhaseProbabilities, phase_count>;

/// All that the phase filter knows about a robot, as plain data.
struct PhaseModel {
  double sample_rate = 1000.0;  ///< Hz, of the transitions
  PhaseTransition transition{};
  /// n × n, for n levels of noise: torque[i · n + j] belongs to the i-th one at the knee and the
  /// j-th one at the wheel.
  std::vector<PhaseTorqueDensity> torque;
  std::vector<PhaseAccelerationDensity> acceleration;  ///< by increasing noise
  std::array<double, phase_count> seconds{};           ///< labelled data behind each phase
};

/// Throws InputError unless rows of the transition are probabilities, noise levels increase and
/// every grid has its axes' size and finite values.
void check_phase_model(const PhaseModel& model);

/// n, for torque densities of n × n noise levels. Throws InputError for any other number of them.
std::size_t torque_level_count(std::span<const PhaseTorqueDensity> densities);

/// One run to learn from: what was heard, and the truth. The data must outlive the fit.
struct PhaseFitRun {
  std::span<const Signals> signals;     ///< one per step, free of sensor noise
  std::array<WheelContact, 2> contact;  ///< left, right wheel
  bool may_be_held = false;             ///< something besides the ground may carry the robot
  /// Of each wheel (N); where it is not known, nobody is labelled carried.
  std::array<std::span<const double>, 2> normal_force;
  std::size_t skip = 0;  ///< steps at the beginning that are not used
};

/// How often phase j followed phase i. Every transition is counted with its mirror image, so that
/// left and right are alike.
PhaseTransition count_transitions(std::span<const Phase> phases);

/// A_ij = (n_ij + c) / Σ_j (n_ij + c).
PhaseTransition transition_probabilities(const PhaseTransition& counts, double pseudo_count);

/// Torques of both legs in the left leg's sign, and accelerations, by phase.
struct PhaseSamples {
  std::array<std::vector<TorqueSample>, torque_density_count> torque;
  std::array<std::vector<double>, acceleration_density_count> acceleration;
};

/// The mixture of a phase's kernel density and the uniform one, at one level of noise, on grids
/// that cover all samples. A phase without samples gets the uniform density.
PhaseTorqueDensity fit_torque_density(const PhaseSamples& samples, const TorqueSample& noise,
                                      const PhaseFitConfig& config);
PhaseAccelerationDensity fit_acceleration_density(const PhaseSamples& samples, double noise,
                                                  const PhaseFitConfig& config);

/// Fits everything. `before_density` is called before each of the many densities: what it throws
/// ends the fit. Throws InputError for runs without rolling or without flight, sequences of
/// different lengths, values that are not finite, or a bad configuration.
PhaseModel fit_phase_model(std::span<const PhaseFitRun> runs, double sample_rate,
                           const PhaseFitConfig& config,
                           const std::function<void()>& before_density = {});

}  // namespace touchdown
