#include "scenarios/scenario_file.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "core/fields.hpp"
#include "core/resources.hpp"
#include "core/table.hpp"
#include "models/robot_description.hpp"
#include "models/stance.hpp"
#include "policies/servo_stability.hpp"
#include "policies/wheeled_pendulum.hpp"
#include "scenarios/start_pose.hpp"

namespace touchdown::scenarios {

namespace {

/// The robot as its file describes it, compiled when it is first needed.
class DescribedRobot {
 public:
  DescribedRobot(std::filesystem::path file, std::shared_ptr<const models::RobotModel> model)
      : file_(std::move(file)), model_(std::move(model)) {}

  const std::filesystem::path& file() const { return file_; }
  const models::RobotModel& model() {
    if (!model_) {
      model_ = std::make_shared<models::RobotModel>(models::compile_robot_model(file_, {}));
    }
    return *model_;
  }

 private:
  std::filesystem::path file_;
  std::shared_ptr<const models::RobotModel> model_;
};

/// LQR gains of a robot at rest on level ground.
policies::LqrGains lqr_gains(DescribedRobot& robot, const Start& start, double period) {
  return [&robot, period, legs = Start{.hip = start.hip, .knee = start.knee}](
             const policies::WheelBalancerConfig& config) {
    const simulators::RobotState pose = start_pose(robot.model(), {}, legs);
    return with_stable_servos(
        with_lqr_gains(config, policies::wheeled_pendulum(robot.model(), pose.orientation,
                                                          pose.joint_position)),
        robot.model(), {pose.orientation, pose.joint_position, period});
  };
}

/// The stance that a robot's file specifies, from straight legs.
models::Stance stance_of(DescribedRobot& robot) {
  const models::RobotDescription body = models::robot_description(robot.file());
  return body.has_stance ? from_straight(robot.model(), body.stance)
                         : models::usual_stance(robot.model());
}

/// The stance of a crouch: the knee follows the hip.
models::Stance crouched(const Start& start, double hip) {
  return {hip, start.knee + policies::knee_per_hip * (hip - start.hip)};
}

/// The angle nearest to `hip` of which the robot can have the stance; it can have that of `from`.
template <typename StanceOf>
double within_ranges(const models::RobotModel& robot, double from, double hip, StanceOf stance_of) {
  if (!stance_error(robot, stance_of(hip))) return hip;
  double within = from;
  for (double step = 0.5 * (hip - from); std::abs(step) > 1e-6; step *= 0.5) {
    if (!stance_error(robot, stance_of(within + step))) within += step;
  }
  return within;
}

/// Ends crouches within the ranges of the robot's joints, if the scenario wants it.
void clip_crouches(Scenario& scenario, const models::RobotModel& robot) {
  if (!scenario.clip_crouches) return;
  scenario.clip_crouches = false;
  const Start& start = scenario.start;
  const auto clip = [&](double& hip) {
    hip = within_ranges(robot, start.hip, hip, [&](double to) { return crouched(start, to); });
  };
  for (policies::CrouchCommand& crouch : scenario.crouch) clip(crouch.hip);
  if (auto& random = scenario.perturbation.crouching) {
    clip(random->hip.low);
    clip(random->hip.high);
  }
}

/// Keeps the drawn stances of starts within the ranges of the robot's joints. `perturbed` bends
/// knees with the hips, and no leg straighter than `least_bend`.
void clip_starts(Scenario& scenario, const models::RobotModel& robot) {
  const Start& start = scenario.start;
  double& width = scenario.perturbation.crouch;
  if (width == 0.0 || start.hip == 0.0) return;
  const double straighter = std::max(std::abs(start.hip) - width, least_bend);
  for (const double bend : {std::abs(start.hip) + width, straighter}) {
    const double hip =
        within_ranges(robot, start.hip, std::copysign(bend, start.hip), [&](double to) {
          return models::Stance{to, start.knee * to / start.hip};
        });
    if (std::abs(hip) != bend) width = std::min(width, std::abs(hip - start.hip));
  }
}

/// Checks that random crouches do not bend knees both ways.
void check_stays_bent(const Scenario& scenario, const std::string& document) {
  const Start& start = scenario.start;
  const Range& hip = scenario.perturbation.crouching->hip;
  const double straight = start.hip - start.knee / policies::knee_per_hip;
  if (hip.low < straight && straight < hip.high) {
    throw InputError(fmt::format(
        "{}: perturbation.crouching.hip: expected [low, high] on one side of {:.3f}, where the "
        "knees are straight, found [{:g}, {:g}]",
        document, straight, hip.low, hip.high));
  }
}

/// Checks that the robot's joints can have all angles of the scenario.
void check_angles(const Scenario& scenario, const std::string& document, DescribedRobot& robot) {
  const auto check = [&](const std::string& section, const models::Stance& stance) {
    if (const auto error = stance_error(robot.model(), stance)) {
      throw InputError(fmt::format("{}: {}.{}: {} ({})", document, section, error->key,
                                   error->message, robot.file().string()));
    }
  };
  const Start& start = scenario.start;
  check("start", {start.hip, start.knee});
  if (!robot.model().has(models::index(models::Servo::left_hip))) return;
  const auto check_crouch = [&](const std::string& section, double hip) {
    check(section, crouched(start, hip));
  };
  for (const policies::CrouchCommand& crouch : scenario.crouch) check_crouch("crouch", crouch.hip);
  if (scenario.perturbation.crouching) {
    check_crouch("perturbation.crouching", scenario.perturbation.crouching->hip.low);
    check_crouch("perturbation.crouching", scenario.perturbation.crouching->hip.high);
    check_stays_bent(scenario, document);
  }
}

void describe_robot(Fields& fields, models::RobotDescription& body,
                    policies::WheelBalancerConfig& balancer, const policies::LqrGains& lqr) {
  models::describe(fields, body);
  fields.section("balancer", balancer, lqr)
      .doc("Gains of the balancer, unless the scenario specifies them.");
}

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

/// Scales forces and tyres that are written for a robot of another mass to the mass of this one.
void scale_forces(Scenario& scenario, DescribedRobot& robot) {
  if (!scenario.forces_for_mass) return;
  const double mass = mj_getTotalmass(robot.model().mj.get());
  const double factor = mass / *scenario.forces_for_mass;
  constexpr double same_mass = 1e-6;  // then the forces stay bit-identical
  if (std::abs(factor - 1.0) < same_mass) return;
  for (policies::TimedForce& timed : scenario.forces) timed.force *= factor;
  if (auto& tyre = scenario.tyre) {
    tyre->stiffness *= factor;
    tyre->damping *= factor;
  }
  if (auto& lift = scenario.perturbation.lift) {
    lift->force = {factor * lift->force.low, factor * lift->force.high};
  }
  scenario.forces_for_mass = mass;
}

}  // namespace

/// The dotted keys of all numbers below a node.
static void add_number_keys(const YAML::Node& node, const std::string& prefix,
                            std::vector<std::string>& keys) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (node.IsScalar() && !std::isnan(node.as<double>(none))) keys.push_back(prefix);
  const std::string dot = prefix.empty() ? "" : ".";
  for (std::size_t i = 0; node.IsSequence() && i < node.size(); ++i) {
    add_number_keys(node[i], fmt::format("{}{}{}", prefix, dot, i), keys);
  }
  if (!node.IsMap()) return;
  for (const auto& entry : node) {
    add_number_keys(entry.second, prefix + dot + entry.first.as<std::string>(), keys);
  }
}

double number_at(const Scenario& scenario, const std::string& key) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  YAML::Node node = YAML::Load(to_yaml(scenario));
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '.');) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (node.IsSequence() && error == std::errc{} && index < node.size()) {
      node.reset(node[index]);
    } else if (node.IsMap() && node[part].IsDefined()) {
      node.reset(node[part]);
    } else {
      return none;
    }
  }
  return node.IsScalar() ? node.as<double>(none) : none;
}

Scenario varied(const Scenario& scenario, const std::string& key, double value,
                const std::string& name) {
  if (std::isnan(number_at(scenario, key))) {
    std::vector<std::string> known;
    add_number_keys(YAML::Load(to_yaml(scenario)), "", known);
    throw InputError(fmt::format("{} has no number at {}{}", name, key, did_you_mean(key, known)));
  }
  YamlDocument document = YamlDocument::parse(to_yaml(scenario), name);
  document.override_value(fmt::format("{}={}", key, exact(value)));
  return scenario_from_yaml(document);
}

std::vector<Key> robot_keys() {
  KeyCollection keys;
  Fields fields(keys);
  models::RobotDescription body;
  policies::WheelBalancerConfig balancer;
  describe_robot(fields, body, balancer,
                 [](const policies::WheelBalancerConfig& config) { return config; });
  return keys.keys();
}

Scenario complete_scenario(const YamlDocument& document,
                           std::shared_ptr<const models::RobotModel> model) {
  // Read once for the robot and the stance, then again with the robot's values as defaults.
  constexpr double unspecified = std::numeric_limits<double>::quiet_NaN();
  Scenario wanted;
  wanted.start.hip = wanted.start.knee = unspecified;
  wanted = scenario_from_yaml(document, wanted,
                              [](const policies::WheelBalancerConfig& config) { return config; });
  Scenario defaults;
  const bool names_robot = document.root()["robot"].IsDefined();
  Fields(document).check("robot", [&] {
    defaults.robot = names_robot ? find_resource(wanted.robot) : find_program_file(wanted.robot);
  });
  DescribedRobot robot(defaults.robot, std::move(model));
  (void)robot.model();  // complaints about the robot come before those about its scenario
  const models::Stance stance = stance_of(robot);
  defaults.start.hip = std::isnan(wanted.start.hip) ? stance.hip : wanted.start.hip;
  defaults.start.knee = std::isnan(wanted.start.knee) ? stance.knee : wanted.start.knee;
  const policies::LqrGains lqr = lqr_gains(
      robot, defaults.start, 1e-6 * static_cast<double>(wanted.simulation.steps.physics_us));
  defaults.balancer = balancer_of(defaults.robot, lqr);
  Scenario scenario = scenario_from_yaml(document, defaults, lqr);
  scenario.robot = defaults.robot;
  scale_forces(scenario, robot);
  clip_crouches(scenario, robot.model());
  check_angles(scenario, document.name(), robot);
  if (robot.model().has(models::index(models::Servo::left_hip))) {
    clip_starts(scenario, robot.model());
  }
  return scenario;
}

}  // namespace touchdown::scenarios
