#include "experiments/sweep_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "estimator/bayes_filter_lanes.hpp"
#include "estimator/free_fall.hpp"
#include "estimator/measurement_only.hpp"
#include "estimator/neural_estimator.hpp"
#include "estimator/neural_lanes.hpp"
#include "estimator/phase_filter.hpp"
#include "estimator/phase_lanes.hpp"
#include "estimator/wheel_contact_observer.hpp"
#include "experiments/always_contact.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/lane_counts.hpp"
#include "experiments/oracle.hpp"
#include "experiments/stopped.hpp"

namespace touchdown {

namespace {

std::vector<NoiseLevel> lane_levels(std::span<const NoiseLevels> levels) {
  std::vector<NoiseLevel> lanes;
  for (const NoiseLevels& level : levels) {
    lanes.push_back({level.knee_torque, level.wheel_torque, level.acceleration});
  }
  return lanes;
}

NoiseDraws draws_at(const UnitNoise& noise, std::size_t step) {
  NoiseDraws draws;
  for (std::size_t side = 0; side < wheel_count; ++side) {
    draws.torque[side] = {noise.knee_torque[side][step], noise.wheel_torque[side][step]};
  }
  draws.acceleration = noise.vertical_acceleration[step];
  return draws;
}

/// Walks through the run, calling `listen(step)` and then counting what `said(wheel)` returns.
template <typename Listen, typename Said>
std::vector<Classification> walk(const HeardRun& run, std::size_t lanes, double threshold,
                                 const ScoringConfig& scoring,
                                 const std::function<bool()>& going_on, const Listen& listen,
                                 const Said& said) {
  constexpr std::size_t steps_between_questions = 256;
  LaneCounts counts(run, lanes, scoring);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (k % steps_between_questions == 0 && !going_on()) throw Stopped();
    listen(k);
    for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
      counts.add(wheel, k, said(static_cast<Side>(wheel)), threshold);
    }
  }
  return counts.result();
}

}  // namespace

NoiseLevels heard_part(const ContactEstimator& estimator, const NoiseLevels& levels) {
  const auto is = [&]<typename Estimator>(const Estimator* /*type*/) {
    return dynamic_cast<const Estimator*>(&estimator) != nullptr;
  };
  NoiseLevels heard = levels;
  // The filters listen to torques and accelerations, not to encoders.
  if (is(static_cast<const BayesFilter*>(nullptr)) ||
      is(static_cast<const PhaseFilter*>(nullptr))) {
    heard.joint_position = heard.joint_velocity = 0.0;
  } else if (is(static_cast<const MeasurementOnly*>(nullptr))) {
    heard = {.knee_torque = levels.knee_torque, .wheel_torque = levels.wheel_torque};
  } else if (is(static_cast<const FreeFall*>(nullptr))) {
    heard = {.acceleration = levels.acceleration};
  } else if (is(static_cast<const UpkieObserver*>(nullptr))) {
    // Its knees only tell whether the robot touches the floor with anything.
    heard = {.wheel_torque = levels.wheel_torque, .joint_velocity = levels.joint_velocity};
  } else if (is(static_cast<const NeuralEstimator*>(nullptr))) {
    heard.knee_torque = heard.wheel_torque = 0.0;
  } else if (is(static_cast<const AlwaysContact*>(nullptr)) ||
             is(static_cast<const Oracle*>(nullptr))) {
    heard = {};
  }
  return heard;
}

bool needs_no_guard(const HeardRun& run, std::span<const NoiseLevels> levels) {
  const SignalGuardConfig config;
  double noise = 0.0;
  for (const NoiseLevels& level : levels) noise = std::max(noise, level.acceleration);
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

std::vector<Classification> sweep_in_lanes(const ContactEstimator& estimator,
                                           const Condition& condition, const FittedModels& models,
                                           std::span<const NoiseLevels> levels, const HeardRun& run,
                                           const UnitNoise& noise, const ScoringConfig& scoring,
                                           const std::function<bool()>& going_on) {
  const auto model = [&]() -> const FittedModel& {
    return models.at(condition.fit_simulator).at(condition.estimator);
  };
  const auto count = [&](double threshold, const auto& listen, const auto& said) {
    return walk(run, levels.size(), threshold, scoring, going_on, listen, said);
  };
  if (const auto* filter = dynamic_cast<const BayesFilter*>(&estimator)) {
    BayesFilterLanes lanes(*model().measurement, filter->config(), lane_levels(levels));
    return count(
        filter->config().threshold,
        [&](std::size_t k) { lanes.update(run.signals[k], draws_at(noise, k)); },
        [&](Side side) { return lanes.p_contact(side); });
  }
  if (const auto* ablation = dynamic_cast<const MeasurementOnly*>(&estimator)) {
    MeasurementLanes lanes(*model().measurement, ablation->config(), lane_levels(levels));
    return count(
        ablation->config().threshold,
        [&](std::size_t k) { lanes.update(run.signals[k], draws_at(noise, k)); },
        [&](Side side) { return lanes.p_measurement(side); });
  }
  if (const auto* phase = dynamic_cast<const PhaseFilter*>(&estimator)) {
    PhaseLanes lanes(model().phase->model, phase->config(), lane_levels(levels));
    return count(
        0.5, [&](std::size_t k) { lanes.update(run.signals[k], draws_at(noise, k)); },
        [&](Side side) { return lanes.contact(side); });
  }
  const bool encoders_are_exact =
      std::all_of(levels.begin(), levels.end(), [](const NoiseLevels& level) {
        return level.joint_position == 0.0 && level.joint_velocity == 0.0;
      });
  if (const auto* network = dynamic_cast<const NeuralEstimator*>(&estimator);
      network != nullptr && encoders_are_exact) {
    std::vector<double> sigmas;
    for (const NoiseLevels& level : levels) sigmas.push_back(level.acceleration);
    NeuralLanes lanes(network->network(), network->config(), sigmas);
    return count(
        network->config().threshold,
        [&](std::size_t k) {
          lanes.update(run.signals[k], {noise.acceleration[0][k], noise.acceleration[1][k],
                                        noise.acceleration[2][k]});
        },
        [&](Side /*side*/) { return lanes.p_contact(); });
  }
  return {};
}

}  // namespace touchdown
