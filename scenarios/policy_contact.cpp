#include "scenarios/policy_contact.hpp"

#include <cmath>
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

using WheelContacts = std::array<bool, models::wheel_count>;

/// Contact from an estimator in the loop. It gets the signals that a recording would give it.
policies::WheelContact contact_from(std::shared_ptr<ContactEstimator> estimator) {
  estimator->reset();
  return [estimator = std::move(estimator)](const models::Observation& observation,
                                            const models::Action* previous) {
    const Belief& belief = estimator->update(recordings::signals_from(observation, previous));
    return WheelContacts{belief.wheel[0].contact, belief.wheel[1].contact};
  };
}

policies::WheelContact contact_from_truth(const simulators::Simulator& simulator) {
  constexpr double threshold = 1.0;  // N, the labels' default
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
  if (name == "support_force") {
    const models::RobotModel robot = models::compile_robot_model(scenario.robot, {});
    return contact_from(std::make_shared<SupportForce>(
        SupportForceConfig{.sample_rate = 1.0 / period, .geometry = leg_geometry(robot)}));
  }
  if (name == "truth") return contact_from_truth(simulator);
  throw InputError(fmt::format("policy.contact: unknown contact source '{}'", name));
}

}  // namespace

policies::WheelContact policy_contact(const Scenario& scenario,
                                      const simulators::Simulator& simulator,
                                      policies::WheelContact contact_source) {
  if (!contact_source) contact_source = named_source(scenario, simulator);
  const auto delay = std::llround(scenario.policy.delay / simulator.control_period());
  return delayed(std::move(contact_source), static_cast<std::size_t>(delay));
}

}  // namespace touchdown::scenarios
