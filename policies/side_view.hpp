#pragma once

#include <array>

#include <Eigen/Core>

#include "models/robot_model.hpp"

namespace touchdown::policies {

/// Masses and lengths of a wheeled biped from the side, x forward, z up, for control laws. Both
/// legs count as one. All joints are at zero, where both links point straight down.
struct SideView {
  double torso_mass = 0.0;       ///< kg
  double upper_mass = 0.0;       ///< of both legs (kg)
  double lower_mass = 0.0;       ///< of both legs (kg)
  double mass = 0.0;             ///< of the whole robot, wheels included (kg)
  Eigen::Vector2d torso_centre;  ///< centre of mass from the hip (m)
  Eigen::Vector2d upper_centre;  ///< centre of mass from the hip (m)
  Eigen::Vector2d lower_centre;  ///< centre of mass from the knee (m)
  double upper_length = 0.0;     ///< hip to knee (m)
  double lower_length = 0.0;     ///< knee to axle (m)
  /// Sign that makes hip and knee angles positive forward: left, right.
  std::array<double, 2> forward = {1.0, -1.0};

  /// Vector (m) from the axle to the centre of mass of the robot without wheels. The angles of
  /// hips, knees and torso are positive forward (rad).
  Eigen::Vector2d centre(double hip, double knee, double pitch) const;
};

SideView side_view(const models::RobotModel& robot);

}  // namespace touchdown::policies
