#include "policies/commands.hpp"

#include "core/fields.hpp"
#include "policies/script.hpp"

namespace touchdown::policies {

const CrouchCommand* crouch_at(const CrouchScript& script, double time) {
  return in_force(script, time);
}

void describe(Fields& fields, CrouchCommand& command, const CrouchScript& script) {
  fields("time", command.time, 0.0, 1e6).doc("s", "Start of the command.");
  fields.require("hip", command.hip, -largest_angle, largest_angle)
      .doc("rad", "Hip angle, forward positive; 0: straight legs. The knee follows.");
  fields("rate", command.rate, 1e-3, 100.0).doc("rad/s", "Rate of the hip angle.");
  check_order(fields, command, script);
}

VelocityCommand command_at(const VelocityScript& script, double time) {
  const VelocityCommand* command = in_force(script, time);
  return command == nullptr ? VelocityCommand{} : *command;
}

static WheelBalancerConfig with_gains(const std::string& name, const WheelBalancerConfig& config,
                                      const LqrGains& lqr) {
  if (name == "touchdown") return with_touchdown_gains(config);
  if (name == "upkie") return with_upkie_gains(config);
  // Gains of an unusual robot may exceed the ranges: reading them back checks them.
  return from_yaml<WheelBalancerConfig>(
      YamlDocument::parse(YAML::Dump(to_node(lqr(config))), "lqr"));
}

void describe(Fields& fields, WheelBalancerConfig& config, const LqrGains& lqr) {
  if (fields.reading()) {
    std::vector<std::string> known = {"touchdown", "upkie", "lqr"};
    if (!lqr) known.pop_back();
    std::string gains = known.front();
    const bool named = fields.present("gains", false);
    fields.choose("gains", known, gains)
        .fallback("none")
        .doc("Initial gains; `lqr` computes them from the robot.");
    if (named) fields.check("gains", [&] { config = with_gains(gains, config, lqr); });
  }
  fields("pitch_stiffness", config.pitch_stiffness, 0.0, 1e4)
      .doc("m/s²/rad", "Integral gain on the pitch error.");
  fields("pitch_damping", config.pitch_damping, 0.0, 1e4)
      .doc("m/s/rad", "Proportional gain on the pitch error.");
  fields("position_stiffness", config.position_stiffness, 0.0, 1e4)
      .doc("1/s²", "Integral gain on the position error.");
  fields("position_damping", config.position_damping, 0.0, 1e4)
      .doc("1/s", "Proportional gain on the position error.");
  fields("max_velocity", config.max_velocity, 0.0, 100.0)
      .doc("m/s", "Limit of the commanded ground velocity.");
  fields("max_integral", config.max_integral, 0.0, 1e3)
      .doc("m/s", "Limit of the integral part of that command.");
  fields("max_acceleration", config.max_acceleration, 0.0, 100.0)
      .doc("m/s²", "Limit of the change of the target velocity.");
  fields("max_position_error", config.max_position_error, 0.0, 100.0)
      .doc("m", "Limit of the position error.");
  fields("air_decay_time", config.air_decay_time, 1e-3, 1e3)
      .doc("s", "Time constant of the integral's decay without contact.");
  fields("wheel_kd_scale", config.wheel_kd_scale, 0.0, 1e4)
      .doc("Factor on the wheels' velocity gain.");
  fields("yaw_stiffness", config.yaw_stiffness, 0.0, 1e4)
      .doc("N·m/rad", "Differential wheel torque per heading error.");
  fields("yaw_damping", config.yaw_damping, 0.0, 1e4)
      .doc("N·m·s/rad", "Differential wheel torque per yaw-rate error.");
  fields("lateral_stiffness", config.lateral_stiffness, 0.0, 100.0)
      .doc("rad/m", "Heading per lateral error.");
  fields("max_lateral_error", config.max_lateral_error, 0.0, 100.0)
      .doc("m", "Limit of the lateral error.");
  fields("keep_heading", config.keep_heading)
      .doc("Whether the course is along the initial heading, not along the world's x axis.");
  fields("leg_kp_scale", config.leg_kp_scale, 0.0, 1e4)
      .doc("Factor on the position gains of hips and knees.");
  fields("leg_kd_scale", config.leg_kd_scale, 0.0, 1e4)
      .doc("Factor on the velocity gains of hips and knees.");
}

void describe(Fields& fields, VelocityCommand& command, const VelocityScript& script) {
  fields("time", command.time, 0.0, 1e6).doc("s", "Start of the command.");
  fields("velocity", command.velocity, -3.0, 3.0)
      .doc("m/s", "Velocity along the ground, forward positive.");
  fields("yaw_rate", command.yaw_rate, -10.0, 10.0).doc("rad/s", "Yaw rate, positive to the left.");
  check_order(fields, command, script);
}

}  // namespace touchdown::policies
