#pragma once

#include <array>
#include <optional>

#include "estimator/record.hpp"
#include "estimator/signal_assembler.hpp"
#include "models/robot.hpp"

namespace touchdown::logs {

/// Radius of Upkie's wheels (m), for converting wheel velocities to ground velocities.
inline constexpr double upkie_wheel_radius = 0.05;

/// Ground velocity that an action commands (m/s), positive forward: the mean of the velocity
/// targets of the left and the reversed right wheel.
double ground_velocity_command(const models::Action& action,
                               double wheel_radius = upkie_wheel_radius);

/// Storage for the joints of a record.
struct RecordedJoints {
  std::array<JointSignals, models::servo_count> joints;
  std::array<JointTarget, models::servo_count> targets;
};

/// Converts one step to a record of a robot's software. `previous` is the action of the step
/// before, in force when the observation was made; null at the first step. Gains are in N·m/rad and
/// N·m·s/rad. `storage` must outlive the record.
RobotRecord record_of(const models::Observation& observation, const models::Action* previous,
                      RecordedJoints& storage);

/// The input of a contact estimator at one step. Command and targets are those of the previous
/// step, since this step's action depends on this observation; without one, the command is 0 and
/// targets are NaN. If the norm of the IMU's quaternion differs from 1 by more than a percent, the
/// vertical acceleration is NaN.
Signals signals_from(const models::Observation& observation, const models::Action* previous);
/// The same without targets, given the ground velocity of the previous action (m/s).
Signals signals_from(const models::Observation& observation,
                     double previous_ground_velocity_command);

/// The input of an estimator, from the steps of a log or of a robot's loop one after the other.
class StepSignals {
 public:
  /// `sample_rate` in Hz. Repeated values are no fault: a simulated robot at rest reports the same
  /// values again.
  explicit StepSignals(double sample_rate)
      : assembler_(AssemblyConfig{.sample_rate = sample_rate, .stale_after = 0.0}) {}

  void reset();
  /// Valid until the next step.
  const Signals& next(const models::Observation& observation, const models::Action& action);
  const SignalAssembler& assembler() const { return assembler_; }

 private:
  SignalAssembler assembler_;
  RecordedJoints joints_;
  std::optional<models::Action> previous_;  ///< of the step before
};

}  // namespace touchdown::logs
