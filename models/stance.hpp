#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/robot_description.hpp"
#include "models/robot_model.hpp"

namespace touchdown::models {

/// Whether a servo's angle (rad) is within the range of its joint.
bool can_turn(const RobotModel& robot, std::size_t servo, double angle);

/// A stance in the zeros of the robot's file, as angles from straight legs.
Stance from_straight(const RobotModel& robot, const Stance& stance);
/// The same stance in the zeros of the robot's file.
Stance in_zeros_of_file(const RobotModel& robot, const Stance& stance);

/// The stance if the file of a robot gives none: Upkie's crouch; if the joints cannot have it, its
/// mirror image, with knees that bend forward; if they can have neither, the nearest to these
/// within their ranges; or else the pose of the file. Closed legs: the pose of the file, or the
/// nearest to it within their ranges.
Stance usual_stance(const RobotModel& robot);

/// What is wrong with the ranges of hips and knees: too narrow to move, as radians taken for
/// degrees are, or no angle in common for mirrored legs.
std::vector<std::string> range_complaints(const RobotModel& robot);

/// Why a robot cannot stand, whatever its gains and colliders, in the pose of its file and in that
/// in which it would balance; empty if it may.
std::string reason_to_fall(const RobotModel& robot, const mjData& file, const mjData& standing);

/// An angle that a joint cannot have.
struct StanceError {
  std::string key;  ///< "hip" or "knee"
  std::string message;
};

/// The first angle of a stance, from straight legs, that a joint of either leg cannot have. The
/// message has angles from straight legs, or in the zeros of the robot's file.
std::optional<StanceError> stance_error(const RobotModel& robot, const Stance& stance,
                                        bool in_zeros_of_file = false);

}  // namespace touchdown::models
