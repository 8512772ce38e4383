#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "models/contract.hpp"
#include "models/mjcf/parts.hpp"
#include "models/mjcf/robot_file.hpp"
#include "models/robot_draft.hpp"

namespace touchdown::models {

namespace {

using Efforts = std::map<std::string, double>;

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

double limit_of(const Efforts& efforts, const std::string& joint) {
  const auto found = efforts.find(joint);
  return found == efforts.end() ? no_limit : found->second;
}

Actuator actuator_at(const mjModel& model, int dof) {
  return {.friction = model.dof_frictionloss[dof],
          .viscous = model.dof_damping[dof],
          .armature = model.dof_armature[dof]};
}

double torque_limit(const mjModel& model, const MotorOfJoint& of, double most,
                    const Contract& contract) {
  const int motor = of.motor;
  const auto fail = [&](const std::string& message) {
    contract.fail_at_actuator(
        motor, fmt::format("{}: {}, or '{}' in the YAML file", of.title, message, of.remedy));
  };
  if (model.actuator_dyntype[motor] != mjDYN_NONE) {
    fail("expected a motor, found an activation (dyntype)");
  }
  if (model.actuator_gaintype[motor] != mjGAIN_FIXED ||
      (model.actuator_biastype[motor] != mjBIAS_NONE &&
       model.actuator_biastype[motor] != mjBIAS_AFFINE)) {
    fail("expected a motor");
  }
  const bool is_motor = model.actuator_biastype[motor] == mjBIAS_NONE;
  const bool has_force = model.actuator_forcelimited[motor] != 0;
  const bool has_control = is_motor && model.actuator_ctrllimited[motor] != 0;
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

namespace {

/// Removes the law of a position or velocity servo: MuJoCo must not add it to touchdown's. Returns
/// whether there was one.
bool remove_law(mjModel& model, int motor) {
  if (model.actuator_biastype[motor] == mjBIAS_NONE) return false;
  std::fill_n(&model.actuator_gainprm[mjNGAIN * motor], mjNGAIN, 0.0);
  std::fill_n(&model.actuator_biasprm[mjNBIAS * motor], mjNBIAS, 0.0);
  return true;
}

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

void refuse_other_joints(const RobotModel& robot, const Contract& contract) {
  const mjModel& model = *robot.mj;
  std::vector<std::string> rods;
  std::vector<std::string> others;
  int first = -1;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const char* const name = mj_id2name(&model, mjOBJ_JOINT, joint);
    const bool is_known =
        model.jnt_type[joint] == mjJNT_FREE || is_held_name(name) ||
        std::find(robot.joint.begin(), robot.joint.end(), joint) != robot.joint.end();
    if (is_known) continue;
    if (first < 0) first = joint;
    (is_rod_of(robot, joint) ? rods : others).push_back(contract.name_of(mjOBJ_JOINT, joint));
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
  contract.fail_at_joint(first, message);
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
  return {-bias[1] * gear * gear, -bias[2] * gear * gear};
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

class Held {
 public:
  Held(RobotModel& robot, const Contract& contract, std::size_t number)
      : model_(*robot.mj), contract_(contract), name_(held_name(number)) {
    held_.name = contract.parts().held[number];
    held_.joint = contract.find(mjOBJ_JOINT, "joint", name_);
    motor_ = contract.find(mjOBJ_ACTUATOR, "motor", name_);
  }

  HeldJoint held(const HeldServo& given, const Gains& robots, const Efforts& efforts) {
    contract_.check_hinge(held_.joint, "as it is held");
    held_.qpos_address = model_.jnt_qposadr[held_.joint];
    held_.dof_address = model_.jnt_dofadr[held_.joint];
    held_.reference = model_.qpos0[held_.qpos_address];
    set_gains(given, robots);
    set_limit(given, limit_of(efforts, held_.name));
    set_actuator();
    (void)remove_law(model_, motor_);
    return held_;
  }

 private:
  void set_gains(const HeldServo& given, const Gains& robots) {
    const Gains own = own_gains(model_, motor_);
    if (given.kp) {
      held_.kp = *given.kp;
      held_.kp_source = "held_servo";
    } else if (own.kp > 0.0) {
      held_.kp = own.kp;
      held_.kp_source = "the file's position servo";
    } else {
      held_.kp = robots.kp;
      held_.kp_source = "weight and leg length";
    }
    held_.kd = given.kd.value_or(own.kd > 0.0 ? own.kd : robots.kd * held_.kp / robots.kp);
  }

  void set_limit(const HeldServo& given, double most) {
    if (given.maximum_torque) {
      held_.effort = *given.maximum_torque;
      return;
    }
    held_.effort = torque_limit(
        model_,
        {motor_, fmt::format("motor of joint '{}'", held_.name), "held_servo: {maximum_torque: …}"},
        most, contract_);
  }

  void set_actuator() {
    const int dof = held_.dof_address;
    held_.actuator = actuator_at(model_, dof);
    model_.dof_frictionloss[dof] = model_.dof_damping[dof] = 0.0;
  }

  mjModel& model_;
  const Contract& contract_;
  std::string name_;
  HeldJoint held_;
  int motor_ = -1;
};

}  // namespace

void find_servos(RobotModel& robot, const RobotDescription& description, const Efforts& efforts,
                 const Contract& contract) {
  mjModel& model = *robot.mj;
  robot.base_body = find_base(model, contract);
  std::array<int, servo_count> motor = {-1, -1, -1, -1, -1, -1};
  robot.joint.fill(-1);
  std::vector<std::string> complaints;
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (i % 3 == 0 && !contract.parts().has_hips) continue;
    collect(complaints, [&] {
      robot.joint[i] = find_joint(model, contract, i);
      if (i % 3 == 2 || model.neq == 0) {
        motor[i] = contract.find(mjOBJ_ACTUATOR, "motor", servo_names[i]);
      }
    });
  }
  require_none(complaints);
  // Rods of closed legs are found with their loops.
  if (model.neq == 0) collect(complaints, [&] { refuse_other_joints(robot, contract); });
  for (std::size_t i = 0; i < servo_count; ++i) {
    robot.qpos_address[i] = robot.dof_address[i] = -1;
    if (!robot.has(i)) continue;
    const int joint = robot.joint[i];
    robot.qpos_address[i] = model.jnt_qposadr[joint];
    robot.dof_address[i] = model.jnt_dofadr[joint];
    if (motor[i] < 0) continue;
    const auto& given = description.actuator(static_cast<Servo>(i));
    const double most = std::min(given ? given->maximum_torque : no_limit,
                                 limit_of(efforts, own_name(contract.parts(), i)));
    const MotorOfJoint of = {motor[i], fmt::format("motor '{}'", own_name(contract.parts(), i)),
                             fmt::format("actuators: {{{}: {{maximum_torque: …}}}}",
                                         std::array{"hip", "knee", "wheel"}[i % 3])};
    collect(complaints, [&] { robot.effort[i] = torque_limit(model, of, most, contract); });
    robot.actuator[i] = actuator_at(model, robot.dof_address[i]);
  }
  require_none(complaints);
  for (int i = 0; i < model.nu; ++i) {
    const char* const name = mj_id2name(&model, mjOBJ_ACTUATOR, i);
    if (is_held_name(name)) continue;
    if (model.neq == 0 && std::find(motor.begin(), motor.end(), i) == motor.end()) {
      contract.fail_at_actuator(
          i, fmt::format("actuator {}: expected one motor for each servo, and no other",
                         name == nullptr ? "without a name" : fmt::format("'{}'", name)));
    }
    // The servos' law is touchdown's: MuJoCo must not add that of the file.
    if (remove_law(model, i)) {
      robot.ignored.push_back(fmt::format("{}: actuator '{}': its own law; its forcerange counts",
                                          contract.place_in_section("actuator", i),
                                          name ? name : ""));
    }
  }
  robot.motor_joint = robot.joint;
}

void find_held(RobotModel& robot, const RobotDescription& description, const Efforts& efforts,
               const Contract& contract) {
  robot.held.clear();
  if (contract.parts().held.empty()) return;
  const Gains robots = gains_for(robot);
  std::vector<HeldJoint> held;
  for (std::size_t i = 0; i < contract.parts().held.size(); ++i) {
    held.push_back(Held(robot, contract, i).held(description.held_servo, robots, efforts));
    if (!is_rod_of(robot, held.back().joint)) continue;
    robot.warnings.push_back(
        fmt::format("{}: joint '{}': {}", description.mjcf.string(), held.back().name, rod_text));
  }
  robot.held = std::move(held);
}

}  // namespace touchdown::models
