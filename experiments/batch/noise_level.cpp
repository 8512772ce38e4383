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

TorqueSigmas::TorqueSigmas(std::span<const BatchNoise> batch) {
  check_levels(batch);
  const auto place = [this](double wanted) {
    const auto same = std::find(sigma.begin(), sigma.end(), wanted);
    const auto index = static_cast<std::uint32_t>(same - sigma.begin());
    if (same == sigma.end()) sigma.push_back(wanted);
    return index;
  };
  for (const BatchNoise& one : batch) {
    element.push_back({place(one.knee_torque), place(one.wheel_torque)});
  }
}

}  // namespace touchdown::experiments
