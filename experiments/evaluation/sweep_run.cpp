#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "estimator/neural/input.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

namespace {

/// Counts the contact decisions of a batch step by step. It keeps no single steps, so memory does
/// not grow with the number of levels times steps. Sums are doubles, because the compiler
/// vectorises those; they are exact below 2^53.
class BatchCounts {
 public:
  BatchCounts(const RunSignals& run, std::size_t levels, const scoring::ScoringConfig& scoring)
      : run_(run),
        levels_(levels),
        first_scored_(scoring::first_scored_step(run.info.control_period_us, scoring)),
        segments_(run.segments.size()) {
    for (SegmentCounts& segment : segments_) {
      segment.decided_in_contact.assign(levels, 0.0);
      segment.decided_in_flight.assign(levels, 0.0);
    }
  }

  /// Adds the decisions about one wheel at a step, one per level: contact where `values` reach the
  /// threshold. Steps must come in order.
  void add(std::size_t wheel, std::size_t step, std::span<const double> values, double threshold) {
    if (step < first_scored_) return;
    while (current_ + 1 < run_.segments.size() && step >= run_.segments[current_ + 1]) ++current_;
    const bool truth = run_.contact[wheel][step] != 0;
    SegmentCounts& segment = segments_[current_];
    ++(truth ? segment.contact : segment.flight);
    double* const sum = (truth ? segment.decided_in_contact : segment.decided_in_flight).data();
    const double* const value = values.data();
    const std::size_t levels = values.size();
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::size_t i = 0; i < levels; ++i) sum[i] += value[i] >= threshold ? 1.0 : 0.0;
  }

  /// By level, then segment.
  std::vector<scoring::Classification> result() const {
    std::vector<scoring::Classification> counts;
    counts.reserve(levels_ * segments_.size());
    for (std::size_t level = 0; level < levels_; ++level) {
      for (const SegmentCounts& segment : segments_) {
        const auto in_contact = static_cast<std::int64_t>(segment.decided_in_contact[level]);
        const auto in_flight = static_cast<std::int64_t>(segment.decided_in_flight[level]);
        counts.push_back({.contact_as_contact = in_contact,
                          .contact_as_flight = segment.contact - in_contact,
                          .flight_as_contact = in_flight,
                          .flight_as_flight = segment.flight - in_flight});
      }
    }
    return counts;
  }

 private:
  struct SegmentCounts {
    std::int64_t contact = 0;  ///< steps with this label
    std::int64_t flight = 0;
    std::vector<double> decided_in_contact;  ///< by level, contact decisions at contact steps
    std::vector<double> decided_in_flight;   ///< by level, contact decisions at flight steps
  };

  const RunSignals& run_;
  std::size_t levels_;
  std::size_t first_scored_;
  std::size_t current_ = 0;  ///< index of the segment of the last step
  std::vector<SegmentCounts> segments_;
};

NoiseStep draws_at(const NoiseRun& noise, std::size_t step) {
  NoiseStep draws;
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    const auto& torque = noise.joint[side].torque;
    draws.torque[side] = {torque[1][step], torque[2][step]};
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
  double torque_noise = 0.0;
  for (const noise::SensorNoise& level : levels) {
    noise = std::max(noise, level.acceleration);
    torque_noise = std::max({torque_noise, level.knee_torque, level.wheel_torque});
  }
  // No draw exceeds twenty standard deviations.
  if (!(20.0 * noise < 0.5 * config.largest_acceleration)) return false;
  if (!(20.0 * torque_noise < 0.5 * config.largest_torque)) return false;
  const SignalCheck check;
  SignalGuard guard(config, run.sample_rate());
  for (const Signals& signals : run.signals) {
    const bool torques_good = std::ranges::all_of(signals.leg, [&](const LegSignals& leg) {
      return std::abs(leg.knee.torque) < 0.5 * config.largest_torque &&
             std::abs(leg.wheel.torque) < 0.5 * config.largest_torque;
    });
    if (!torques_good || !neural_input(signals).allFinite()) return false;
    if (check.first_unusable(signals) != SignalIndex::none) return false;
    if (!(std::abs(signals.vertical_acceleration) < 0.5 * config.largest_acceleration)) {
      return false;
    }
    if (guard.check(signals.time, signals.vertical_acceleration).status != SignalStatus::good) {
      return false;
    }
  }
  return true;
}

namespace {

/// Counts of a batch of `count` noise levels on a run, both wheels added: by level, then segment of
/// the run. Calls `should_continue` every few hundred steps. Errors: `Stopped`.
std::vector<scoring::Classification> count_in_batch(const BatchedEstimator& batch,
                                                    std::size_t count, const RunSignals& run,
                                                    const NoiseRun& noise,
                                                    const scoring::ScoringConfig& scoring,
                                                    const std::function<bool()>& should_continue) {
  constexpr std::size_t steps_between_checks = 256;
  BatchCounts counts(run, count, scoring);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (k % steps_between_checks == 0 && !should_continue()) throw Stopped();
    batch.update(run.signals[k], draws_at(noise, k));
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      counts.add(wheel, k, batch.p_contact(static_cast<Side>(wheel)), batch.threshold);
    }
  }
  return counts.result();
}

}  // namespace

std::vector<scoring::Classification> sweep_levels(const EstimatorRunner& runner,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const ShouldContinue& should_continue) {
  const std::size_t segments = run.segments.size();
  std::vector<scoring::Classification> counts(levels.size() * segments);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    if (!should_continue()) throw Stopped();
    const auto decisions = decide(runner, run, noise, levels[level]);
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const auto of_wheel = scoring::classify(run.contact[wheel], decisions[wheel], run.segments,
                                              run.info.control_period_us, scoring);
      for (std::size_t i = 0; i < segments; ++i) counts[level * segments + i] += of_wheel[i];
    }
  }
  return counts;
}

std::vector<scoring::Classification> sweep_run(std::span<const Condition> conditions,
                                               std::span<const noise::NoiseCell> cells,
                                               const RunSignals& run, const NoiseRun& noise,
                                               const FittedModels& models,
                                               const Experiment& experiment,
                                               const ShouldContinue& should_continue) {
  const scoring::ScoringConfig& scoring = experiment.scoring;
  std::vector<noise::SensorNoise> all_levels;
  for (const noise::NoiseCell& cell : cells) all_levels.push_back(cell.levels());
  const bool can_batch = needs_no_guard(run, all_levels);
  const std::size_t segments = run.segments.size();
  std::vector<scoring::Classification> counts;
  counts.reserve(conditions.size() * cells.size() * segments);
  for (const Condition& condition : conditions) {
    const EstimatorEntry entry = entry_of(experiment, condition, models);
    const EstimatorSetup setup = setup_of(experiment, condition, models, run);
    Distinct<noise::SensorNoise> levels;  // that differ for the estimator's sensors
    for (const noise::SensorNoise& level : all_levels) levels.add(noise_of(entry.sensors, level));
    std::optional<BatchedEstimator> batch;
    if (can_batch && entry.batching != nullptr) {
      batch = entry.batching(entry, setup, levels.value);
    }
    const auto one_by_one = [&] {
      return sweep_levels(entry.runner(setup), levels.value, run, noise, scoring, should_continue);
    };
    const std::vector<scoring::Classification> by_level =
        batch ? count_in_batch(*batch, levels.value.size(), run, noise, scoring, should_continue)
              : one_by_one();
    for (const std::size_t level : levels.index) {
      const auto first = by_level.begin() + static_cast<std::ptrdiff_t>(level * segments);
      counts.insert(counts.end(), first, first + static_cast<std::ptrdiff_t>(segments));
    }
  }
  return counts;
}

}  // namespace touchdown::experiments
