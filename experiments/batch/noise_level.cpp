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

Distinct<double> acceleration_levels(std::span<const BatchNoise> batch) {
  check_levels(batch);
  Distinct<double> levels;
  for (const BatchNoise& element : batch) levels.add(element.acceleration);
  return levels;
}

Distinct<BatchNoise> torque_levels(std::span<const BatchNoise> batch) {
  check_levels(batch);
  Distinct<BatchNoise> levels;
  for (const BatchNoise& element : batch) {
    levels.add({element.knee_torque, element.wheel_torque, 0.0});
  }
  return levels;
}

Distinct<double> torque_sigmas(std::span<const BatchNoise> batch) {
  check_levels(batch);
  Distinct<double> sigmas;
  for (const BatchNoise& element : batch) {
    sigmas.add(element.knee_torque);
    sigmas.add(element.wheel_torque);
  }
  return sigmas;
}

}  // namespace touchdown::experiments
