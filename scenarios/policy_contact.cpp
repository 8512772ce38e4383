#include "scenarios/policy_contact.hpp"

#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/force/support_force.hpp"
#include "estimator/free_fall.hpp"
#include "models/robot_model.hpp"
#include "recordings/signals_from.hpp"
#include "scenarios/leg_geometry.hpp"

namespace touchdown::scenarios {

namespace {

using Touches = std::array<bool, models::wheel_count>;

/// An estimator in the loop: what it hears is what is recorded for it.
policies::WheelContact contact_sources_of(std::shared_ptr<ContactEstimator> estimator) {
  estimator->reset();
  return
      [estimator = std::move(estimator)](const models::Observation& observation, double command) {
        const Belief& belief = estimator->update(recordings::signals_from(observation, command));
        return Touches{belief.wheel[0].contact, belief.wheel[1].contact};
      };
}

policies::WheelContact told_by_truth(const simulators::Simulator& simulator) {
  constexpr double touching = 1.0;  // N, as the labels' default
  return [&simulator](const models::Observation& observation, double /*command*/) {
    if (observation.time <= 0.0) return Touches{true, true};  // no force has acted yet
    const auto& force = simulator.ground_truth().wheel_normal_force;
    return Touches{force[0] > touching, force[1] > touching};
  };
}

policies::WheelContact reported_late(policies::WheelContact contact, std::size_t steps) {
  if (steps == 0) return contact;
  return [contact = std::move(contact), waiting = std::deque<Touches>(steps, {true, true})](
             const models::Observation& observation, double command) mutable {
    waiting.push_back(contact(observation, command));
    const Touches touches = waiting.front();
    waiting.pop_front();
    return touches;
  };
}

policies::WheelContact source(const Scenario& scenario, const simulators::Simulator& simulator) {
  const std::string& name = scenario.policy.contact;
  const double period = simulator.control_period();
  if (name == "upkie_observer") return policies::upkie_contact(period);
  if (name == "always") {
    return [](const models::Observation&, double) { return Touches{true, true}; };
  }
  if (name == "free_fall") {
    return contact_sources_of(std::make_shared<FreeFall>(FreeFallConfig{.sample_rate = 1.0 / period}));
  }
  if (name == "support_force") {
    const models::RobotModel robot = models::compile_robot_model(scenario.robot, {});
    return contact_sources_of(std::make_shared<SupportForce>(
        SupportForceConfig{.sample_rate = 1.0 / period, .geometry = leg_geometry(robot)}));
  }
  if (name == "truth") return told_by_truth(simulator);
  throw InputError(fmt::format("policy.contact: nobody is called '{}'", name));
}

}  // namespace

policies::WheelContact policy_contact(const Scenario& scenario,
                                      const simulators::Simulator& simulator,
                                      policies::WheelContact told) {
  if (!told) told = source(scenario, simulator);
  const auto delay = std::llround(scenario.policy.delay / simulator.control_period());
  return reported_late(std::move(told), static_cast<std::size_t>(delay));
}

}  // namespace touchdown::scenarios
