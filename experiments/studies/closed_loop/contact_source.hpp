#pragma once

#include <array>
#include <memory>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "noise/sensor_noise.hpp"
#include "noise/sensors/reported.hpp"
#include "policies/wheel_contact.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// What a policy was told, step by step, of each wheel.
struct ContactTrace {
  std::array<scoring::ContactSequence, models::wheel_count> contact;
  std::array<std::vector<float>, models::wheel_count> p_contact;
};

/// Through what an estimator in the loop hears.
struct ClosedLoopSensors {
  noise::SensorProfile profile;
  noise::NoiseKey sensor_draws;  ///< of what the profile leaves to chance
  noise::SensorNoise levels;     ///< on top of that
  noise::NoiseKey noise_draws;
};

/// An estimator as it tells a policy about contact: it hears at every control step what it would
/// hear of the run that is recorded, and where there is no record its last belief stands. `told`
/// must outlive what is returned.
policies::WheelContact contact_source(std::unique_ptr<ContactEstimator> estimator,
                              const ClosedLoopSensors& sensors, double period, ContactTrace& told);

/// Whoever else tells, with what is told noted down.
policies::WheelContact recorded(policies::WheelContact contact, ContactTrace& told);

}  // namespace touchdown::experiments
