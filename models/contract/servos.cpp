#include "models/contract/servos.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace touchdown::models {

namespace {

/// Finds the floating base body, the root of the robot.
int find_base(const mjModel& model, const Contract& contract) {
  int base = -1;
  for (int joint = 0; joint < model.njnt; ++joint) {
    if (model.jnt_type[joint] != mjJNT_FREE) continue;
    if (base >= 0) contract.fail("expected one free joint, found several");
    base = model.jnt_bodyid[joint];
  }
  if (base < 0) contract.fail("expected a base body with a <freejoint/>");
  const int dof = model.jnt_dofadr[model.body_jntadr[base]];
  for (int i = dof; i < dof + 6; ++i) {
    if (model.dof_damping[i] != 0.0 || model.dof_armature[i] != 0.0 ||
        model.dof_frictionloss[i] != 0.0) {
      contract.fail("free joint: expected no damping, armature or frictionloss on it");
    }
  }
  return base;
}

/// The names of all hinges, for a message.
std::string found_joints(const mjModel& model) {
  std::vector<std::string> names;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const char* const name = mj_id2name(&model, mjOBJ_JOINT, joint);
    if (model.jnt_type[joint] != mjJNT_FREE && name != nullptr) names.emplace_back(name);
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
  if (model.jnt_type[joint] != mjJNT_HINGE) contract.fail_at_joint(servo, "expected a hinge");
  if (model.jnt_stiffness[joint] != 0.0) {
    contract.fail_at_joint(
        servo, fmt::format("expected no spring, found stiffness {:g}", model.jnt_stiffness[joint]));
  }
  return joint;
}

void refuse_other_joints(const RobotModel& robot, const Contract& contract) {
  const mjModel& model = *robot.mj;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const bool is_known =
        model.jnt_type[joint] == mjJNT_FREE ||
        std::find(robot.joint.begin(), robot.joint.end(), joint) != robot.joint.end();
    if (is_known) continue;
    const char* const name = mj_id2name(&model, mjOBJ_JOINT, joint);
    contract.fail_at(
        "joint", name == nullptr ? "" : name,
        fmt::format("joint {}: expected the servos' joints alone (a YAML file about this robot may "
                    "list it under `held`)",
                    contract.name_of(mjOBJ_JOINT, joint)));
  }
}

/// The upper end of a range that must be symmetric.
double symmetric(const mjtNum* range, const char* what, std::size_t servo,
                 const Contract& contract) {
  constexpr double close = 1e-6;
  if (!(range[1] > 0.0) || std::abs(range[0] + range[1]) > close * range[1]) {
    contract.fail_at_motor(servo, fmt::format("expected a symmetric {}, found {:g} to {:g}", what,
                                              range[0], range[1]));
  }
  return range[1];
}

/// The torque limit of a motor on its joint (N·m).
double torque_limit(const mjModel& model, int motor, std::size_t servo, const Contract& contract) {
  if (model.actuator_dyntype[motor] != mjDYN_NONE) {
    contract.fail_at_motor(servo, "expected a motor, found an activation (dyntype)");
  }
  if (model.actuator_gaintype[motor] != mjGAIN_FIXED ||
      (model.actuator_biastype[motor] != mjBIAS_NONE &&
       model.actuator_biastype[motor] != mjBIAS_AFFINE)) {
    contract.fail_at_motor(servo, "expected a motor");
  }
  const bool is_motor = model.actuator_biastype[motor] == mjBIAS_NONE;
  const bool has_force = model.actuator_forcelimited[motor] != 0;
  const bool has_control = is_motor && model.actuator_ctrllimited[motor] != 0;
  if (!is_motor && !has_force) {
    contract.fail_at_motor(servo, "expected a motor, or a forcerange, its torque limit (N·m)");
  }
  if (!has_force && !has_control) {
    contract.fail_at_motor(servo, "expected a ctrlrange or forcerange, its torque limit (N·m)");
  }
  double limit = std::numeric_limits<double>::infinity();
  if (has_control) {
    limit = std::abs(model.actuator_gainprm[mjNGAIN * motor]) *
            symmetric(&model.actuator_ctrlrange[2 * motor], "ctrlrange", servo, contract);
  }
  if (has_force) {
    limit = std::min(
        limit, symmetric(&model.actuator_forcerange[2 * motor], "forcerange", servo, contract));
  }
  limit *= std::abs(model.actuator_gear[6 * motor]);
  if (!(limit > 0.0)) contract.fail_at_motor(servo, "expected a torque limit above 0 N·m");
  return limit;
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
    robot.effort[i] = torque_limit(model, motor[i], i, contract);
    robot.actuator[i] = {.friction = model.dof_frictionloss[robot.dof_address[i]],
                         .viscous = model.dof_damping[robot.dof_address[i]],
                         .armature = model.dof_armature[robot.dof_address[i]]};
  }
  for (int i = 0; i < model.nu; ++i) {
    if (std::find(motor.begin(), motor.end(), i) == motor.end()) {
      contract.fail(fmt::format("actuator {}: expected one motor for each servo, and no other",
                                mj_id2name(&model, mjOBJ_ACTUATOR, i) != nullptr
                                    ? fmt::format("'{}'", mj_id2name(&model, mjOBJ_ACTUATOR, i))
                                    : fmt::format("#{}", i)));
    }
    if (model.actuator_biastype[i] == mjBIAS_NONE) continue;
    // The servos' law is touchdown's: MuJoCo must not add that of the file.
    robot.ignored.push_back(fmt::format("actuator '{}': its own law; its forcerange counts",
                                        mj_id2name(&model, mjOBJ_ACTUATOR, i)));
    std::fill_n(&model.actuator_gainprm[mjNGAIN * i], mjNGAIN, 0.0);
    std::fill_n(&model.actuator_biasprm[mjNBIAS * i], mjNBIAS, 0.0);
  }
}

}  // namespace touchdown::models
