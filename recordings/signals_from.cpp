#include "recordings/signals_from.hpp"

#include <cmath>
#include <limits>

namespace touchdown::recordings {

namespace {

/// Sensors round, and so do the formats they are logged in.
bool is_orientation(const Eigen::Quaterniond& q) {
  constexpr double tolerance = 0.02;
  return std::abs(q.squaredNorm() - 1.0) <= tolerance;  // written so that NaN fails
}

}  // namespace

double ground_velocity_command(const models::Action& action, double wheel_radius) {
  const double left = action.servo[models::index(models::Servo::left_wheel)].velocity;
  const double right = action.servo[models::index(models::Servo::right_wheel)].velocity;
  return 0.5 * wheel_radius * (left - right);
}

Signals signals_from(const models::Observation& observation,
                     double previous_ground_velocity_command) {
  const auto joint = [&](models::Servo servo) {
    const models::ServoReading& reading = observation.servo[models::index(servo)];
    return JointSignals{reading.position, reading.velocity, reading.torque};
  };
  Signals signals;
  signals.time = observation.time;
  signals.leg[0] = {joint(models::Servo::left_hip), joint(models::Servo::left_knee),
                    joint(models::Servo::left_wheel)};
  signals.leg[1] = {joint(models::Servo::right_hip), joint(models::Servo::right_knee),
                    joint(models::Servo::right_wheel)};
  signals.linear_acceleration = observation.imu.linear_acceleration;
  signals.angular_velocity = observation.imu.angular_velocity;
  signals.vertical_acceleration = is_orientation(observation.imu.orientation)
                                      ? models::vertical_acceleration(observation.imu)
                                      : std::numeric_limits<double>::quiet_NaN();
  signals.ground_velocity_command = previous_ground_velocity_command;
  return signals;
}

}  // namespace touchdown::recordings
