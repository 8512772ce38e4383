#pragma once

#include <cstdint>

namespace touchdown {
class Fields;
}

namespace touchdown::simulators {

/// Time steps in whole microseconds, so that no step is rounded.
struct StepSizes {
  /// One step of the physics engine (µs). A stiff tyre makes it shorter (simulators/tyres.hpp).
  std::int64_t physics_us = 1000;
  /// Period of the control loop (µs): a multiple of the physics step.
  std::int64_t control_us = 1000;
};

/// Contact between tyres and ground. Each engine has its own soft contact model; the defaults give
/// about the same flights and landings.
struct ContactModel {
  double solref_time_constant = 0.01;  ///< MuJoCo: time constant of the contact spring (s)
  double solref_damping_ratio = 1.0;   ///< MuJoCo: its damping ratio
  double bullet_stiffness = 3e4;       ///< Bullet: of the tyres (N/m)
  double bullet_damping = 1e3;         ///< Bullet: of the tyres (N·s/m)
  /// Bullet: of the edges of boxes and cylinders (m), at most a tenth of their least half extent.
  /// Bullet's own default is 0.04.
  double bullet_edge_radius = 1e-4;
  /// Both engines: torque that opposes rolling, per newton of load (N·m/N = m).
  double rolling_resistance = 0.004;
};

/// Settings of a simulation other than the scene.
struct SimulatorOptions {
  StepSizes steps;
  ContactModel contact;
};

void describe(Fields& fields, SimulatorOptions& options);

}  // namespace touchdown::simulators
