#include "experiments/listening/sweep_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "estimator/neural/input.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/listening/lane_counts.hpp"

namespace touchdown::experiments {

namespace {

NoiseStep draws_at(const NoiseRun& noise, std::size_t step) {
  NoiseStep draws;
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    draws.torque[side] = {noise.knee_torque[side][step], noise.wheel_torque[side][step]};
  }
  draws.acceleration = noise.vertical_acceleration[step];
  draws.linear_acceleration = {noise.acceleration[0][step], noise.acceleration[1][step],
                               noise.acceleration[2][step]};
  return draws;
}

}  // namespace

bool needs_no_guard(const RunSignals& run, std::span<const noise::SensorNoise> levels) {
  const SignalGuardConfig config;
  double noise = 0.0;
  for (const noise::SensorNoise& level : levels) noise = std::max(noise, level.acceleration);
  // No draw is as far out as twenty standard deviations.
  if (!(20.0 * noise < 0.5 * config.largest_acceleration)) return false;
  SignalGuard guard(config, 1e6 / static_cast<double>(run.info.control_period_us));
  for (const Signals& signals : run.signals) {
    const bool torques_good =
        std::all_of(signals.leg.begin(), signals.leg.end(), [](const LegSignals& leg) {
          return std::isfinite(leg.knee.torque) && std::isfinite(leg.wheel.torque);
        });
    if (!torques_good || !neural_input(signals).allFinite()) return false;
    if (!(std::abs(signals.vertical_acceleration) < 0.5 * config.largest_acceleration)) {
      return false;
    }
    if (guard.check(signals.time, signals.vertical_acceleration).status != SignalStatus::good) {
      return false;
    }
  }
  return true;
}

std::vector<scoring::Classification> count_in_lanes(const EstimatorLanes& lanes, std::size_t count,
                                                    const RunSignals& run, const NoiseRun& noise,
                                                    const scoring::ScoringConfig& scoring,
                                                    const std::function<bool()>& going_on) {
  constexpr std::size_t steps_between_questions = 256;
  LaneCounts counts(run, count, scoring);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (k % steps_between_questions == 0 && !going_on()) throw Stopped();
    lanes.update(run.signals[k], draws_at(noise, k));
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      counts.add(wheel, k, lanes.p_contact(static_cast<Side>(wheel)), lanes.threshold);
    }
  }
  return counts.result();
}

}  // namespace touchdown::experiments
