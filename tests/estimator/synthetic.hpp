#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "estimator/bayes/measurement_model.hpp"
#include "estimator/signals.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::test {

/// A robot that rolls for 0.8 s, falls for 0.2 s, lands with a shock, and repeats. Crude, but it
/// exercises each part of the filter.
inline std::vector<Signals> drops(std::size_t steps, double sample_rate = 1000.0,
                                  std::uint32_t seed = 1) {
  Normal normal(seed);
  std::vector<Signals> signals(steps);
  for (std::size_t i = 0; i < steps; ++i) {
    const double time = static_cast<double>(i) / sample_rate;
    const double phase = std::fmod(time, 1.0);
    const bool air = phase >= 0.8;
    const double since_landing = time >= 1.0 ? phase : 1.0;
    Signals& s = signals[i];
    s.time = time;
    s.vertical_acceleration =
        (air ? -9.81 : 120.0 * std::exp(-since_landing / 0.01) * std::cos(600.0 * since_landing)) +
        0.2 * normal();
    for (int side = 0; side < 2; ++side) {
      const double sign = side == 0 ? 1.0 : -1.0;
      LegSignals& leg = s.leg[static_cast<std::size_t>(side)];
      leg.hip.torque = sign * (air ? 0.1 : 0.8);
      leg.knee.torque = sign * (air ? 0.1 : 1.3 + 0.2 * std::sin(5.0 * time)) + 0.05 * normal();
      leg.wheel.torque = sign * (air ? 0.0 : 0.2 + 0.1 * std::sin(7.0 * time)) + 0.02 * normal();
    }
  }
  return signals;
}

inline bool in_the_air(const Signals& s) { return std::fmod(s.time, 1.0) >= 0.8; }

/// Samples of both legs under a torque configuration, split by contact.
struct LabelledSamples {
  std::vector<TorqueSample> contact;
  std::vector<TorqueSample> no_contact;
};

inline LabelledSamples labelled(const std::vector<Signals>& signals, const TorqueConfig& config,
                                double sample_rate = 1000.0) {
  LabelledSamples samples;
  for (const Side side : {Side::left, Side::right}) {
    TorqueChannel channel(config, side, sample_rate);
    for (const Signals& s : signals) {
      const TorqueSample m = channel.update(s.leg[static_cast<std::size_t>(side)]);
      (in_the_air(s) ? samples.no_contact : samples.contact).push_back(m);
    }
  }
  return samples;
}

}  // namespace touchdown::test
