#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "models/robot_draft.hpp"
#include "models/robot_source.hpp"

namespace touchdown::models {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// The upper end of a range that must be symmetric.
template <typename Fail>
double symmetric(const mjtNum* range, const char* what, const Fail& fail) {
  constexpr double close = 1e-6;
  if (!(range[1] > 0.0) || std::abs(range[0] + range[1]) > close * range[1]) {
    fail(fmt::format("expected a symmetric {}, found {:g} to {:g}", what, range[0], range[1]));
  }
  return range[1];
}

}  // namespace

Actuator actuator_at(const mjModel& model, int dof) {
  return {.friction = model.dof_frictionloss[dof],
          .viscous = model.dof_damping[dof],
          .armature = model.dof_armature[dof]};
}

double torque_limit(const mjModel& model, int joint, double most, const std::string& remedy,
                    const RobotSource& source) {
  const int motor = source.motor_of(joint);
  most = std::min(most, source.limit_of(joint));
  const auto fail = [&](const std::string& message) {
    source.fail_at(motor < 0 ? Part{mjOBJ_JOINT, joint} : Part{mjOBJ_ACTUATOR, motor},
                   fmt::format("motor of joint {}: {}, or '{}' in the YAML file",
                               source.title_of({mjOBJ_JOINT, joint}), message, remedy));
  };
  if (motor >= 0 && model.actuator_dyntype[motor] != mjDYN_NONE) {
    fail("expected a motor, found an activation (dyntype)");
  }
  if (motor >= 0 && (model.actuator_gaintype[motor] != mjGAIN_FIXED ||
                     (model.actuator_biastype[motor] != mjBIAS_NONE &&
                      model.actuator_biastype[motor] != mjBIAS_AFFINE))) {
    fail("expected a motor");
  }
  const bool is_motor = motor < 0 || model.actuator_biastype[motor] == mjBIAS_NONE;
  const bool has_force = motor >= 0 && model.actuator_forcelimited[motor] != 0;
  const bool has_control = motor >= 0 && is_motor && model.actuator_ctrllimited[motor] != 0;
  if (!has_force && !has_control) {
    if (std::isfinite(most)) return most;
    fail(fmt::format("expected a {}, its torque limit (N·m), an effort limit in a URDF",
                     is_motor ? "ctrlrange or forcerange" : "motor, or a forcerange"));
  }
  double limit = no_limit;
  if (has_control) {
    limit = std::abs(model.actuator_gainprm[mjNGAIN * motor]) *
            symmetric(&model.actuator_ctrlrange[2 * motor], "ctrlrange", fail);
  }
  if (has_force) {
    limit = std::min(limit, symmetric(&model.actuator_forcerange[2 * motor], "forcerange", fail));
  }
  limit *= std::abs(model.actuator_gear[6 * motor]);
  if (!(limit > 0.0)) fail("expected a torque limit above 0 N·m");
  return std::min(limit, most);
}

double torque_limit(const mjModel& model, int joint, std::size_t servo, const RobotSource& source) {
  const auto& given = source.description().actuator(static_cast<Servo>(servo));
  return torque_limit(model, joint, given ? given->maximum_torque : no_limit,
                      fmt::format("actuators: {{{}: {{maximum_torque: …}}}}",
                                  std::array{"hip", "knee", "wheel"}[servo % 3]),
                      source);
}

namespace {

/// Finds the floating base body, the root of the robot.
int find_base(const mjModel& model, const RobotSource& source) {
  int base = -1;
  for (int joint = 0; joint < model.njnt; ++joint) {
    if (model.jnt_type[joint] != mjJNT_FREE) continue;
    if (base >= 0) source.fail_at({mjOBJ_JOINT, joint}, "expected one free joint, found several");
    base = model.jnt_bodyid[joint];
  }
  if (base < 0) source.fail("expected a base body with a <freejoint/>");
  const int dof = model.jnt_dofadr[model.body_jntadr[base]];
  for (int i = dof; i < dof + 6; ++i) {
    if (model.dof_damping[i] != 0.0 || model.dof_armature[i] != 0.0 ||
        model.dof_frictionloss[i] != 0.0) {
      source.fail_at({mjOBJ_JOINT, model.body_jntadr[base]},
                     "free joint: expected no damping, armature or frictionloss on it");
    }
  }
  return base;
}

/// The names of all hinges but those that are held, for a message.
std::string found_joints(const mjModel& model, const RobotSource& source) {
  std::vector<std::string> names;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const std::string name = name_of(model, mjOBJ_JOINT, joint);
    const bool is_held = std::ranges::count(source.parts().held, name) > 0;
    if (model.jnt_type[joint] != mjJNT_FREE && !name.empty() && !is_held) names.push_back(name);
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string key_of(std::size_t servo) { return fmt::format("joints.{}", servo_names[servo]); }

int find_joint(const mjModel& model, const RobotSource& source, std::size_t servo) {
  const std::string& own = source.parts().joint[servo];
  const std::string name(servo_names[servo]);
  const int joint = own.empty() ? mj_name2id(&model, mjOBJ_JOINT, name.c_str())
                                : source.joint(own, key_of(servo));
  if (joint < 0) {
    source.fail(
        fmt::format("expected a hinge joint named '{}', found {} (a YAML file about this "
                    "robot may name others: joints, hip: none, held)",
                    name, found_joints(model, source)));
  }
  if (model.jnt_type[joint] != mjJNT_HINGE) source.fail_at_hinge(joint, "expected a hinge");
  if (const double stiffness = model.jnt_stiffness[joint]; stiffness != 0.0) {
    source.fail_at_hinge(joint, fmt::format("expected no spring, found stiffness {:g}", stiffness));
  }
  return joint;
}

constexpr std::string_view rod_text =
    "a rod of a closed chain, cut open in this file? `loops` and `motors` in the YAML file close "
    "it. Held, it carries no load, and torques of the leg are not the robot's";

/// Whether a joint is a rod's in the pose of the file.
bool is_rod_of(const RobotModel& robot, int joint) {
  const MjDataPtr data = make_data(*robot.mj);
  mj_kinematics(robot.mj.get(), data.get());
  JointsOfLegs legs;
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (robot.has(i)) legs.at(i / 3).push_back(robot.joint[i]);
  }
  return is_rod(*robot.mj, *data, legs, joint);
}

void refuse_other_joints(const RobotModel& robot, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  std::vector<std::string> rods;
  std::vector<std::string> others;
  int first = -1;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const bool is_known = model.jnt_type[joint] == mjJNT_FREE || is_held(robot, joint) ||
                          std::ranges::count(robot.joint, joint) > 0;
    if (is_known) continue;
    if (first < 0) first = joint;
    (is_rod_of(robot, joint) ? rods : others).push_back(source.title_of({mjOBJ_JOINT, joint}));
  }
  if (first < 0) return;
  std::string message;
  if (!rods.empty()) {
    message = fmt::format("joint {}: expected none, found {}", fmt::join(rods, ", "), rod_text);
  }
  if (!others.empty()) {
    message += fmt::format(
        "{}joint {}: expected the servos' joints alone (a YAML file about this robot may list it "
        "under `held`)",
        message.empty() ? "" : "; ", fmt::join(others, ", "));
  }
  source.fail_at({mjOBJ_JOINT, first}, message);
}

/// Refuses a second motor on a joint, and in robots without loops those of no servo.
void check_motors(const RobotModel& robot, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  for (int i = 0; i < model.nu; ++i) {
    const int joint = source.joint_of(i);
    const auto fail = [&](const std::string& message) {
      const tinyxml2::XMLElement* const element = source.element_of({mjOBJ_ACTUATOR, i});
      source.fail_at(
          {mjOBJ_ACTUATOR, i},
          fmt::format("{}: {}", element == nullptr ? "motor" : title_of(*element), message));
    };
    if (joint >= 0 && source.motor_of(joint) != i) {
      fail(fmt::format("expected one motor for joint '{}', found several",
                       name_of(model, mjOBJ_JOINT, joint)));
    }
    const bool is_servos = joint >= 0 && std::ranges::count(robot.joint, joint) > 0;
    if (is_servos || is_held(robot, joint) || model.neq > 0) continue;
    fail("expected one motor for each servo, and no other");
  }
}

/// Gains of a servo on its joint; zero where a motor has none.
struct Gains {
  double kp = 0.0;
  double kd = 0.0;
};

/// The gains of a position or velocity servo: force = gain·control − kp·length − kv·velocity, with
/// gear × angle as length.
Gains own_gains(const mjModel& model, int motor) {
  if (model.actuator_biastype[motor] != mjBIAS_AFFINE) return {};
  const double gear = model.actuator_gear[6 * motor];
  const mjtNum* const bias = &model.actuator_biasprm[mjNBIAS * motor];
  const int columns = model.nuser_actuator;  // damping, as MuJoCo 3 has it (later_versions.cpp)
  const double damping = columns > 0 ? model.actuator_user[columns * motor] : 0.0;
  return {-bias[1] * gear * gear, (damping - bias[2]) * gear * gear};
}

/// Length of the left leg seen from the side, from its first joint over the knee to the axle (m).
double leg_length(const RobotModel& robot) {
  const MjDataPtr data = at_reference(robot);
  const auto distance = [&](Servo from, Servo to) {
    const Eigen::Vector3d link = vector_at(data->xanchor, robot.joint[index(to)]) -
                                 vector_at(data->xanchor, robot.joint[index(from)]);
    return std::hypot(link.x(), link.z());
  };
  const double lower = distance(Servo::left_knee, Servo::left_wheel);
  if (!robot.has(index(Servo::left_hip))) return lower;
  return lower + distance(Servo::left_hip, Servo::left_knee);
}

/// Gains that follow from the robot: three times the stiffness with which gravity topples it.
Gains gains_for(const RobotModel& robot) {
  constexpr double gravity = 9.81;
  const double length = leg_length(robot);
  const double toppling = mj_getTotalmass(robot.mj.get()) * gravity * length;
  return {3.0 * toppling, 0.73 * toppling * std::sqrt(length / gravity)};
}

/// A held joint with its place, and the gains of its motor.
HeldJoint held_joint(const mjModel& model, const RobotSource& source, const std::string& name,
                     const std::string& key) {
  HeldJoint held;
  held.name = name;
  held.joint = source.joint(name, key);
  held.qpos_address = model.jnt_qposadr[held.joint];
  held.dof_address = model.jnt_dofadr[held.joint];
  held.reference = model.qpos0[held.qpos_address];
  const int motor = source.motor_of(held.joint);
  const Gains own = motor < 0 ? Gains{} : own_gains(model, motor);
  held.kp = own.kp;
  held.kd = own.kd;
  return held;
}

/// Completes the gains of a held joint by those that the robot needs.
void set_gains(HeldJoint& held, const HeldServo& given, const Gains& robots) {
  const double own_kd = held.kd;
  held.kp_source = given.kp        ? "held_servo"
                   : held.kp > 0.0 ? "the file's position servo"
                                   : "weight and leg length";
  if (given.kp || held.kp <= 0.0) held.kp = given.kp.value_or(robots.kp);
  held.kd = given.kd.value_or(own_kd > 0.0 ? own_kd : robots.kd * held.kp / robots.kp);
}

/// Removes the laws of position and velocity servos: MuJoCo must not add them to touchdown's.
void remove_laws(RobotModel& robot, const RobotSource& source) {
  mjModel& model = *robot.mj;
  for (int i = 0; i < model.nu; ++i) {
    if (model.actuator_biastype[i] == mjBIAS_NONE) continue;
    std::fill_n(&model.actuator_gainprm[mjNGAIN * i], mjNGAIN, 0.0);
    std::fill_n(&model.actuator_biasprm[mjNBIAS * i], mjNBIAS, 0.0);
    if (is_held(robot, source.joint_of(i))) continue;
    robot.ignored.push_back(fmt::format("{}: actuator '{}': its own law; its forcerange counts",
                                        source.place_of({mjOBJ_ACTUATOR, i}),
                                        name_of(model, mjOBJ_ACTUATOR, i)));
  }
}

}  // namespace

void find_joints(RobotModel& robot, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  const PartNames& parts = source.parts();
  std::map<int, std::string> keys;
  const auto add = [&](int joint, const std::string& key) {
    const auto [other, is_new] = keys.emplace(joint, key);
    if (is_new) return;
    source.keys().fail(key, fmt::format("'{}' is the joint of {}, too",
                                        name_of(model, mjOBJ_JOINT, joint), other->second));
  };
  robot.base_body = find_base(model, source);
  for (std::size_t i = 0; i < servo_count; ++i) {
    robot.joint[i] = robot.qpos_address[i] = robot.dof_address[i] = -1;
    robot.joint_name[i] = servo_names[i];
    if (i % 3 == 0 && !parts.has_hips) continue;
    const int joint = robot.joint[i] = find_joint(model, source, i);
    add(joint, key_of(i));
    robot.joint_name[i] = name_of(model, mjOBJ_JOINT, joint);
    robot.qpos_address[i] = model.jnt_qposadr[joint];
    robot.dof_address[i] = model.jnt_dofadr[joint];
  }
  for (std::size_t i = 0; i < parts.held.size(); ++i) {
    const std::string key = fmt::format("held.{}", i);
    robot.held.push_back(held_joint(model, source, parts.held[i], key));
    add(robot.held.back().joint, key);
  }
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    for (std::size_t i = 0; i < parts.motors[leg].size(); ++i) {
      const char* const side = leg == 0 ? "left" : "right";
      (void)source.joint(parts.motors[leg][i], fmt::format("motors.{}.{}", side, i));
    }
  }
  // Rods of closed legs are found with their loops.
  if (model.neq == 0) refuse_other_joints(robot, source);
  check_motors(robot, source);
}

void find_limits(RobotModel& robot, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  for (std::size_t i = 0; i < servo_count; ++i) {
    const int joint = robot.joint[i];
    if (joint < 0 || (i % 3 != 2 && model.neq > 0)) continue;  // closed legs have their own motors
    robot.effort[i] = torque_limit(model, joint, i, source);
    robot.actuator[i] = actuator_at(model, robot.dof_address[i]);
  }
  robot.motor_joint = robot.joint;
  remove_laws(robot, source);
}

void complete_held(RobotModel& robot, const RobotSource& source) {
  if (robot.held.empty()) return;
  mjModel& model = *robot.mj;
  const HeldServo& given = source.description().held_servo;
  const Gains robots = gains_for(robot);
  for (HeldJoint& held : robot.held) {
    source.check_hinge(held.joint, "as it is held");
    set_gains(held, given, robots);
    held.effort = given.maximum_torque ? *given.maximum_torque
                                       : torque_limit(model, held.joint, no_limit,
                                                      "held_servo: {maximum_torque: …}", source);
    held.actuator = actuator_at(model, held.dof_address);
    model.dof_frictionloss[held.dof_address] = model.dof_damping[held.dof_address] = 0.0;
    if (!is_rod_of(robot, held.joint)) continue;
    robot.warnings.push_back(
        fmt::format("{}: joint '{}': {}", source.description().mjcf.string(), held.name, rod_text));
  }
}

}  // namespace touchdown::models
