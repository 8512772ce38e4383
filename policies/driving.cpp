#include "policies/driving.hpp"

#include "core/fields.hpp"
#include "policies/script.hpp"

namespace touchdown::policies {

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
    fields.choose("gains", known, gains);
    if (named) fields.check("gains", [&] { config = with_gains(gains, config, lqr); });
  }
  fields("pitch_stiffness", config.pitch_stiffness, 0.0, 1e4);
  fields("pitch_damping", config.pitch_damping, 0.0, 1e4);
  fields("position_stiffness", config.position_stiffness, 0.0, 1e4);
  fields("position_damping", config.position_damping, 0.0, 1e4);
  fields("max_velocity", config.max_velocity, 0.0, 100.0);
  fields("max_integral", config.max_integral, 0.0, 1e3);
  fields("max_acceleration", config.max_acceleration, 0.0, 100.0);
  fields("max_position_error", config.max_position_error, 0.0, 100.0);
  fields("air_decay_time", config.air_decay_time, 1e-3, 1e3);
  fields("wheel_kd_scale", config.wheel_kd_scale, 0.0, 100.0);
  fields("yaw_stiffness", config.yaw_stiffness, 0.0, 100.0);
  fields("yaw_damping", config.yaw_damping, 0.0, 100.0);
  fields("lateral_stiffness", config.lateral_stiffness, 0.0, 100.0);
  fields("max_lateral_error", config.max_lateral_error, 0.0, 100.0);
  fields("keep_heading", config.keep_heading);
  fields("leg_kp_scale", config.leg_kp_scale, 0.0, 100.0);
  fields("leg_kd_scale", config.leg_kd_scale, 0.0, 100.0);
}

void describe(Fields& fields, VelocityCommand& command, const VelocityScript& script) {
  fields("time", command.time, 0.0, 1e6);
  fields("velocity", command.velocity, -3.0, 3.0);
  fields("yaw_rate", command.yaw_rate, -10.0, 10.0);
  check_order(fields, command, script);
}

}  // namespace touchdown::policies
