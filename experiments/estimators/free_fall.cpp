#include "experiments/estimators/free_fall.hpp"

#include "estimator/free_fall.hpp"

namespace touchdown::experiments {

EstimatorEntry free_fall_entry() {
  return {.name = "free_fall",
          .title = "Free fall",
          .summary = "a threshold on the vertical acceleration: what falls is in the air",
          .sensors = {.acceleration = true},
          .make = [](const EstimatorEntry& /*entry*/,
                     const EstimatorSetup& setup) -> std::unique_ptr<ContactEstimator> {
            return std::make_unique<FreeFall>(FreeFallConfig{.sample_rate = setup.sample_rate});
          }};
}

}  // namespace touchdown::experiments
