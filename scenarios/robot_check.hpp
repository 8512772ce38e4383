#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "logs/recording.hpp"
#include "models/robot.hpp"
#include "models/robot_model.hpp"
#include "policies/servo_stability.hpp"

namespace touchdown::scenarios {

/// What was read about a servo's joint.
struct CheckedJoint {
  std::string servo;                               ///< touchdown's name
  std::string joint;                               ///< the file's name
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< the file's, in the base frame
  bool is_reversed = false;                        ///< whether recordings have the opposite sign
  double zero = 0.0;          ///< added to the file's angle, after its sign (rad)
  bool is_limited = false;    ///< whether there is a range
  double low = 0.0;           ///< of the range, from a straight leg (rad)
  double high = 0.0;          ///< likewise
  double torque_limit = 0.0;  ///< N·m
  /// Friction, viscous friction and armature, and the motor of a closed leg if it is on another
  /// joint; empty if there are none.
  std::string actuator;
};

/// The robot standing still for two seconds in one engine, and dropped from 10 cm.
struct CheckedStand {
  std::string engine;
  std::string ending;  ///< how and when the run ended, and why
  bool stands = false;
  double moved = 0.0;                                 ///< along the ground (m)
  std::array<double, models::wheel_count> load = {};  ///< at the end, left and right (N)
  double given_way = 0.0;  ///< largest angle of a held joint from its reference (rad)
  std::string drop = {};   ///< how it ended
};

/// What touchdown makes of a robot's file.
struct RobotCheck {
  std::string name;
  double mass = 0.0;                                      ///< kg
  std::array<double, models::wheel_count> leg_mass = {};  ///< kg, wheels included
  double wheel_radius = 0.0;                              ///< m
  double track = 0.0;                                     ///< between the tyres (m)
  Eigen::Vector3d imu = Eigen::Vector3d::Zero();          ///< in the base frame (m)
  std::vector<CheckedJoint> joints;
  std::vector<models::HeldJoint> held;
  double hip = 0.0;                      ///< stance, from straight legs (rad)
  double knee = 0.0;                     ///< likewise
  double axle_forward = 0.0;             ///< from the centre of mass, in the stance (m)
  double lever = 0.0;                    ///< knee torque per newton of load in the stance (m)
  std::vector<std::string> ignored;      ///< in the file, but not simulated
  std::vector<std::string> warnings;     ///< what of the file may be a mistake
  std::vector<std::string> differences;  ///< between the engines
  /// Factor on all gains at which the servos become unstable, in flight and standing.
  policies::ServoMargins margins;
  std::shared_ptr<const models::RobotModel> robot;  ///< null if its file is refused
  std::vector<CheckedStand> stands;                 ///< in every engine
  logs::Recording standing;                         ///< of the first engine
  std::vector<std::string> complaints;              ///< none if the robot is usable
};

/// ": 'left_guard' (`no_collision: [left_guard]` leaves it out)": the collider nearest to the
/// terrain at the end of a run in `scene`, tyres left out, by the name of its geom or body. Empty
/// unless the robot fell as a part other than a tyre touched the terrain.
std::string part_on_terrain(const models::RobotModel& scene, const logs::Recording& recording);

/// Friction, viscous friction and armature after a text; empty if there are none.
std::string actuator_text(const models::Actuator& actuator, std::string text = {});

/// Writes the YAML file about an MJCF or a URDF, with comments where it guesses
/// (models/robot_draft.hpp), in the words of the robot's file. Returns the guesses that its user
/// should check, one line each. Errors: those of `drafted_robot`; `Error` for a file that cannot be
/// written.
std::vector<std::string> draft_robot(const std::filesystem::path& robot,
                                     const std::filesystem::path& yaml);

/// Compiles a robot, lets it stand for two seconds in every engine, and drops it from 10 cm. A file
/// that is refused has complaints, and nothing else is filled in. `should_continue` is called
/// repeatedly while it stands. Errors: `Stopped`.
RobotCheck check_robot(const std::filesystem::path& file,
                       const std::function<bool()>& should_continue = {});

}  // namespace touchdown::scenarios
