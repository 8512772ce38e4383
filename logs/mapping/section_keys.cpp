#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "logs/mapping/mapping_reader.hpp"

namespace touchdown::logs {

namespace {

constexpr const char* six_joints = "left hip, knee, wheel, right hip, knee, wheel";
constexpr const char* four_joints = "left knee, wheel, right knee, wheel";

/// Inserts a number that is 0 at this place in each leg: a hip or knee that the robot lacks.
void add_missing(MappedSignal& signal, std::ptrdiff_t place) {
  if (signal.numbers.empty()) return;  // documenting
  const MappedSignal::Number none{MappedSignal::no_column};
  const auto right = static_cast<std::ptrdiff_t>(signal.numbers.size() / 2);
  signal.numbers.insert(signal.numbers.begin() + right + place, none);
  signal.numbers.insert(signal.numbers.begin() + place, none);
}

/// The names of the joints, of which a topic's columns follow, and their signs.
SignalKind describe_joint_names(Fields& fields, MappingReader& reader, SignalKind kind) {
  if (fields.present("names", false)) {
    fields("names", kind.names)
        .fallback("none")
        .doc(
            "Names of the left hip, knee, wheel, right hip, knee, wheel. Joints are then found by "
            "name in each message of a topic and in each row of a CSV file with the columns "
            "name[0], position[0], …; other files need columns NAME/position, NAME/velocity and "
            "NAME/effort.");
    fields.check(kind.names.size() == kind.count, "names",
                 fmt::format("expected {}: {}", kind.count, kind.what));
    const std::vector<std::string>& columns = reader.names().names;
    const bool is_nameless = reader.names().is_topic && !reader.names().has_joint_names &&
                             std::ranges::find(columns, "position[0]") != columns.end();
    fields.check(!is_nameless || fields.present("position", false), "names",
                 fmt::format("names are empty in the messages of {0}; give positions by index: "
                             "position: {{from: position, index: [{1} numbers from 0]}}, velocity: "
                             "{{from: velocity, index: …}}, torque: {{from: effort, index: …}}",
                             reader.names().file, kind.count));
    const bool has_names =
        reader.names().has_joint_names ||
        std::any_of(columns.begin(), columns.end(),
                    [](const std::string& column) { return column.ends_with("/position"); });
    fields.check(has_names || fields.documenting() || fields.present("position", false), "names",
                 fmt::format("{} has neither columns NAME/position nor the joints' names in its "
                             "rows (name[0], …): map its columns by hand, position: {{from: [{} "
                             "columns]}}, and velocity and torque alike",
                             reader.names().file, kind.count));
  }
  std::string known;
  for (const std::string& name : reader.names().names) {
    if (name.ends_with("/position")) known += ", " + name.substr(0, name.rfind('/'));
  }
  const bool is_needed = reader.names().has_joint_names && !fields.present("position", false);
  fields.check(
      !is_needed || !kind.names.empty(), "",
      fmt::format("'names' is missing: expected the joints' names, {}; {} has {}", kind.what,
                  reader.names().file, known.substr(std::min<std::size_t>(2, known.size()))));
  sign_for_each(fields, kind.count, kind.signs)
      .doc("Sign of all joints, or of each, where a signal has none of its own.");
  if (fields.documenting()) kind.names.clear();
  return kind;
}

/// Reads gains of hips and knees. A joint without a hip has none.
void describe_gains(Fields& fields, const std::string& key, bool has_hips, const char* unit,
                    const char* doc, std::array<double, 4>& gains) {
  std::vector<double> given;
  number_for_each(fields, key, has_hips ? 4 : 2, given).range("≥ 0").doc(unit, doc);
  if (given.empty()) return;
  for (const double gain : given) {
    fields.check(std::isfinite(gain) && gain >= 0.0, key, "expected gains that are not negative");
  }
  gains = has_hips ? std::array{given[0], given[1], given[2], given[3]}
                   : std::array{given[0], given[0], given[1], given[1]};
}

void describe_leg_targets(Fields& fields, MappingReader& reader, bool has_hips,
                          LogMapping& mapping) {
  if (!fields.present("leg_targets", false)) return;
  MappedLegTargets& targets = mapping.leg_targets.emplace();
  const SignalKind joints{has_hips ? "left hip, knee, right hip, knee" : "left knee, right knee",
                          has_hips ? 4U : 2U};
  const auto kind = [&](const std::vector<Unit>& units, bool has_zero = false) {
    SignalKind one = joints;
    one.units = units;
    one.has_zero = has_zero;
    return one;
  };
  const auto describe_targets = [&](Fields& inner) {
    reader.require(inner, "position", kind(angles(), true), targets.position)
        .doc("Commanded positions, with the signs and zeros of the joints.");
    reader.optional(inner, "velocity", kind(speeds()), targets.velocity)
        .doc("Commanded velocities; 0 without this key.");
    reader.optional(inner, "torque", kind(torques()), targets.torque)
        .doc("Feed-forward torques; 0 without this key.");
    inner.require("kp");
    describe_gains(inner, "kp", has_hips, "N·m/rad", "Position gains of the servos.", targets.kp);
    describe_gains(inner, "kd", has_hips, "N·m·s/rad", "Velocity gains of the servos.", targets.kd);
    if (has_hips) return;
    add_missing(targets.position, 0);
    if (targets.velocity) add_missing(*targets.velocity, 0);
    if (targets.torque) add_missing(*targets.torque, 0);
  };
  fields.within("leg_targets", describe_targets)
      .fallback("none")
      .doc("Commands of the servos of hips and knees, for the load by the servos' laws.");
}

/// Reads the file of a robot with closed legs, beside the mapping file.
void describe_closed_legs(Fields& fields, LogMapping& mapping) {
  std::string robot;
  if (!fields.present("closed_legs", false)) return;
  fields("closed_legs", robot)
      .fallback("none")
      .doc(
          "File of a robot with closed loops in its legs, beside this one. The joints are then its "
          "motors and wheels, with the signs and zeros of its file; `check` of the robot prints "
          "their order.");
  if (fields.documenting()) return;
  try {
    mapping.closed_legs = std::make_shared<MotorsToLegs>(mapping.folder / robot);
  } catch (const InputError& error) {
    fields.check(false, "closed_legs", error.what());
  }
}

}  // namespace

void describe_joints(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  std::size_t hip = 0;
  fields.choose("hip", {"joint", "none"}, hip)
      .doc(
          "`none`: the robot has knees and wheels only; four joints are mapped, and the hips are "
          "0.");
  const bool has_hips = hip == 0;
  describe_closed_legs(fields, mapping);
  SignalKind all{has_hips ? six_joints : four_joints, has_hips ? 6U : 4U};
  if (mapping.closed_legs) {
    all = {mapping.closed_legs->joints(), 2 * (mapping.closed_legs->motors_per_leg() + 1)};
    fields.check(has_hips, "hip", "expected none beside 'closed_legs'");
    fields.check(!fields.present("leg_targets", false), "leg_targets",
                 "expected none beside 'closed_legs': they are for hips and knees with motors");
  }
  const SignalKind joints = describe_joint_names(fields, reader, all);
  const auto kind = [&](const char* field, const std::vector<Unit>& units, bool has_zero = false) {
    SignalKind one = joints;
    one.units = units;
    one.has_zero = has_zero;
    for (std::string& name : one.names) name += field;
    return one;
  };
  reader.require(fields, "position", kind("/position", angles(), true), mapping.position)
      .doc("Joint positions.");
  reader.require(fields, "velocity", kind("/velocity", speeds()), mapping.velocity)
      .doc("Joint velocities.");
  reader.require(fields, "torque", kind("/effort", torques()), mapping.torque)
      .doc("Joint torques.");
  for (MappedSignal* signal : {&mapping.position, &mapping.velocity, &mapping.torque}) {
    if (!has_hips) add_missing(*signal, 0);
    if (joints.count == 4 && mapping.closed_legs) add_missing(*signal, 1);
  }
  reader
      .optional(fields, "wheel_velocity_target", {"left wheel, right wheel", 2, speeds()},
                mapping.wheel_velocity_target)
      .doc("Commanded velocities of the wheels; only `nmn` uses them.");
  describe_leg_targets(fields, reader, has_hips, mapping);
}

namespace {

Eigen::Matrix3d rotation_of_angles(const std::vector<double>& angles, double unit) {
  return (Eigen::AngleAxisd(unit * angles[2], Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(unit * angles[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(unit * angles[0], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

void describe_mounting(Fields& fields, Eigen::Matrix3d& axes) {
  std::vector<double> quaternion;
  std::vector<double> angles;
  std::size_t unit = 0;
  const bool has_quaternion = fields.present("quaternion", false);
  const bool has_angles = fields.present("rpy", false);
  if (has_quaternion) {
    fields.in_line("quaternion", quaternion)
        .range("four numbers of length 1")
        .fallback("none")
        .doc("w, x, y, z.");
  }
  if (has_angles) {
    fields.in_line("rpy", angles)
        .range("three numbers")
        .fallback("none")
        .doc("Roll, pitch and yaw, instead of `quaternion`.");
  }
  fields.choose("unit", {"rad", "deg"}, unit).doc("Unit of roll, pitch and yaw.");
  if (fields.documenting()) return;
  fields.check(has_quaternion != has_angles, "",
               "expected either 'quaternion' (w, x, y, z) or 'rpy' (roll, pitch, yaw)");
  Eigen::Matrix3d to_robot = Eigen::Matrix3d::Identity();
  if (has_quaternion) {
    fields.check(quaternion.size() == 4, "quaternion", "expected w, x, y, z");
    const Eigen::Quaterniond q(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
    constexpr double tolerance = 0.02;
    fields.check(std::abs(q.norm() - 1.0) <= tolerance, "quaternion",
                 "expected four numbers of length 1: w, x, y, z");
    to_robot = q.normalized().toRotationMatrix();
  } else {
    constexpr double degree = 3.14159265358979323846 / 180.0;
    fields.check(angles.size() == 3, "rpy", "expected roll, pitch and yaw");
    for (const double angle : angles) fields.check(std::isfinite(angle), "rpy", "expected angles");
    to_robot = rotation_of_angles(angles, unit == 1 ? degree : 1.0);
  }
  // From forward, left, up to back, left, down.
  axes = Eigen::Vector3d(-1.0, 1.0, -1.0).asDiagonal() * to_robot;
}

}  // namespace touchdown::logs
