#include "experiments/studies/closed_loop/contact_source.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "noise/sensor_noise.hpp"
#include "recordings/signals_from.hpp"

namespace touchdown::experiments {

namespace {

/// The state between control steps.
struct LoopState {
  std::unique_ptr<ContactEstimator> estimator;
  ClosedLoopSensors model;
  noise::ReportingSensors sensors;
  std::uint64_t step = 0;
  Belief belief = {};
};

}  // namespace

policies::WheelContact contact_source(std::unique_ptr<ContactEstimator> estimator,
                                      const ClosedLoopSensors& sensors, double period,
                                      ContactTrace& trace) {
  estimator->reset();
  const auto state = std::make_shared<LoopState>(
      LoopState{std::move(estimator), sensors,
                noise::ReportingSensors(sensors.profile, sensors.sensor_draws, period)});
  return [state, &trace](const models::Observation& observation, const models::Action* previous) {
    models::Observation reported = observation;
    state->sensors.report(std::span(&reported, 1));
    if (!std::isnan(reported.time)) {
      reported =
          noise::with_noise(reported, state->model.noise_draws, state->step, state->model.levels);
      std::optional<models::Action> action;
      if (previous != nullptr) {
        action = *previous;
        noise::report_targets(state->model.profile, state->model.sensor_draws,
                              std::span(&*action, 1));
      }
      state->belief =
          state->estimator->update(recordings::signals_from(reported, action ? &*action : nullptr));
    }
    ++state->step;
    std::array<bool, models::wheel_count> in_contact = {};
    for (std::size_t wheel = 0; wheel < in_contact.size(); ++wheel) {
      const auto& belief = state->belief.wheel[wheel];
      in_contact[wheel] = belief.contact;
      trace.contact[wheel].push_back(belief.contact ? 1 : 0);
      trace.p_contact[wheel].push_back(static_cast<float>(belief.p_contact));
    }
    return in_contact;
  };
}

policies::WheelContact recorded(policies::WheelContact contact, ContactTrace& trace) {
  return [contact = std::move(contact), &trace](const models::Observation& observation,
                                                const models::Action* previous) {
    const std::array<bool, models::wheel_count> in_contact = contact(observation, previous);
    for (std::size_t wheel = 0; wheel < in_contact.size(); ++wheel) {
      trace.contact[wheel].push_back(in_contact[wheel] ? 1 : 0);
      trace.p_contact[wheel].push_back(in_contact[wheel] ? 1.0F : 0.0F);
    }
    return in_contact;
  };
}

}  // namespace touchdown::experiments
