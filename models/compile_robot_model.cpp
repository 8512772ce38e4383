#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/error.hpp"
#include "models/contract.hpp"
#include "models/mjcf/compiler.hpp"
#include "models/resizing.hpp"
#include "models/robot_description.hpp"
#include "models/robot_draft.hpp"
#include "models/robot_model.hpp"
#include "models/robot_source.hpp"
#include "models/scene_mjcf.hpp"
#include "models/stance.hpp"

namespace touchdown::models {
namespace {

void require_mjcf(const MjcfDocument& document) {
  const tinyxml2::XMLElement& root = document.root();
  if (std::strcmp(root.Name(), "mujoco") == 0 && root.FirstChildElement() != nullptr) return;
  const bool is_sdf = std::strcmp(root.Name(), "sdf") == 0;
  document.fail(root,
                fmt::format("{}: expected a robot in <mujoco>...</mujoco>, or the <robot> of "
                            "a URDF{}",
                            root.Name(), is_sdf ? ": SDF is not read, convert it first" : ""));
}

}  // namespace

RobotFile robot_file(const RobotDescription& description, const RobotKeys& keys) {
  RobotFile robot{MjcfDocument::load(description.mjcf), {}, {}};
  FileFindings& findings = robot.findings;
  if (std::strcmp(robot.document.root().Name(), "robot") == 0) {
    robot.document = converted_urdf(description.mjcf, description.parts.base, findings);
  }
  require_mjcf(robot.document);
  keep_robot_only(robot.document, findings);
  robot.loops = complete_loops(robot.document, description.parts, findings, keys);
  translate_later_versions(robot.document, findings);
  note_computed_masses(robot.document, findings);
  drop_missing_assets(robot.document, findings);
  return robot;
}

MjModelPtr compile(const RobotFile& robot, const Terrain& terrain) {
  return compile_xml(robot.document.text(scene_mjcf(terrain)), robot.document.file());
}

namespace {

/// Sets the actuators of the robot's file in the model. MuJoCo simulates the rotor inertia; the
/// simulators add everything else (simulators/actuators.hpp).
void set_actuators(RobotModel& robot, const RobotDescription& description, const RobotKeys& keys) {
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (const auto& given = description.actuator(static_cast<Servo>(i))) robot.actuator[i] = *given;
    if (robot.motor_joint[i] < 0) continue;
    if (robot.actuator[i].backlash > 0.0 && robot.closed_leg[i / 3] && i % 3 != 2) {
      keys.fail("actuators", "expected no backlash of hips and knees for legs with closed loops");
    }
    const int dof = robot.mj->jnt_dofadr[robot.motor_joint[i]];
    robot.effort[i] = std::min(robot.effort[i], robot.actuator[i].maximum_torque);
    robot.mj->dof_armature[dof] = robot.actuator[i].armature;
    robot.mj->dof_damping[dof] = 0.0;
    robot.mj->dof_frictionloss[dof] = 0.0;
  }
  if (std::any_of(robot.actuator.begin(), robot.actuator.end(),
                  [](const Actuator& actuator) { return actuator.armature != 0.0; })) {
    recompute(*robot.mj);
  }
}

/// Sets the size that the robot's file specifies.
void set_size(RobotModel& robot, const RobotDescription& description, const RobotKeys& keys) {
  const double wheels = description.wheel_radius.value_or(robot.wheel_radius) / robot.wheel_radius;
  bool changed = description.mass != 1.0 || wheels != 1.0;
  if (description.mass != 1.0) scale_mass(*robot.mj, description.mass);
  if (wheels != 1.0) {
    scale_wheels(*robot.mj, wheels);
    robot.wheel_radius *= wheels;
  }
  for (std::size_t leg = 0; leg < description.legs.one.size(); ++leg) {
    const double length = description.legs.both * description.legs.one[leg];
    if (length == 1.0) continue;
    if (robot.closed_leg[leg]) keys.fail("legs", "expected none for a leg with closed loops");
    try {
      scale_leg(*robot.mj, leg, length);
    } catch (const InputError& error) {
      keys.fail("legs", error.what());
    }
    changed = true;
  }
  if (changed) recompute(*robot.mj);
}

/// Checks that engines can take the inertias and places of the robot's bodies, geoms and sites.
void check_places(const mjModel& model, const Contract& contract) {
  const auto message = [](const mjtNum* position, const mjtNum* orientation, int i) -> std::string {
    const double distance = vector_at(position, i).norm();
    if (!(distance <= 100.0)) {
      return fmt::format("expected a place within 100 m of its parent, found {:g} m", distance);
    }
    const double length = quaternion_at(orientation, i).norm();
    if (std::abs(length - 1.0) < 1e-3) return "";
    return fmt::format("expected an orientation, found a quaternion of length {:g}", length);
  };
  for (int i = 1; i < model.nbody; ++i) {
    const std::string text = message(model.body_pos, model.body_quat, i);
    if (!text.empty()) contract.fail_at_body(i, "body: " + text);
    const double inertia = vector_at(model.body_inertia, i).maxCoeff();
    constexpr double widest = 2.0;  // m, radius of gyration
    if (inertia <= widest * widest * model.body_mass[i]) continue;
    contract.fail_at_body(
        i, fmt::format("body '{}': its inertia, {:.3g} kg·m² with a mass of {:.3g} kg, is that of "
                       "a ring of {:.3g} m radius: expected kg·m² and kg",
                       name_of(model, mjOBJ_BODY, i), inertia, model.body_mass[i],
                       std::sqrt(inertia / model.body_mass[i])));
  }
  for (int i = 0; i < model.ngeom; ++i) {
    const bool is_robots = model.geom_bodyid[i] > 0;
    const std::string text = is_robots ? message(model.geom_pos, model.geom_quat, i) : "";
    if (!text.empty()) contract.fail_at_geom(i, "geom: " + text);
  }
  for (int i = 0; i < model.nsite; ++i) {
    const std::string text = message(model.site_pos, model.site_quat, i);
    if (!text.empty()) contract.fail_at_site(i, "site: " + text);
  }
}

/// Looks up the robot's parts in the model of its file.
RobotModel with_parts(MjModelPtr mj, const RobotDescription& description,
                      const FileFindings& findings, const Contract& contract) {
  RobotModel robot;
  robot.mj = std::move(mj);
  robot.tyre = description.tyre;
  robot.name = robot.mj->names;  // the model's own name comes first
  check_places(*robot.mj, contract);
  find_servos(robot, description, findings.effort, contract);
  find_tyres(robot, contract);
  return robot;
}

/// Checks that the joints can have the stance that the robot's file gives.
void check_stance(const RobotModel& robot, const RobotDescription& description,
                  const RobotKeys& keys) {
  if (!description.has_stance) return;
  const auto error = stance_error(robot, from_straight(robot, description.stance), true);
  if (error) keys.fail("stance." + error->key, error->message);
}

}  // namespace

RobotModel compile_robot_model(const std::filesystem::path& file, const Terrain& terrain,
                               const std::optional<Tyre>& tyre) {
  RobotDescription description = robot_description(file);
  if (tyre) description.tyre = *tyre;
  const RobotKeys keys(file);
  RobotFile source = robot_file(description, keys);
  PartNames& parts = description.parts;
  name_parts(source.document, parts, source.findings, keys);
  require_none(source.findings.complaints);
  MjModelPtr mj = compile(source, terrain);
  const Contract contract(source.document, parts, *mj);
  RobotModel robot = with_parts(std::move(mj), description, source.findings, contract);
  const std::string forward = turn_base(robot, parts.forward);
  if (forward != "x") {
    source.findings.ignored.push_back(
        fmt::format("{}: the base's own axes: it faces {}, and is turned to face x (key `forward`)",
                    description.mjcf.string(), forward));
  }
  const bool swapped = sides_are_swapped(robot, contract);
  const bool has_strips = description.tyre.strips().size() > 1;
  if (swapped) {
    swap_sides(source.document);
    for (std::size_t i = 0; i < servo_count; ++i) parts.joint[i] = own_name(parts, i);
    std::swap_ranges(parts.joint.begin(), parts.joint.begin() + 3, parts.joint.begin() + 3);
    std::swap(parts.tyre[0], parts.tyre[1]);
  }
  // Strips are added at the file's size; the description then scales them, too.
  if (has_strips) add_strips(source.document, robot);
  if (swapped || has_strips) {
    MjModelPtr again = compile(source, terrain);
    const Contract renewed(source.document, parts, *again);
    robot = with_parts(std::move(again), description, source.findings, renewed);
    (void)turn_base(robot, forward);
    if (has_strips) find_strips(robot, renewed);
  }
  const Contract final_contract(source.document, parts, *robot.mj);
  for (std::size_t i = 0; i < servo_count; ++i) {
    robot.joint_name[i] = own_name(parts, i);  // a swapped leg keeps the file's name
  }
  robot.ignored.insert(robot.ignored.begin(), source.findings.ignored.begin(),
                       source.findings.ignored.end());
  robot.warnings = source.findings.warnings;
  apply_conventions(robot, final_contract);
  find_closed_legs(robot, description, source.findings.effort, final_contract);
  set_actuators(robot, description, keys);
  set_size(robot, description, keys);
  measure_closed_legs(robot, source.loops, final_contract);
  check_stance(robot, description, keys);
  find_held(robot, description, source.findings.effort, final_contract);
  return robot;
}

}  // namespace touchdown::models
