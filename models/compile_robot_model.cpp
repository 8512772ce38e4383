#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "models/mjcf/compiler.hpp"
#include "models/resizing.hpp"
#include "models/robot_model.hpp"
#include "models/robot_source.hpp"
#include "models/scene_mjcf.hpp"
#include "models/stance.hpp"

namespace touchdown::models {

RobotFile robot_file(const RobotDescription& description, const RobotKeys& keys) {
  MjcfDocument document = MjcfDocument::load(description.mjcf);
  const bool is_urdf = std::string_view(document.root().Name()) == "robot";
  RobotFile robot = is_urdf ? converted_urdf(std::move(document), description.parts.base)
                            : RobotFile{std::move(document)};
  keep_robot_only(robot);
  complete_loops(robot, description.parts, keys);
  translate_later_versions(robot);
  note_computed_masses(robot);
  drop_missing_assets(robot);
  return robot;
}

MjModelPtr compile(const RobotFile& robot, const Terrain& terrain) {
  MjModelPtr model = compile_xml(robot.document, robot.loops + scene_mjcf(terrain));
  for (std::size_t loop = 0; loop < robot.ends.size(); ++loop) {
    mjtNum* const anchor = &model->eq_data[mjNEQDATA * loop];
    const LoopEnds& ends = robot.ends[loop];
    for (std::size_t i = 0; i < ends.sites.size(); ++i) {
      if (ends.sites[i].empty()) continue;
      const int site = mj_name2id(model.get(), mjOBJ_SITE, ends.sites[i].c_str());
      std::copy_n(&model->site_pos[3 * site], 3, anchor + 3 * i);
    }
    std::ranges::copy(ends.second_anchor, anchor + 3);
  }
  return model;
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
  if (wheels != 1.0) scale_wheels(robot, wheels);
  for (std::size_t leg = 0; leg < description.legs.one.size(); ++leg) {
    const double length = description.legs.both * description.legs.one[leg];
    if (length == 1.0) continue;
    if (robot.closed_leg[leg]) keys.fail("legs", "expected none for a leg with closed loops");
    try {
      scale_leg(robot, leg, length);
    } catch (const InputError& error) {
      keys.fail("legs", error.what());
    }
    changed = true;
  }
  if (changed) recompute(*robot.mj);
}

/// Checks that engines can take the inertias and places of the robot's bodies, geoms and sites.
void check_places(const mjModel& model, const RobotSource& source) {
  const auto check = [&](Part part, int body, const mjtNum* position, const mjtNum* orientation) {
    if (body == 0) return;  // the terrain's
    const double distance = vector_at(position, part.id).norm();
    const double length = quaternion_at(orientation, part.id).norm();
    const bool is_near = distance <= 100.0;
    if (is_near && std::abs(length - 1.0) < 1e-3) return;
    source.fail_at(
        part,
        fmt::format(
            "{}: expected {}", mju_type2Str(part.type),
            is_near ? fmt::format("an orientation, found a quaternion of length {:g}", length)
                    : fmt::format("a place within 100 m of its parent, found {:g} m", distance)));
  };
  for (int i = 1; i < model.nbody; ++i) {
    check({mjOBJ_BODY, i}, i, model.body_pos, model.body_quat);
    const double inertia = vector_at(model.body_inertia, i).maxCoeff();
    constexpr double widest = 2.0;  // m, radius of gyration
    if (inertia <= widest * widest * model.body_mass[i]) continue;
    source.fail_at(
        {mjOBJ_BODY, i},
        fmt::format("body '{}': its inertia, {:.3g} kg·m² with a mass of {:.3g} kg, is that of "
                    "a ring of {:.3g} m radius: expected kg·m² and kg",
                    name_of(model, mjOBJ_BODY, i), inertia, model.body_mass[i],
                    std::sqrt(inertia / model.body_mass[i])));
  }
  for (int i = 0; i < model.ngeom; ++i) {
    check({mjOBJ_GEOM, i}, model.geom_bodyid[i], model.geom_pos, model.geom_quat);
  }
  for (int i = 0; i < model.nsite; ++i) {
    check({mjOBJ_SITE, i}, model.site_bodyid[i], model.site_pos, model.site_quat);
  }
}

/// Looks up the robot's parts in the model of its file.
RobotModel with_parts(MjModelPtr mj, const RobotSource& source) {
  RobotModel robot;
  robot.mj = std::move(mj);
  robot.tyre = source.description().tyre;
  robot.name = robot.mj->names;  // the model's own name comes first
  check_places(*robot.mj, source);
  find_joints(robot, source);
  find_limits(robot, source);
  find_tyres(robot, source);
  return robot;
}

/// Checks that the joints can have the stance that the robot's file gives.
void check_stance(const RobotModel& robot, const RobotSource& source) {
  const RobotDescription& description = source.description();
  if (!description.has_stance) return;
  const auto error = stance_error(robot, from_straight(robot, description.stance), true);
  if (error) source.keys().fail("stance." + error->key, error->message);
}

}  // namespace

RobotModel compile_robot_model(const std::filesystem::path& path, const Terrain& terrain,
                               const std::optional<Tyre>& tyre) {
  RobotDescription description = robot_description(path);
  if (tyre) description.tyre = *tyre;
  const RobotKeys keys(path);
  RobotFile file = robot_file(description, keys);
  add_spheres(file.document, description.parts);
  const auto found = [&] {
    MjModelPtr mj = compile(file, terrain);
    const RobotSource source(file, description, keys, *mj);
    return with_parts(std::move(mj), source);
  };
  RobotModel robot = found();
  if (description.tyre.strips().size() > 1) {
    // Strips are added at the file's size; the description then scales them, too.
    add_strips(file.document, robot, RobotSource(file, description, keys, *robot.mj));
    robot = found();
    find_strips(robot);
  }
  const RobotSource source(file, description, keys, *robot.mj);
  const std::string forward = turn_base(robot, description.parts.forward);
  if (forward != "x") {
    file.ignored.push_back(
        fmt::format("{}: the base's own axes: it faces {}, and is turned to face x (key `forward`)",
                    description.mjcf.string(), forward));
  }
  order_sides(robot, source);
  robot.ignored.insert(robot.ignored.begin(), file.ignored.begin(), file.ignored.end());
  robot.warnings = file.warnings;
  apply_conventions(robot, source);
  find_imu(robot, source);
  find_closed_legs(robot, source);
  set_actuators(robot, description, keys);
  set_size(robot, description, keys);
  measure_closed_legs(robot, source);
  check_stance(robot, source);
  complete_held(robot, source);
  return robot;
}

}  // namespace touchdown::models
