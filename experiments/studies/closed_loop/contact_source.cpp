#include "experiments/studies/closed_loop/contact_source.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "noise/sensor_noise.hpp"
#include "recordings/signals_from.hpp"

namespace touchdown::experiments {

namespace {

/// What is needed from step to step.
struct Hearing {
  std::unique_ptr<ContactEstimator> estimator;
  noise::ReportingSensors sensors;
  noise::SensorNoise levels;
  noise::NoiseKey draws;
  std::uint64_t step = 0;
  Belief belief = {};
};

}  // namespace

policies::WheelContact contact_source(std::unique_ptr<ContactEstimator> estimator,
                              const ClosedLoopSensors& sensors, double period, ContactTrace& told) {
  estimator->reset();
  const auto hearing = std::make_shared<Hearing>(Hearing{
      std::move(estimator), noise::ReportingSensors(sensors.profile, sensors.sensor_draws, period),
      sensors.levels, sensors.noise_draws});
  return [hearing, &told](const models::Observation& observation, double command) {
    models::Observation heard = observation;
    hearing->sensors.report(std::span(&heard, 1));
    if (!std::isnan(heard.time)) {
      heard = noise::with_noise(heard, hearing->draws, hearing->step, hearing->levels);
      hearing->belief = hearing->estimator->update(recordings::signals_from(heard, command));
    }
    ++hearing->step;
    std::array<bool, models::wheel_count> touches = {};
    for (std::size_t wheel = 0; wheel < touches.size(); ++wheel) {
      const auto& belief = hearing->belief.wheel[wheel];
      touches[wheel] = belief.contact;
      told.contact[wheel].push_back(belief.contact ? 1 : 0);
      told.p_contact[wheel].push_back(static_cast<float>(belief.p_contact));
    }
    return touches;
  };
}

policies::WheelContact recorded(policies::WheelContact contact, ContactTrace& told) {
  return [contact = std::move(contact), &told](const models::Observation& observation,
                                               double command) {
    const std::array<bool, models::wheel_count> touches = contact(observation, command);
    for (std::size_t wheel = 0; wheel < touches.size(); ++wheel) {
      told.contact[wheel].push_back(touches[wheel] ? 1 : 0);
      told.p_contact[wheel].push_back(touches[wheel] ? 1.0F : 0.0F);
    }
    return touches;
  };
}

}  // namespace touchdown::experiments
