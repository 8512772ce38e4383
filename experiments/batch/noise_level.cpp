#include "experiments/batch/noise_level.hpp"

#include <cmath>

#include "core/error.hpp"

namespace touchdown::experiments {

void check_levels(std::span<const BatchNoise> levels) {
  if (levels.empty()) throw InputError("a sweep needs at least one noise level");
  for (const BatchNoise& level : levels) {
    for (const double sigma : {level.knee_torque, level.wheel_torque, level.acceleration}) {
      if (!(std::isfinite(sigma) && sigma >= 0.0)) {
        throw InputError("a noise level must be finite and not negative");
      }
    }
  }
}

}  // namespace touchdown::experiments
