#include "models/contract/held.hpp"

#include <cmath>

#include <fmt/format.h>

#include "models/contract/motor.hpp"
#include "models/mjcf/parts.hpp"

namespace touchdown::models {

namespace {

/// Gains of a servo on its joint; zero where a motor has none.
struct Gains {
  double kp = 0.0;
  double kd = 0.0;
};

/// The gains of a position or velocity servo: force = gain·control − kp·length − kv·velocity, with
/// gear × angle as length.
Gains own_gains(const mjModel& model, int motor) {
  if (motor < 0 || model.actuator_biastype[motor] != mjBIAS_AFFINE) return {};
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
    motor_ = mj_name2id(&model_, mjOBJ_ACTUATOR, name_.c_str());
  }

  HeldJoint held(const HeldServo& given, const Gains& robots) {
    check_joint();
    held_.qpos_address = model_.jnt_qposadr[held_.joint];
    held_.dof_address = model_.jnt_dofadr[held_.joint];
    held_.reference = model_.qpos0[held_.qpos_address];
    set_gains(given, robots);
    set_limit(given);
    set_actuator();
    if (motor_ >= 0) (void)remove_law(model_, motor_);
    return held_;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    contract_.fail_at_joint(held_.joint, fmt::format("joint '{}': {}", held_.name, message));
  }

  void check_joint() const {
    if (model_.jnt_type[held_.joint] != mjJNT_HINGE) fail("expected a hinge, as it is held");
    if (model_.body_jntnum[model_.jnt_bodyid[held_.joint]] > 1) {
      fail("expected no other joint on its body, as it is held");
    }
    if (const double stiffness = model_.jnt_stiffness[held_.joint]; stiffness != 0.0) {
      fail(fmt::format("expected no spring, found stiffness {:g}", stiffness));
    }
  }

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

  void set_limit(const HeldServo& given) {
    if (given.maximum_torque) {
      held_.effort = *given.maximum_torque;
      return;
    }
    if (motor_ < 0) {
      fail(
          "expected a motor that holds it, an effort limit in the URDF, or 'held_servo: "
          "{maximum_torque: …}' in the YAML file");
    }
    held_.effort = torque_limit(model_, motor_, [&](const std::string& message) {
      contract_.fail_at_actuator(
          motor_, fmt::format("motor of joint '{}': {}, or 'held_servo: {{maximum_torque: …}}' in "
                              "the YAML file",
                              held_.name, message));
    });
  }

  void set_actuator() {
    const int dof = held_.dof_address;
    held_.actuator = {.friction = model_.dof_frictionloss[dof],
                      .viscous = model_.dof_damping[dof],
                      .armature = model_.dof_armature[dof]};
    model_.dof_frictionloss[dof] = model_.dof_damping[dof] = 0.0;
  }

  mjModel& model_;
  const Contract& contract_;
  std::string name_;
  HeldJoint held_;
  int motor_ = -1;
};

}  // namespace

void find_held(RobotModel& robot, const RobotDescription& description, const Contract& contract) {
  robot.held.clear();
  if (contract.parts().held.empty()) return;
  const Gains robots = gains_for(robot);
  std::vector<HeldJoint> held;
  for (std::size_t i = 0; i < contract.parts().held.size(); ++i) {
    held.push_back(Held(robot, contract, i).held(description.held_servo, robots));
  }
  robot.held = std::move(held);
}

}  // namespace touchdown::models
