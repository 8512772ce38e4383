#include "models/robot_description.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/fields.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/resources.hpp"
#include "models/mjcf/assets.hpp"

namespace touchdown::models {

namespace {
/// Joints may turn once from any zero. The robot's own ranges are checked with its model.
constexpr double largest_angle = 6.2832;  // rad

bool is_index(std::string_view part) {
  return part.find_first_not_of("0123456789") == std::string_view::npos;
}
}  // namespace

static void describe(Fields& fields, LegActuators& actuators) {
  fields.section("hip", actuators.hip).doc("Actuators of the hips.");
  fields.section("knee", actuators.knee).doc("Actuators of the knees.");
  fields.section("wheel", actuators.wheel).doc("Actuators of the wheels.");
}

static void describe(Fields& fields, LegLengths& legs) {
  const auto length = [](double& value) {
    return [&value](Fields& leg) {
      leg("length", value, 0.2, 5.0).doc("Factor on the length of both links.");
    };
  };
  length(legs.both)(fields);
  fields.within("left", length(legs.one[0])).doc("The left leg, besides the factor of both.");
  fields.within("right", length(legs.one[1])).doc("The right leg, besides the factor of both.");
}

static void describe(Fields& fields, Stance& stance) {
  fields("hip", stance.hip, -largest_angle, largest_angle)
      .doc("rad", "Hip angle, forward positive, within the joint's range.");
  fields("knee", stance.knee, -largest_angle, largest_angle)
      .doc("rad", "Knee angle, backward positive, within the joint's range.");
}

static void describe(Fields& fields, HeldServo& servo) {
  constexpr double largest = 1e6;
  fields.optional("kp", servo.kp, 0.0, largest)
      .fallback("the position servo's of the file, or three times weight × leg length")
      .doc("N·m/rad", "Stiffness.");
  fields.optional("kd", servo.kd, 0.0, largest)
      .fallback("the position servo's of the file, or proportional to kp")
      .doc("N·m·s/rad", "Damping.");
  fields.optional("maximum_torque", servo.maximum_torque, 0.0, largest)
      .fallback("the limit of the joint's motor")
      .doc("N·m", "Largest torque.");
}

static void check_held(const Fields& fields, const std::vector<std::string>& held) {
  fields.check(held.size() <= most_held, "held",
               "expected at most " + std::to_string(most_held) + " joints");
  for (std::size_t i = 0; i < held.size(); ++i) {
    const auto found = std::find(held.begin(), held.end(), held[i]);
    fields.check_item(found == held.begin() + static_cast<std::ptrdiff_t>(i), "held", i,
                      "'" + held[i] + "' is listed twice");
  }
}

static void describe(Fields& fields, LoopKeys& loop) {
  fields.require("bodies", loop.bodies).doc("The two bodies, links of a URDF.");
  fields.check(loop.bodies.size() == 2, "bodies", "expected two bodies");
  const auto point = [&](const char* key, std::vector<double>& numbers) {
    const KeyNotes notes = fields.in_line(key, numbers);
    fields.check(numbers.size() == 3, key, "expected three numbers: x, y, z");
    constexpr double farthest = 2.0;  // m
    fields.check(std::ranges::all_of(numbers, [](double x) { return std::abs(x) <= farthest; }),
                 key, "expected a point within 2 m of the body's origin: is it in mm?");
    return notes.type("list of x, y, z");
  };
  fields.require("anchor");
  point("anchor", loop.anchor).doc("m", "The common point, in the first body.");
  if (fields.given("second_anchor", !loop.second_anchor.empty())) {
    point("second_anchor", loop.second_anchor)
        .fallback("where `anchor` is in the pose of the file")
        .doc("m", "The same point, in the second body.");
  }
}

static void describe_loops(Fields& fields, PartNames& parts) {
  fields.list_if_any("loops", parts.loops)
      .doc("Loops of closed legs, where a URDF has cut them open.");
  if (!fields.given("motors", !parts.motors[0].empty() || !parts.motors[1].empty())) return;
  fields
      .within("motors",
              [&](Fields& motors) {
                motors.require("left", parts.motors[0]).doc("Joints of the left leg's motors.");
                motors.require("right", parts.motors[1]).doc("Joints of the right leg's motors.");
              })
      .doc("Motors of closed legs, where the file has none: one or two a leg.");
}

static void describe_parts(Fields& fields, PartNames& parts) {
  const bool has_joints = std::any_of(parts.joint.begin(), parts.joint.end(),
                                      [](const std::string& name) { return !name.empty(); });
  if (fields.given("joints", has_joints)) {
    fields
        .within("joints",
                [&](Fields& joints) {
                  for (std::size_t i = 0; i < servo_count; ++i) {
                    joints.if_set(!parts.joint[i].empty(), servo_names[i], parts.joint[i])
                        .fallback("its key")
                        .doc("Joint of the MJCF.");
                  }
                })
        .doc("Names of the servos' joints in the MJCF.");
  }
  std::string hip = parts.has_hips ? "joint" : "none";
  if (fields.given("hip", !parts.has_hips)) {
    fields.choose("hip", {"joint", "none"}, hip)
        .doc("Whether legs have hips; `none` for legs of a knee and a wheel.");
  }
  parts.has_hips = hip == "joint";
  fields.if_set(!parts.held.empty(), "held", parts.held)
      .doc("Joints that servos keep at their reference, such as hip rolls.");
  check_held(fields, parts.held);
  describe_loops(fields, parts);
  if (fields.given("tyres",
                   !parts.tyre[0].empty() || !parts.tyre[1].empty() || parts.tyre_radius > 0.0)) {
    fields
        .within("tyres",
                [&](Fields& tyres) {
                  tyres.if_set(!parts.tyre[0].empty(), "left", parts.tyre[0])
                      .fallback("left_tire")
                      .doc("Geom of the left tyre, or a body with one round collider.");
                  tyres.if_set(!parts.tyre[1].empty(), "right", parts.tyre[1])
                      .fallback("right_tire")
                      .doc("Geom of the right tyre, or a body with one round collider.");
                  constexpr double largest = 1.0;
                  tyres("radius", parts.tyre_radius, 0.0, largest)
                      .doc("m", "Radius of wheels with meshes as colliders, 0 for round ones.");
                })
        .doc("Names of the tyres in the MJCF.");
  }
  fields.if_set(!parts.no_collision.empty(), "no_collision", parts.no_collision)
      .doc("Colliders that touch nothing: geoms, or bodies with all of theirs.");
  if (fields.given("forward", parts.forward != "auto")) {
    fields.choose("forward", {"auto", "x", "-x", "y", "-y"}, parts.forward)
        .doc("Axis of the base that faces forward; `auto`: across the wheels' axes.");
  }
  fields.if_set(!parts.imu.empty(), "imu", parts.imu)
      .fallback("imu")
      .doc("Site of the IMU, or a body that is fixed to the base.");
  fields.if_set(!parts.base.empty(), "base", parts.base)
      .fallback("the first link with a mass")
      .doc("Floating link of a URDF.");
}

void describe(Fields& fields, RobotDescription& robot) {
  std::string mjcf = robot.mjcf.string();
  fields.gone("urdf", "the key `mjcf` is for a URDF, too: mjcf: FILE.urdf");
  fields.require("mjcf", mjcf).doc("MJCF or URDF that this file is about, beside this file.");
  robot.mjcf = mjcf;
  describe_parts(fields, robot.parts);
  const HeldServo& servo = robot.held_servo;
  fields
      .section_if_set(servo.kp || servo.kd || servo.maximum_torque, "held_servo", robot.held_servo)
      .doc("Servos of the held joints.");
  fields("mass", robot.mass, 0.01, 100.0).doc("Factor on mass and inertia of every body.");
  fields.optional("wheel_radius", robot.wheel_radius, 0.005, 1.0)
      .fallback("as in the MJCF")
      .doc("m", "Radius of both tyres.");
  fields.section("legs", robot.legs).doc("Lengths of the legs.");
  fields.section("stance", robot.stance)
      .doc("Joint angles at the start, unless the scenario specifies them.");
  fields.section("actuators", robot.actuators)
      .doc("Actuators of both legs; absent joints stay as in the MJCF.");
  fields.know("balancer");
  fields.section("tyre", robot.tyre).doc("Contact model of both tyres.");
}

const std::optional<Actuator>& RobotDescription::actuator(Servo servo) const {
  switch (static_cast<int>(servo) % 3) {
    case 0:
      return actuators.hip;
    case 1:
      return actuators.knee;
    default:
      return actuators.wheel;
  }
}

bool is_about_an_mjcf(const std::filesystem::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

RobotDescription robot_description(const std::filesystem::path& file) {
  if (!is_about_an_mjcf(file)) {
    RobotDescription alone;
    alone.mjcf = file;
    return alone;
  }
  const YamlDocument document = YamlDocument::load(file);
  auto robot = from_yaml<RobotDescription>(document);
  robot.mjcf = file.parent_path() / robot.mjcf;
  robot.has_stance = document.root()["stance"].IsDefined();
  // Checked here, as the model may be compiled later, for the controller gains only.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(robot.mjcf, ignored)) {
    std::vector<std::string> neighbours;
    for (const char* extension : {".xml", ".urdf"}) {
      for (const auto& neighbour : resources_in(robot.mjcf.parent_path(), extension)) {
        neighbours.push_back(neighbour.filename().string());
      }
    }
    Fields(document).check(false, "mjcf",
                           robot.mjcf.string() + ": no such file" +
                               did_you_mean(robot.mjcf.filename().string(), neighbours));
  }
  return robot;
}

void RobotKeys::fail(std::string_view key, const std::string& message) const {
  const YamlDocument document = YamlDocument::load(file_);
  YAML::Node node = document.root();
  std::string shown;
  for (std::string_view rest = key; !rest.empty();) {
    const std::string part(rest.substr(0, rest.find('.')));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    const YAML::Node inner = is_index(part) ? node[std::stoul(part)] : node[part];
    if (!inner.IsDefined()) break;
    node.reset(inner);
    if (!is_index(part)) shown += (shown.empty() ? "" : ".") + part;
  }
  throw InputError(fmt::format("{}: {}: {}", document.place_of(node, key),
                               shown.empty() ? key : shown, message));
}

std::vector<std::filesystem::path> robot_files(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files = opened_files(robot_description(file).mjcf);
  if (is_about_an_mjcf(file)) files.insert(files.begin(), file);
  return files;
}

std::string robot_digest(const std::filesystem::path& file) {
  Fingerprint all;
  for (const std::filesystem::path& one : robot_files(file)) all.add(read_file(one));
  return all.text();
}

}  // namespace touchdown::models
