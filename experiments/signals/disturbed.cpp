#include "experiments/signals/disturbed.hpp"

#include <algorithm>

namespace touchdown::experiments {

NoiseRun with_heavy_tails(NoiseRun noise, const noise::NoiseKey& key) {
  // Which samples is drawn from a channel that is not otherwise used: hip encoders are exact here.
  std::vector<double> pick(noise.vertical_acceleration.size());
  noise::fill_standard_normal(key, noise::NoiseChannel::left_hip_position, 0, pick);
  constexpr double upper_tenth = 1.2815515655446004;
  for (std::size_t k = 0; k < pick.size(); ++k) {
    if (pick[k] < upper_tenth) continue;
    for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
      noise.knee_torque[leg][k] *= 4.0;
      noise.wheel_torque[leg][k] *= 4.0;
    }
    for (auto& axis : noise.acceleration) axis[k] *= 4.0;
    noise.vertical_acceleration[k] *= 4.0;
  }
  return noise;
}

Signals disturbed(const RunSignals& run, const NoiseRun& noise, const noise::SensorNoise& levels,
                  std::size_t step, const noise::Disturbance& disturbance) {
  Signals signals = noisy(run, noise, levels, step);
  const Signals late = noisy(run, noise, levels, step - std::min(step, disturbance.imu_delay));
  signals.vertical_acceleration = late.vertical_acceleration;
  signals.linear_acceleration = late.linear_acceleration;
  signals.angular_velocity = late.angular_velocity;
  for (LegSignals& leg : signals.leg) {
    leg.knee.torque = disturbance.torque_gain * leg.knee.torque + disturbance.torque_bias;
    leg.wheel.torque = disturbance.torque_gain * leg.wheel.torque + 0.25 * disturbance.torque_bias;
  }
  return signals;
}

}  // namespace touchdown::experiments
