#pragma once

#include <array>

#include <Eigen/Core>

#include "models/robot_model.hpp"

namespace touchdown::policies {

/// A wheeled biped from the side, x forward and z up, its joints at zero and its legs as one: what
/// a law needs to know of its masses and lengths. Both links hang straight down then.
struct SideView {
  double torso_mass = 0.0;       ///< kg
  double upper_mass = 0.0;       ///< of both legs (kg)
  double lower_mass = 0.0;       ///< likewise
  double mass = 0.0;             ///< of all, wheels too (kg)
  Eigen::Vector2d torso_centre;  ///< of mass, from the hip (m)
  Eigen::Vector2d upper_centre;  ///< likewise
  Eigen::Vector2d lower_centre;  ///< from the knee (m)
  double upper_length = 0.0;     ///< hip to knee (m)
  double lower_length = 0.0;     ///< knee to axle (m)
  /// What turns a hip's or knee's angle into one that bends forward: left, right.
  std::array<double, 2> forward = {1.0, -1.0};

  /// From the axle to the centre of mass of what stands on it, with hips and knees bent forward by
  /// these angles and the torso leaning forward (rad), in metres.
  Eigen::Vector2d centre(double hip, double knee, double pitch) const;
};

SideView side_view(const models::RobotModel& robot);

}  // namespace touchdown::policies
