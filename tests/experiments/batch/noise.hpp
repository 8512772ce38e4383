#pragma once

#include <cstddef>

#include "estimator/signals.hpp"
#include "experiments/batch/noise_level.hpp"
#include "tests/estimator/synthetic.hpp"

namespace touchdown::experiments {

/// Unit noise on all signals of a batch.
inline NoiseStep draw(test::Normal& normal) {
  NoiseStep draws;
  draws.acceleration = normal();
  for (TorqueSample& torque : draws.torque) torque = {normal(), normal()};
  return draws;
}

/// The signals of one batch element, for a scalar estimator.
inline Signals noisy(Signals s, const NoiseStep& draws, const BatchNoise& level) {
  s.vertical_acceleration += level.acceleration * draws.acceleration;
  for (std::size_t side = 0; side < 2; ++side) {
    s.leg[side].knee.torque += level.knee_torque * draws.torque[side].knee;
    s.leg[side].wheel.torque += level.wheel_torque * draws.torque[side].wheel;
  }
  return s;
}

}  // namespace touchdown::experiments
