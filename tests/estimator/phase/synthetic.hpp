#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "estimator/phase/fit.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::test {

/// A run with ground truth: rolling, unloading, a flight, an impact; the robot hangs at the end.
struct PhaseRun {
  std::vector<Signals> signals;
  std::array<std::vector<std::uint8_t>, 2> contact;

  [[nodiscard]] PhaseFitRun view() const {
    return {signals, {WheelContact(contact[0]), WheelContact(contact[1])}, true, {}, 0};
  }
};

/// `drops` drops of one second each, then half a second of hanging. The wheels leave the ground
/// `lag` steps apart, the left one first.
inline PhaseRun phase_run(int drops, std::uint32_t seed, int lag = 0, double noise = 0.0) {
  Normal normal(seed);
  PhaseRun run;
  const int steps = 1000 * drops + 500;
  for (int k = 0; k < steps; ++k) {
    const bool hangs = k >= 1000 * drops;
    const int phase = k % 1000;
    const bool off_left = hangs || (phase >= 700 && phase < 900);
    const bool off_right = hangs || (phase >= 700 + lag && phase < 900);
    const double load = hangs || off_left ? 0.0 : (phase >= 600 && phase < 700 ? 0.4 : 1.0);
    const double shock = phase >= 900 ? std::exp(-(phase - 900) / 20.0) : 0.0;
    Signals s;
    s.time = 0.001 * k;
    s.vertical_acceleration =
        (hangs ? 0.0 : (off_left ? -9.81 : (load - 1.0) * 9.81 + 80.0 * shock)) +
        (0.3 + noise) * normal();
    for (int side = 0; side < 2; ++side) {
      const double sign = side == 0 ? 1.0 : -1.0;
      LegSignals& leg = s.leg[static_cast<std::size_t>(side)];
      leg.knee.torque =
          sign * (1.3 * load + 6.0 * shock + 0.02 * std::sin(0.05 * k)) + (0.02 + noise) * normal();
      leg.wheel.torque = sign * (0.3 * load - 0.8 * shock) + (0.02 + noise) * normal();
    }
    run.signals.push_back(s);
    run.contact[0].push_back(off_left ? 0 : 1);
    run.contact[1].push_back(off_right ? 0 : 1);
  }
  return run;
}

/// Small enough for tests: two noise levels, coarse grids.
inline PhaseFitConfig small_phase_fit() {
  PhaseFitConfig config;
  config.torque_noise = {0.0, 0.4};
  config.acceleration_noise = {0.0, 2.0};
  config.grid_step = 0.5;
  return config;
}

inline PhaseModel small_phase_model() {
  const PhaseRun run = phase_run(4, 7, 6);
  const std::vector<PhaseFitRun> runs = {run.view()};
  return fit_phase_model(runs, 1000.0, small_phase_fit());
}

}  // namespace touchdown::test
