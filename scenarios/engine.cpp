#include "scenarios/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "policies/soft_lander.hpp"
#include "policies/wheel_balancer.hpp"
#include "scenarios/compiled_scenes.hpp"
#include "scenarios/policy_contact.hpp"
#include "scenarios/start_pose.hpp"
#include "simulators/registry.hpp"

namespace touchdown::scenarios {

namespace {

bool tipped_over(const models::GroundTruth& truth, double limit) {
  const double cosine = (truth.base_orientation * Eigen::Vector3d::UnitZ()).z();
  return cosine < std::cos(limit);
}

/// Decides when a run ends, and how.
class TerminationCheck {
 public:
  explicit TerminationCheck(const End& end) : end_(end) {}

  /// The outcome if the run is over at this step.
  std::optional<recordings::Outcome> outcome(const simulators::Simulator& simulator) {
    const double time = simulator.observation().time;
    const models::GroundTruth& truth = simulator.ground_truth();
    if (!simulator.healthy()) return recordings::Outcome::diverged;
    if (truth.base_position.z() < 0.0) return recordings::Outcome::left_terrain;
    if (truth.body_touches_terrain || tipped_over(truth, end_.fall_tilt))
      return recordings::Outcome::fell;
    if (truth.base_position.x() > end_.x) passed_ = std::min(passed_, time);
    if (time - passed_ >= end_.settle) return recordings::Outcome::finished;
    if (time >= end_.duration) {
      return std::isinf(end_.x) ? recordings::Outcome::finished : recordings::Outcome::timed_out;
    }
    return std::nullopt;
  }

 private:
  const End& end_;
  double passed_ = std::numeric_limits<double>::infinity();  ///< first time past `end.x` (s)
};

/// Whether the balancer keeps the lean that the robot has at rest, its centre of mass above its
/// axle. Leans of Upkie's size are left to the balancer's integral; a leg without a hip leans with
/// its knee.
bool keeps_lean(const simulators::Simulator& simulator) {
  constexpr double largest = 0.03;  // rad
  return !simulator.model().has(models::index(models::Servo::left_hip)) ||
         std::abs(simulator.observation().pitch) > largest;
}

std::unique_ptr<policies::Policy> make_policy(const Scenario& scenario,
                                              const simulators::Simulator& simulator,
                                              policies::WheelContact contact_source) {
  const double radius = simulator.model().wheel_radius;
  const double period = simulator.control_period();
  policies::WheelContact contact = policy_contact(scenario, simulator, std::move(contact_source));
  if (scenario.policy.law == policies::PolicyConfig::Law::soft_landing) {
    return std::make_unique<policies::SoftLander>(
        scenario.balancer, policies::Course{scenario.velocity, scenario.crouch, radius, period},
        policies::side_view(simulator.model()), std::move(contact));
  }
  return std::make_unique<policies::WheelBalancer>(scenario.balancer, scenario.velocity, radius,
                                                   period, scenario.crouch, std::move(contact),
                                                   keeps_lean(simulator));
}

}  // namespace

std::unique_ptr<simulators::Simulator> make_simulator(const Scenario& scenario,
                                                      std::string_view name) {
  return make_simulator(scenario, name, compile_scene(scenario));
}

std::unique_ptr<simulators::Simulator> make_simulator(
    const Scenario& scenario, std::string_view name,
    const std::shared_ptr<const models::RobotModel>& scene) {
  return simulators::make_simulator(name, scene, scenario.simulation);
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

recordings::Recording play(const Scenario& scenario, simulators::Simulator& simulator,
                           std::uint64_t seed, std::int64_t run, const ContinueSimulation& progress,
                           policies::WheelContact contact_source) {
  recordings::Recording recording;
  recording.info = {.scenario = scenario.name,
                    .simulator = std::string(simulator.name()),
                    .seed = seed,
                    .run = run,
                    .control_period_us = scenario.simulation.steps.control_us,
                    .outcome = std::nullopt,
                    .scenario_yaml = to_yaml(scenario)};
  const auto most_steps =
      static_cast<std::size_t>(scenario.end.duration / simulator.control_period()) + 2;
  recording.observation.reserve(most_steps);
  recording.action.reserve(most_steps);
  recording.truth.reserve(most_steps);

  simulator.reset(start_pose(simulator.model(), scenario.terrain, scenario.start));
  const std::unique_ptr<policies::Policy> policy =
      make_policy(scenario, simulator, std::move(contact_source));
  policy->reset(simulator.observation());
  TerminationCheck termination(scenario.end);
  for (std::size_t step = 0;; ++step) {
    recording.observation.push_back(simulator.observation());
    recording.action.push_back(policy->act(simulator.observation()));
    recording.truth.push_back(simulator.ground_truth());
    recording.info.outcome = termination.outcome(simulator);
    if (recording.info.outcome) return recording;
    constexpr std::size_t steps_between_reports = 256;
    if (progress && step % steps_between_reports == 0 && !progress(simulator.observation().time)) {
      return recording;
    }
    simulator.step(recording.action.back(), external_wrenches(scenario, simulator));
  }
}

recordings::Recording play(const Scenario& scenario, std::string_view simulator, std::uint64_t seed,
                           std::int64_t run, const ContinueSimulation& progress) {
  return play(scenario, *make_simulator(scenario, simulator), seed, run, progress);
}

}  // namespace touchdown::scenarios
