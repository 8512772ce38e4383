#include "experiments/estimators/upkie_observer.hpp"

#include "estimator/upkie_observer.hpp"

namespace touchdown::experiments {

EstimatorEntry upkie_observer_entry() {
  // Its hips and knees only tell whether the robot touches the floor with anything.
  return {.name = "upkie_observer",
          .title = "Upkie's observer",
          .summary = "what Upkie runs today: the apparent inertia of each wheel",
          .sensors = {.wheel_torque = true, .joint_velocity = true},
          .make = [](const EstimatorEntry& /*entry*/,
                     const EstimatorSetup& setup) -> std::unique_ptr<ContactEstimator> {
            return std::make_unique<UpkieObserver>(
                UpkieObserverConfig{.time_step = 1.0 / setup.sample_rate});
          }};
}

}  // namespace touchdown::experiments
