#include "recordings/signals_from.hpp"

namespace touchdown {

double ground_velocity_command(const Action& action, double wheel_radius) {
  const double left = action.servo[index(Servo::left_wheel)].velocity;
  const double right = action.servo[index(Servo::right_wheel)].velocity;
  return 0.5 * wheel_radius * (left - right);
}

Signals signals_from(const Observation& observation, double previous_ground_velocity_command) {
  const auto joint = [&](Servo servo) {
    const ServoReading& reading = observation.servo[index(servo)];
    return JointSignals{reading.position, reading.velocity, reading.torque};
  };
  Signals signals;
  signals.time = observation.time;
  signals.leg[0] = {joint(Servo::left_hip), joint(Servo::left_knee), joint(Servo::left_wheel)};
  signals.leg[1] = {joint(Servo::right_hip), joint(Servo::right_knee), joint(Servo::right_wheel)};
  signals.linear_acceleration = observation.imu.linear_acceleration;
  signals.angular_velocity = observation.imu.angular_velocity;
  signals.vertical_acceleration = vertical_acceleration(observation.imu);
  signals.ground_velocity_command = previous_ground_velocity_command;
  return signals;
}

}  // namespace touchdown
