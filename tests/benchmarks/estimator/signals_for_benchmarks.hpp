#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "estimator/bayes/filter.hpp"

namespace touchdown::bench {

/// Rolling, flights and landings on bent legs with sensor noise, one step per millisecond.
inline std::vector<Signals> signals(std::size_t steps) {
  std::mt19937 engine(1);
  const auto noise = [&engine] { return static_cast<double>(engine()) / 2147483648.0 - 1.0; };
  std::vector<Signals> stream(steps);
  for (std::size_t i = 0; i < steps; ++i) {
    const double time = 0.001 * static_cast<double>(i);
    const double phase = std::fmod(time, 1.0);
    const bool air = phase > 0.8;
    Signals& s = stream[i];
    s.time = time;
    s.vertical_acceleration =
        (air ? -9.81 : 150.0 * std::exp(-phase / 0.01) * std::cos(600.0 * phase)) + 3.0 * noise();
    for (int side = 0; side < 2; ++side) {
      LegSignals& leg = s.leg[static_cast<std::size_t>(side)];
      const double sign = side == 0 ? 1.0 : -1.0;
      leg.knee.torque = sign * (air ? 0.1 : 1.3) + 0.5 * noise();
      leg.wheel.torque = sign * (air ? 0.0 : 0.2) + 0.2 * noise();
      // Crouched and swaying, because estimators of loads divide by a function of the pose.
      const double sway = 0.01 * std::sin(20.0 * time);
      leg.hip = {sign * (0.455 + sway), sign * 0.2 * std::cos(20.0 * time), sign * 0.4};
      leg.knee.position = -sign * (0.791 + 2.0 * sway);
      leg.knee.velocity = -sign * 0.4 * std::cos(20.0 * time);
      leg.wheel.position = 10.0 * time;
      leg.wheel.velocity = 10.0;
      LegTargets& target = s.target[static_cast<std::size_t>(side)];
      target.hip = {leg.hip.position + sign * 0.01, 0.0, 0.0, 40.0, 2.0};
      target.knee = {leg.knee.position + sign * (air ? 0.0 : 0.03), 0.0, 0.0, 40.0, 2.0};
    }
  }
  return stream;
}

/// A model of the usual size, fitted to these signals.
inline MeasurementModel model(const BayesFilterConfig& config) {
  std::vector<TorqueSample> contact;
  std::vector<TorqueSample> no_contact;
  TorqueChannel channel(config.measurement.torque, Side::left, config.sample_rate);
  for (const Signals& s : signals(10'000)) {
    const bool air = std::fmod(s.time, 1.0) > 0.8;
    (air ? no_contact : contact).push_back(channel.update(s.leg[0]));
  }
  return fit_measurement_model(contact, no_contact, config.measurement.fit);
}

}  // namespace touchdown::bench
