#include "scenarios/scenario_file.hpp"

#include <cmath>
#include <limits>

#include "core/fields.hpp"
#include "core/resources.hpp"
#include "models/robot_description.hpp"
#include "policies/wheeled_pendulum.hpp"
#include "scenarios/start_pose.hpp"

namespace touchdown::scenarios {

namespace {

/// LQR gains of the robot as its file describes it, at rest on level ground.
policies::LqrGains lqr_gains(const std::filesystem::path& robot, const Start& start) {
  return [robot, legs = Start{.hip = start.hip, .knee = start.knee}](
             const policies::WheelBalancerConfig& config) {
    const models::RobotModel model = models::compile_robot_model(robot, {});
    const simulators::RobotState pose = start_pose(model, {}, legs);
    return with_lqr_gains(config,
                          policies::wheeled_pendulum(model, pose.orientation, pose.joint_position));
  };
}

void describe_robot(Fields& fields, models::RobotDescription& body,
                    policies::WheelBalancerConfig& balancer, const policies::LqrGains& lqr) {
  models::describe(fields, body);
  fields.section("balancer", balancer, lqr)
      .doc("Gains of the balancer, unless the scenario specifies them.");
}

/// The balancer that the robot's file specifies.
policies::WheelBalancerConfig balancer_of(const std::filesystem::path& robot,
                                          const policies::LqrGains& lqr) {
  policies::WheelBalancerConfig balancer;
  if (!models::is_about_an_mjcf(robot)) return balancer;
  Fields fields(YamlDocument::load(robot));
  models::RobotDescription body;
  describe_robot(fields, body, balancer, lqr);
  fields.finish();
  return balancer;
}

/// Scales forces that are written for a robot of another mass to the mass of this one.
void scale_forces(Scenario& scenario) {
  if (!scenario.forces_for_mass) return;
  const models::RobotModel robot = models::compile_robot_model(scenario.robot, {});
  const double mass = mj_getTotalmass(robot.mj.get());
  const double factor = mass / *scenario.forces_for_mass;
  constexpr double same_mass = 1e-6;  // then the forces stay bit-identical
  if (std::abs(factor - 1.0) < same_mass) return;
  for (policies::TimedForce& timed : scenario.forces) timed.force *= factor;
  if (auto& lift = scenario.perturbation.lift) {
    lift->force = {factor * lift->force.low, factor * lift->force.high};
  }
  scenario.forces_for_mass = mass;
}

}  // namespace

std::vector<Key> robot_keys() {
  KeyCollection keys;
  Fields fields(keys);
  models::RobotDescription body;
  policies::WheelBalancerConfig balancer;
  describe_robot(fields, body, balancer,
                 [](const policies::WheelBalancerConfig& config) { return config; });
  return keys.keys();
}

Scenario complete_scenario(const YamlDocument& document) {
  // Read once for the robot and the stance, then again with the robot's values as defaults.
  constexpr double unspecified = std::numeric_limits<double>::quiet_NaN();
  Scenario wanted;
  wanted.start.hip = wanted.start.knee = unspecified;
  wanted = scenario_from_yaml(document, wanted,
                              [](const policies::WheelBalancerConfig& config) { return config; });
  Scenario defaults;
  Fields(document).check("robot", [&] { defaults.robot = find_resource(wanted.robot); });
  const models::Stance stance = models::robot_description(defaults.robot).stance;
  defaults.start.hip = std::isnan(wanted.start.hip) ? stance.hip : wanted.start.hip;
  defaults.start.knee = std::isnan(wanted.start.knee) ? stance.knee : wanted.start.knee;
  const policies::LqrGains lqr = lqr_gains(defaults.robot, defaults.start);
  defaults.balancer = balancer_of(defaults.robot, lqr);
  Scenario scenario = scenario_from_yaml(document, defaults, lqr);
  scenario.robot = defaults.robot;
  scale_forces(scenario);
  return scenario;
}

}  // namespace touchdown::scenarios
