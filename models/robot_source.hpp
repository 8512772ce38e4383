#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "models/mjcf/document.hpp"
#include "models/mjcf/robot_file.hpp"
#include "models/mjcf/types.hpp"
#include "models/robot_description.hpp"
#include "models/robot_model.hpp"
#include "models/terrain.hpp"

namespace touchdown::models {

/// Reads the file of a description. Errors: `InputError` for what is no robot, or cannot be
/// simulated.
RobotFile robot_file(const RobotDescription& description, const RobotKeys& keys);

/// Completes the loops of closed legs: those of the YAML file become <connect>s. Connections of
/// sites, as MuJoCo 3 has them, become ones of their bodies. Errors: `InputError` for names that
/// the MJCF does not have.
void complete_loops(RobotFile& robot, const PartNames& parts, const RobotKeys& keys);

/// Compiles a robot's file with a terrain. Errors: those of `compile_xml`.
MjModelPtr compile(const RobotFile& robot, const Terrain& terrain);

/// An element of a compiled model.
struct Part {
  mjtObj type = mjOBJ_UNKNOWN;
  int id = -1;
};

/// A compiled robot with its file and its description. Parts are found by the names that the
/// author gave them. Messages have the place of an element in the robot's file, or of a key in the
/// YAML file about it.
class RobotSource {
 public:
  RobotSource(const RobotFile& robot, const RobotDescription& description, const RobotKeys& keys,
              const mjModel& model)
      : robot_(robot), description_(description), keys_(keys), model_(model) {}

  const RobotDescription& description() const { return description_; }
  const PartNames& parts() const { return description_.parts; }
  const RobotKeys& keys() const { return keys_; }

  /// The first element with a name that the YAML file gives under `key`. Errors: `InputError` if
  /// no element of these types has it, with the nearest name.
  Part named(std::initializer_list<mjtObj> types, const std::string& name,
             std::string_view key) const;
  /// The joint of such a name.
  int joint(const std::string& name, std::string_view key) const;
  /// The joint of a motor, and the first motor of a joint; −1 without one.
  int joint_of(int motor) const;
  int motor_of(int joint) const;
  /// The torque limit of a joint in the file, beside that of its motor (N·m); infinite without one.
  double limit_of(int joint) const;

  /// An error about the robot as a whole, at its base or its root.
  [[noreturn]] void fail(const std::string& message) const;
  /// An error about an element of the model: a body, joint, geom, site, actuator or equality.
  [[noreturn]] void fail_at(Part part, const std::string& message) const;
  /// The same about a joint: "joint 'left_hip': …", and about a connection.
  [[noreturn]] void fail_at_hinge(int joint, const std::string& message) const;
  [[noreturn]] void fail_at_equality(int equality, const std::string& message) const;
  /// Checks that a joint is a hinge, alone on its body and without a spring. `as_it_is`: "as it is
  /// held".
  void check_hinge(int joint, std::string_view as_it_is) const;

  /// "file:line:column" of an element, or of the robot's root.
  std::string place_of(Part part) const;
  /// "'left_hip'", or for an element without a name that of its body.
  std::string title_of(Part part) const;
  /// The element in the robot's file; null if it is not there.
  tinyxml2::XMLElement* element_of(Part part) const;

 private:
  int body_of(Part part) const;

  const RobotFile& robot_;
  const RobotDescription& description_;
  const RobotKeys& keys_;
  const mjModel& model_;
};

/// The name of an element; empty without one.
std::string name_of(const mjModel& model, mjtObj type, int id);

/// The names that the robot's author gave to the joints, geoms, sites or bodies of a model.
std::vector<std::string> names_of(const mjModel& model, mjtObj type);

/// Whether a joint is one of the robot's held ones.
bool is_held(const RobotModel& robot, int joint);

/// Finds the floating base, the joints of the servos and the held joints by the names of the YAML
/// file, or those of the contract. The laws of the file's servos are removed from the model; held
/// joints keep the gains. Errors: `InputError` for anything that would act besides the servos:
/// other joints, springs, several motors on a joint.
void find_joints(RobotModel& robot, const RobotSource& source);

/// Finds the torque limits of the servos: of motors, joints and the description. Errors:
/// `InputError` for activations, and for limits that are not symmetric, or absent.
void find_limits(RobotModel& robot, const RobotSource& source);

/// Finds the closed legs, if the model has connections: their hinges and motors, with limits as
/// `find_limits` has them. Axes of one leg become parallel. Errors: `InputError` for loops that are
/// not in the plane of one leg, joints that are in none, springs, and legs without one or two
/// motors.
void find_closed_legs(RobotModel& robot, const RobotSource& source);

/// Measures the closed legs at the final size and closes their loops: near the pose of the file,
/// with ends in one plane. Errors: `InputError` for points that do not meet, and for motors that do
/// not determine the wheel.
void measure_closed_legs(RobotModel& robot, const RobotSource& source);

/// The torque limit of a joint (N·m): the control range of its motor times the gain, within the
/// force range, times the gear, and at most `most` and the joint's own limit. Position and velocity
/// servos count with their force range. `remedy`: a key of the YAML file, for messages. Errors:
/// `InputError` for activations, limits that are not symmetric, and none at all.
double torque_limit(const mjModel& model, int joint, double most, const std::string& remedy,
                    const RobotSource& source);
/// The same of a servo's motor, which is on `joint`.
double torque_limit(const mjModel& model, int joint, std::size_t servo, const RobotSource& source);

/// Friction, viscous friction and armature of the file at one degree of freedom.
Actuator actuator_at(const mjModel& model, int dof);

/// Completes the servos of the held joints. A position servo of the file keeps its gains. Others
/// get those that `gains: lqr` gives to hips and knees, of a pendulum of the robot's weight and leg
/// length. MuJoCo simulates their rotors; the simulators add everything else. Errors: `InputError`
/// for a joint that is no hinge, has a spring or shares its body with another joint, and for one
/// without a torque limit.
void complete_held(RobotModel& robot, const RobotSource& source);

/// Whether body `below` is moved by what moves body `above`.
bool is_below(const mjModel& model, int below, int above);

/// Lets the parts of `no_collision` touch nothing, and finds the tyres: as named, or the largest
/// round collider of each wheel. Errors: `InputError` for tyres that are not round about their
/// wheel's axle, of different radii, not on the body that the wheel's joint moves, or with a width
/// and no sphere.
void find_tyres(RobotModel& robot, const RobotSource& source);

/// Inserts the tyres of `tyres: {radius: …}` as spheres in the robot's file; `find_tyres` moves
/// them to the axles.
void add_spheres(MjcfDocument& document, const PartNames& parts);

/// Adds the spheres of the tyres' strips to the file, before the tyres. `robot` is compiled from
/// it.
void add_strips(MjcfDocument& document, const RobotModel& robot, const RobotSource& source);

/// Finds the strips that `add_strips` added.
void find_strips(RobotModel& robot);

/// Finds the IMU: a site, or a body. Errors: `InputError` unless it is fixed to the base.
void find_imu(RobotModel& robot, const RobotSource& source);

/// Turns the base frame about its z axis until x is forward: from `forward` (x, -x, y, -y), or, if
/// this is `auto`, across the wheels' axes, with the left tyre on the left. A base with axes along
/// y stays as it is, as sides may be called otherwise. Returns the former axis that faces forward.
std::string turn_base(RobotModel& robot, std::string_view forward);

/// Exchanges the legs if the one called left is on the right. Errors: `InputError` unless the tyres
/// are side by side.
void order_sides(RobotModel& robot, const RobotSource& source);

/// Changes a compiled model to touchdown's conventions (docs/guides/robots.md), whatever its file's
/// are. Recordings, policies and estimators then need to know no other.
/// - Axes: hips and knees turn forward about −y (left) and +y (right); wheels drive forward about
///   +y (left) and −y (right).
/// - Zeros: at zero, both links of a leg point straight down.
/// - Contacts: the robot's parts meet the terrain and not each other. The terrain's parameters
///   count. Joint limits are MuJoCo's defaults.
/// Errors: `InputError` for joints that do not turn about the base's y axis, legs that are no open
/// chain of hip, knee and wheel, or shapes that not every engine has.
void apply_conventions(RobotModel& robot, const RobotSource& source);

}  // namespace touchdown::models
