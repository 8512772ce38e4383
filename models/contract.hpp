#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "models/mjcf/document.hpp"
#include "models/mjcf/parts.hpp"
#include "models/mjcf/types.hpp"
#include "models/robot_description.hpp"
#include "models/robot_model.hpp"

namespace touchdown::models {

/// Looks up the names of the contract in a compiled model. Messages have the place of the element
/// in the robot's file, and the names that this file uses.
class Contract {
 public:
  Contract(const MjcfDocument& document, const PartNames& parts, const mjModel& model)
      : document_(document), parts_(parts), model_(model) {}

  /// Errors: `InputError` if the model has no such element, with the nearest name.
  int find(mjtObj type, const char* tag, std::string_view name) const;

  /// An error about the robot as a whole, at its base or its root.
  [[noreturn]] void fail(const std::string& message) const;
  // Errors about the body, joint, geom or actuator of this number in the model.
  [[noreturn]] void fail_at_body(int body, const std::string& message) const;
  [[noreturn]] void fail_at_joint(int joint, const std::string& message) const;
  [[noreturn]] void fail_at_geom(int geom, const std::string& message) const;
  [[noreturn]] void fail_at_actuator(int actuator, const std::string& message) const;
  /// An error about a connection: "connect 'x': …".
  [[noreturn]] void fail_at_equality(int equality, const std::string& message) const;
  [[noreturn]] void fail_at_site(int site, const std::string& message) const;
  /// An error about a joint: "joint 'left_hip': …".
  [[noreturn]] void fail_at_hinge(int joint, const std::string& message) const;
  /// The same about a servo's joint.
  [[noreturn]] void fail_at_servo(std::size_t servo, const std::string& message) const;
  /// Checks that a joint is a hinge, alone on its body and without a spring. `as_it_is`: "as it is
  /// held".
  void check_hinge(int joint, std::string_view as_it_is) const;

  /// "file:line:column" of an actuator, or of another child of a top-level section.
  std::string place_in_section(const char* tag, int number) const;
  /// The name of a joint or geom in messages, as in the file; its body's name if it has none.
  std::string name_of(mjtObj type, int id) const;

  const PartNames& parts() const { return parts_; }

 private:
  const tinyxml2::XMLElement* body_element(int body) const;
  /// The child of all top-level sections with this tag, by its number.
  const tinyxml2::XMLElement* section_element(const char* tag, int number) const;
  /// The child of a body with one of these tags, by its number among them.
  const tinyxml2::XMLElement* child(int body, int number,
                                    std::initializer_list<std::string_view> tags) const;
  [[noreturn]] void fail_at(const tinyxml2::XMLElement* element, const std::string& message) const;

  const MjcfDocument& document_;
  const PartNames& parts_;
  const mjModel& model_;
};

/// Finds the floating base, the servos' joints and the torque limits of their motors,
/// and checks them. The laws of position and velocity servos are removed. Errors: `InputError` for
/// anything that would act besides the servos: other joints, springs, several motors on a joint,
/// activations; and for limits that are not symmetric, or absent. The description may have some,
/// too, and `efforts`, by joint of the file.
void find_servos(RobotModel& robot, const RobotDescription& description,
                 const std::map<std::string, double>& efforts, const Contract& contract);

/// Finds the closed legs, if the model has connections: their hinges and motors, with limits as
/// `find_servos` has them. Axes of one leg become parallel. Errors: `InputError` for loops that are
/// not in the plane of one leg, joints that are in none, springs, and legs without one or two
/// motors.
void find_closed_legs(RobotModel& robot, const RobotDescription& description,
                      const std::map<std::string, double>& efforts, const Contract& contract);

/// Measures the closed legs at the final size and closes their loops: near the pose of the file,
/// with ends in one plane. Errors: `InputError` for points that do not meet, and for motors that do
/// not determine the wheel.
void measure_closed_legs(RobotModel& robot, std::span<const LoopSites> sites,
                         const Contract& contract);

/// The torque limit of a joint of the file, beside that of its motor (N·m); infinite without one.
double limit_of(const std::map<std::string, double>& efforts, const std::string& joint);

/// The motor of a joint, as messages have it.
struct MotorOfJoint {
  int motor = -1;
  std::string title;   ///< "motor 'left_hip'"
  std::string remedy;  ///< "actuators: {hip: {maximum_torque: …}}", a key of the YAML file
};

/// The torque limit of a motor on its joint (N·m): the control range times the gain, within the
/// force range, times the gear, and at most `most`. Position and velocity servos count with their
/// force range. Errors: `InputError` for activations, limits that are not symmetric, and none at
/// all.
double torque_limit(const mjModel& model, const MotorOfJoint& of, double most,
                    const Contract& contract);

/// Friction, viscous friction and armature of the file at one degree of freedom.
Actuator actuator_at(const mjModel& model, int dof);

/// Finds the held joints and the servos that hold them. A position servo of the file keeps its
/// gains. Others get those that `gains: lqr` gives to hips and knees, of a pendulum of the robot's
/// weight and leg length. MuJoCo simulates their rotors; the simulators add everything else.
/// Errors: `InputError` for a joint that is no hinge, has a spring or shares its body with another
/// joint, and for one without a torque limit.
void find_held(RobotModel& robot, const RobotDescription& description,
               const std::map<std::string, double>& efforts, const Contract& contract);

/// Finds the tyres. Errors: `InputError` for tyres that are not round about their wheel's axle, of
/// different radii, not on the body that the wheel's joint moves, or with a width and no sphere.
void find_tyres(RobotModel& robot, const Contract& contract);

/// Adds the spheres of the tyres' strips to the MJCF, before the tyre geoms. `robot` is compiled
/// from this MJCF.
void add_strips(MjcfDocument& document, const RobotModel& robot);

/// Finds the strips that `add_strips` added.
void find_strips(RobotModel& robot, const Contract& contract);

/// Whether body `below` is moved by what moves body `above`.
bool is_below(const mjModel& model, int below, int above);

/// Turns the base frame about its z axis until x is forward: from `forward` (x, -x, y, -y), or, if
/// this is `auto`, across the wheels' axes, with the left tyre on the left. A base with axes along
/// y stays as it is, as sides may be called otherwise. Returns the former axis that faces forward.
std::string turn_base(RobotModel& robot, std::string_view forward);

/// Whether the leg called left is on the right. Errors: `InputError` unless the tyres are side by
/// side.
bool sides_are_swapped(const RobotModel& robot, const Contract& contract);

/// Changes a compiled model to touchdown's conventions (docs/guides/robots.md), whatever its file's
/// are. Recordings, policies and estimators then need to know no other.
/// - Axes: hips and knees turn forward about −y (left) and +y (right); wheels drive forward about
///   +y (left) and −y (right).
/// - Zeros: at zero, both links of a leg point straight down.
/// - IMU: x back, y left, z down, at its own place.
/// - Contacts: the robot's parts meet the terrain and not each other. The terrain's parameters
///   count. Joint limits are MuJoCo's defaults.
/// Errors: `InputError` for joints that do not turn about the base's y axis, legs that are no open
/// chain of hip, knee and wheel, or shapes that not every engine has.
void apply_conventions(RobotModel& robot, const Contract& contract);

}  // namespace touchdown::models
