#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "logs/log/row.hpp"
#include "models/robot_model.hpp"

namespace touchdown::logs {

/// Turns what motors of closed legs report into hips and knees of their virtual legs
/// (models/linkage.hpp), row by row. Motors and wheels count with the signs and zeros of the
/// robot's file.
class MotorsToLegs {
 public:
  /// Errors: those of `compile_robot_model`; `InputError` for a robot with open legs.
  explicit MotorsToLegs(const std::filesystem::path& robot);

  std::size_t motors_per_leg() const;
  /// "left_front, left_rear, left_axle, right_front, …": the order of a mapping's joints.
  std::string joints() const;

  /// Replaces motors in the slots of hips and knees by the virtual legs, and keeps them as motors.
  /// A leg with one motor has it in the slot of its hip. Where loops cannot close, or a number is
  /// missing, the leg's numbers are NaN.
  void convert(LogValues& values);

 private:
  models::RobotModel robot_;
  std::array<models::LinkageVector, models::wheel_count> angles_;  ///< of the last row
};

}  // namespace touchdown::logs
