#include "models/contract/servos.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "models/contract/motor.hpp"
#include "models/mjcf/parts.hpp"

namespace touchdown::models {

namespace {

/// Finds the floating base body, the root of the robot.
int find_base(const mjModel& model, const Contract& contract) {
  int base = -1;
  for (int joint = 0; joint < model.njnt; ++joint) {
    if (model.jnt_type[joint] != mjJNT_FREE) continue;
    if (base >= 0) contract.fail_at_joint(joint, "expected one free joint, found several");
    base = model.jnt_bodyid[joint];
  }
  if (base < 0) contract.fail("expected a base body with a <freejoint/>");
  const int dof = model.jnt_dofadr[model.body_jntadr[base]];
  for (int i = dof; i < dof + 6; ++i) {
    if (model.dof_damping[i] != 0.0 || model.dof_armature[i] != 0.0 ||
        model.dof_frictionloss[i] != 0.0) {
      contract.fail_at_joint(model.body_jntadr[base],
                             "free joint: expected no damping, armature or frictionloss on it");
    }
  }
  return base;
}

/// The names of all hinges, for a message.
std::string found_joints(const mjModel& model) {
  std::vector<std::string> names;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const char* const name = mj_id2name(&model, mjOBJ_JOINT, joint);
    if (model.jnt_type[joint] == mjJNT_FREE || name == nullptr || is_held_name(name)) continue;
    names.emplace_back(name);
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

int find_joint(const mjModel& model, const Contract& contract, std::size_t servo) {
  const std::string name(servo_names[servo]);
  const int joint = mj_name2id(&model, mjOBJ_JOINT, name.c_str());
  if (joint < 0) {
    contract.fail(
        fmt::format("expected a hinge joint named '{}', found {} (a YAML file about this "
                    "robot may name others: joints, hip: none, held)",
                    name, found_joints(model)));
  }
  if (model.jnt_type[joint] != mjJNT_HINGE) contract.fail_at_servo(servo, "expected a hinge");
  if (model.jnt_stiffness[joint] != 0.0) {
    contract.fail_at_servo(
        servo, fmt::format("expected no spring, found stiffness {:g}", model.jnt_stiffness[joint]));
  }
  return joint;
}

void refuse_other_joints(const RobotModel& robot, const Contract& contract) {
  const mjModel& model = *robot.mj;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const char* const name = mj_id2name(&model, mjOBJ_JOINT, joint);
    const bool is_known =
        model.jnt_type[joint] == mjJNT_FREE || is_held_name(name) ||
        std::find(robot.joint.begin(), robot.joint.end(), joint) != robot.joint.end();
    if (is_known) continue;
    contract.fail_at_joint(
        joint,
        fmt::format("joint {}: expected the servos' joints alone (a YAML file about this robot may "
                    "list it under `held`)",
                    contract.name_of(mjOBJ_JOINT, joint)));
  }
}

int find_motor(const RobotModel& robot, const Contract& contract, std::size_t servo) {
  const mjModel& model = *robot.mj;
  const int motor = contract.find(mjOBJ_ACTUATOR, "motor", servo_names[servo]);
  if ((model.actuator_trntype[motor] != mjTRN_JOINT &&
       model.actuator_trntype[motor] != mjTRN_JOINTINPARENT) ||
      model.actuator_trnid[2 * motor] != robot.joint[servo]) {
    contract.fail_at_motor(servo,
                           fmt::format("expected it to drive joint '{}'", servo_names[servo]));
  }
  return motor;
}

}  // namespace

void find_servos(RobotModel& robot, const Contract& contract) {
  mjModel& model = *robot.mj;
  robot.base_body = find_base(model, contract);
  std::array<int, servo_count> motor = {-1, -1, -1, -1, -1, -1};
  robot.joint.fill(-1);
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (i % 3 == 0 && !contract.parts().has_hips) continue;
    robot.joint[i] = find_joint(model, contract, i);
    motor[i] = find_motor(robot, contract, i);
  }
  refuse_other_joints(robot, contract);
  for (std::size_t i = 0; i < servo_count; ++i) {
    robot.qpos_address[i] = robot.dof_address[i] = -1;
    if (!robot.has(i)) continue;
    const int joint = robot.joint[i];
    robot.qpos_address[i] = model.jnt_qposadr[joint];
    robot.dof_address[i] = model.jnt_dofadr[joint];
    robot.effort[i] = torque_limit(
        model, motor[i], [&](const std::string& message) { contract.fail_at_motor(i, message); });
    robot.actuator[i] = {.friction = model.dof_frictionloss[robot.dof_address[i]],
                         .viscous = model.dof_damping[robot.dof_address[i]],
                         .armature = model.dof_armature[robot.dof_address[i]]};
  }
  for (int i = 0; i < model.nu; ++i) {
    const char* const name = mj_id2name(&model, mjOBJ_ACTUATOR, i);
    if (is_held_name(name)) continue;
    if (std::find(motor.begin(), motor.end(), i) == motor.end()) {
      contract.fail_at_actuator(
          i, fmt::format("actuator {}: expected one motor for each servo, and no other",
                         name == nullptr ? "without a name" : fmt::format("'{}'", name)));
    }
    // The servos' law is touchdown's: MuJoCo must not add that of the file.
    if (remove_law(model, i)) {
      robot.ignored.push_back(fmt::format("{}: actuator '{}': its own law; its forcerange counts",
                                          contract.place_of_actuator(i), name));
    }
  }
}

}  // namespace touchdown::models
