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

/// Of the robot as its file has it, at rest on the level.
policies::LqrGains lqr_gains(const std::filesystem::path& robot, const Start& start) {
  return [robot, legs = Start{.hip = start.hip, .knee = start.knee}](
             const policies::WheelBalancerConfig& config) {
    const models::RobotModel model = models::compile_robot_model(robot, {});
    const simulators::RobotState pose = start_pose(model, {}, legs);
    return with_lqr_gains(config,
                          policies::wheeled_pendulum(model, pose.orientation, pose.joint_position));
  };
}

/// What the robot's file says about its balancer.
policies::WheelBalancerConfig balancer_of(const std::filesystem::path& robot,
                                          const policies::LqrGains& lqr) {
  policies::WheelBalancerConfig balancer;
  if (!models::is_about_an_mjcf(robot)) return balancer;
  Fields fields(YamlDocument::load(robot));
  models::RobotDescription body;
  models::describe(fields, body);
  fields.section("balancer", balancer, lqr);
  fields.finish();
  return balancer;
}

/// Forces that are meant for a robot of one mass, in proportion for this one.
void suit_forces(Scenario& scenario) {
  if (!scenario.forces_for_mass) return;
  const models::RobotModel robot = models::compile_robot_model(scenario.robot, {});
  const double mass = mj_getTotalmass(robot.mj.get());
  const double factor = mass / *scenario.forces_for_mass;
  constexpr double the_same = 1e-6;  // that robot: what is written, to the bit
  if (std::abs(factor - 1.0) < the_same) return;
  for (policies::TimedForce& timed : scenario.forces) timed.force *= factor;
  if (auto& lift = scenario.perturbation.lift) {
    lift->force = {factor * lift->force.low, factor * lift->force.high};
  }
  scenario.forces_for_mass = mass;
}

}  // namespace

Scenario complete_scenario(const YamlDocument& document) {
  // Once for the robot and the pose, then once more on top of what the robot says.
  constexpr double not_said = std::numeric_limits<double>::quiet_NaN();
  Scenario wanted;
  wanted.start.hip = wanted.start.knee = not_said;
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
  suit_forces(scenario);
  return scenario;
}

Scenario find_scenario(const std::filesystem::path& path, const std::string& robot) {
  YamlDocument document = YamlDocument::load(find_resource(path));
  if (!robot.empty()) {
    (void)find_resource(robot);  // or the scenario would be blamed for it
    document.override_value("robot=" + robot);
  }
  return complete_scenario(document);
}

}  // namespace touchdown::scenarios
