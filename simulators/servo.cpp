#include "simulators/servo.hpp"

#include <algorithm>
#include <cmath>

namespace touchdown::simulators {

double servo_torque(const models::ServoCommand& command, double position, double velocity,
                    double effort) {
  double torque = command.feedforward_torque +
                  models::servo_kd * command.kd_scale * (command.velocity - velocity);
  if (!std::isnan(command.position)) {
    torque += models::servo_kp * command.kp_scale * (command.position - position);
  }
  const double limit = std::max(0.0, std::min(command.maximum_torque, effort));
  return std::clamp(torque, -limit, limit);
}

}  // namespace touchdown::simulators
