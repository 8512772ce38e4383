#pragma once

#include <array>
#include <memory>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "noise/reported_signals.hpp"
#include "noise/sensor_noise.hpp"
#include "policies/wheel_contact.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// The contact that a policy received for each wheel, step by step.
struct ContactTrace {
  std::array<scoring::ContactSequence, models::wheel_count> contact;
  std::array<std::vector<float>, models::wheel_count> p_contact;
};

/// Sensors and noise between the robot and an estimator in the loop.
struct ClosedLoopSensors {
  noise::SensorProfile profile;
  noise::NoiseKey sensor_draws;  ///< of the random parts of the profile
  noise::SensorNoise levels;     ///< added to the output of the sensors
  noise::NoiseKey noise_draws;
};

/// Makes an estimator the contact source of a policy. At every control step it receives the signals
/// of an offline evaluation of this run, so that both give the same decisions. At a step without a
/// record the last belief holds. `period` in seconds. `trace` records the contact and must outlive
/// the result.
policies::WheelContact contact_source(std::unique_ptr<ContactEstimator> estimator,
                                      const ClosedLoopSensors& sensors, double period,
                                      ContactTrace& trace);

/// Another contact source, recorded in `trace`, which must outlive the result.
policies::WheelContact recorded(policies::WheelContact contact, ContactTrace& trace);

}  // namespace touchdown::experiments
