#include "scenarios/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/force/load_filter.hpp"
#include "estimator/free_fall.hpp"
#include "logs/signals_from.hpp"
#include "models/robot_model.hpp"
#include "scenarios/leg_geometry.hpp"
#include "scenarios/start_pose.hpp"

namespace touchdown::scenarios {

namespace {

using WheelContacts = std::array<bool, models::wheel_count>;

/// Contact from an estimator in the loop. It gets the signals that a recording would give it.
policies::WheelContact contact_from(std::shared_ptr<ContactEstimator> estimator) {
  estimator->reset();
  return [estimator = std::move(estimator)](const models::Observation& observation,
                                            const models::Action* previous) {
    const Belief& belief = estimator->update(logs::signals_from(observation, previous));
    return WheelContacts{belief.wheel[0].contact, belief.wheel[1].contact};
  };
}

policies::WheelContact contact_from_truth(const simulators::Simulator& simulator) {
  constexpr double threshold = 1.0;  // N, that of Upkie's labels
  return [&simulator](const models::Observation& observation, const models::Action* /*previous*/) {
    if (observation.time <= 0.0) return WheelContacts{true, true};  // no force has acted yet
    const auto& force = simulator.ground_truth().wheel_normal_force;
    return WheelContacts{force[0] > threshold, force[1] > threshold};
  };
}

policies::WheelContact delayed(policies::WheelContact contact, std::size_t steps) {
  if (steps == 0) return contact;
  return [contact = std::move(contact), delay = ContactDelay(steps), steps](
             const models::Observation& observation, const models::Action* previous) mutable {
    return delay.add(contact(observation, previous), steps);
  };
}

policies::WheelContact named_source(const Scenario& scenario,
                                    const simulators::Simulator& simulator) {
  const std::string& name = scenario.policy.contact;
  const double period = simulator.control_period();
  if (name == "upkie_observer") return policies::upkie_contact(period);
  if (name == "always") {
    return [](const models::Observation&, const models::Action*) {
      return WheelContacts{true, true};
    };
  }
  if (name == "script") return policies::scripted_contact(scenario.policy.contact_script);
  if (name == "free_fall") {
    return contact_from(std::make_shared<FreeFall>(FreeFallConfig{.sample_rate = 1.0 / period}));
  }
  if (name == "load_filter") {
    const models::RobotModel robot = models::compile_robot_model(scenario.robot, {});
    return contact_from(std::make_shared<LoadFilter>(
        LoadFilterConfig{.sample_rate = 1.0 / period, .geometry = leg_geometry(robot)}));
  }
  if (name == "truth") return contact_from_truth(simulator);
  throw InputError(fmt::format("policy.contact: unknown contact source '{}'", name));
}

bool tipped_over(const models::GroundTruth& truth, double limit) {
  const double cosine = (truth.base_orientation * Eigen::Vector3d::UnitZ()).z();
  return cosine < std::cos(limit);
}

/// Whether the balancer keeps the lean that the robot has at rest, its centre of mass above its
/// axle. Leans of Upkie's size are left to the balancer's integral; a leg without a hip leans with
/// its knee.
bool keeps_lean(const simulators::Simulator& simulator) {
  constexpr double largest = 0.03;  // rad
  return !simulator.model().has(models::index(models::Servo::left_hip)) ||
         std::abs(simulator.observation().pitch) > largest;
}

std::unique_ptr<policies::Policy> make_policy(
    const Scenario& scenario, std::shared_ptr<const policies::CourseScripts> scripts,
    const simulators::Simulator& simulator, policies::WheelContact contact_source) {
  policies::Course course{std::move(scripts), simulator.model().wheel_radius,
                          simulator.control_period()};
  return policies::make_policy(
      scenario.policy.law,
      {.gains = scenario.balancer,
       .course = std::move(course),
       .contact = policy_contact(scenario, simulator, std::move(contact_source)),
       .keep_lean = keeps_lean(simulator)},
      simulator.model());
}

/// Makes `command` the last one of its script.
template <typename Command>
void append(std::vector<Command>& script, const Command& command) {
  std::erase_if(script, [&](const Command& other) { return other.time >= command.time; });
  script.push_back(command);
}

}  // namespace

policies::WheelContact policy_contact(const Scenario& scenario,
                                      const simulators::Simulator& simulator,
                                      policies::WheelContact contact_source) {
  if (!contact_source) contact_source = named_source(scenario, simulator);
  const auto delay = std::llround(scenario.policy.delay / simulator.control_period());
  return delayed(std::move(contact_source), static_cast<std::size_t>(delay));
}

std::vector<simulators::ExternalWrench> external_wrenches(const Scenario& scenario,
                                                          const simulators::Simulator& simulator) {
  std::vector<simulators::ExternalWrench> wrenches;
  const models::GroundTruth& truth = simulator.ground_truth();
  if (scenario.tether) {
    wrenches.push_back(
        {policies::tether_force(*scenario.tether, truth), scenario.tether->point_in_base});
  }
  for (const policies::Guide& guide : scenario.guides) {
    wrenches.push_back({policies::guide_force(guide, truth), guide.point_in_base});
  }
  const models::Observation& now = simulator.observation();
  for (const policies::TimedForce& force : scenario.forces) {
    if (force.acts_at(now.time)) {
      wrenches.push_back({policies::force_in_world(force, now.time, now.yaw), force.point_in_base});
    }
  }
  return wrenches;
}

Rollout::Rollout(Scenario scenario, simulators::Simulator& simulator,
                 policies::WheelContact contact_source)
    : scenario_(std::move(scenario)),
      simulator_(simulator),
      scripts_(std::make_shared<policies::CourseScripts>(
          policies::CourseScripts{scenario_.velocity, scenario_.crouch})),
      passed_(std::numeric_limits<double>::infinity()) {
  simulator_.reset(start_pose(simulator_.model(), scenario_.terrain, scenario_.start));
  policy_ = make_policy(scenario_, scripts_, simulator_, std::move(contact_source));
  policy_->reset(simulator_.observation());
}

const models::Action& Rollout::act() {
  action_ = policy_->act(simulator_.observation());
  const models::GroundTruth& truth = simulator_.ground_truth();
  const End& end = scenario_.end;
  if (truth.base_position.x() > end.x) passed_ = std::min(passed_, time());
  if (!simulator_.healthy()) {
    outcome_ = logs::Outcome::diverged;
  } else if (truth.base_position.z() < 0.0) {
    outcome_ = logs::Outcome::left_terrain;
  } else if (truth.body_touches_terrain || tipped_over(truth, end.fall_tilt)) {
    outcome_ = logs::Outcome::fell;
  } else if (time() - passed_ >= end.settle) {
    outcome_ = logs::Outcome::finished;
  } else if (time() >= end.duration) {
    outcome_ = std::isinf(end.x) ? logs::Outcome::finished : logs::Outcome::timed_out;
  }
  return action_;
}

void Rollout::advance() { simulator_.step(action_, external_wrenches(scenario_, simulator_)); }

void Rollout::drive(double velocity, double yaw_rate) {
  if (!outcome_) append(scripts_->velocity, {time(), velocity, yaw_rate});
}

void Rollout::crouch(double hip, double rate, double delay) {
  if (!outcome_) append(scripts_->crouch, {time() + delay, hip, rate});
}

void Rollout::apply(const policies::TimedForce& force) {
  if (!outcome_) scenario_.forces.push_back(force);
}

double Rollout::commanded_hip() const {
  const policies::CrouchCommand* command = policies::crouch_at(scripts_->crouch, time());
  return command == nullptr ? scenario_.start.hip : command->hip;
}

Scenario Rollout::scenario() const {
  Scenario scenario = scenario_;
  scenario.velocity = scripts_->velocity;
  scenario.crouch = scripts_->crouch;
  return scenario;
}

}  // namespace touchdown::scenarios
