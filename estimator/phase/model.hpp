#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimator/numerics/axis.hpp"
#include "estimator/phase/phase.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

/// Log densities of (knee, wheel) torque in every phase, for one level of sensor noise at the knee
/// and one at the wheel. log_density[(i · knee.count + j) · torque_density_count + phase] belongs
/// to wheel[i], knee[j]; the density's unit is 1/(N·m)².
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

/// The phase filter's model of a robot, as plain data.
struct PhaseModel {
  double sample_rate = 1000.0;  ///< Hz, of the transitions
  PhaseTransition transition{};
  /// n × n, for n levels of noise: torque[i · n + j] belongs to the i-th one at the knee and the
  /// j-th one at the wheel.
  std::vector<PhaseTorqueDensity> torque;
  std::vector<PhaseAccelerationDensity> acceleration;  ///< by increasing noise
  std::array<double, phase_count> seconds{};           ///< labelled data behind each phase
};

/// Throws InputError unless rows of the transition are probabilities, noise levels increase, and
/// every grid has its axes' size and finite values.
void check_phase_model(const PhaseModel& model);

/// n, for torque densities at n × n noise levels. Throws InputError for any other number of them.
std::size_t torque_level_count(std::span<const PhaseTorqueDensity> densities);

}  // namespace touchdown
