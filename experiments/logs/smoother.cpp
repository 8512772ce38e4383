#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/logs/estimator.hpp"

namespace touchdown::experiments {

namespace {

/// Chosen on drawn scenes, by errors of edges, missed and additional ones, and accuracy.
struct Smoothing {
  static constexpr double forward_weight = 0.6;  ///< of forward logits; the rest: backward ones
  static constexpr double lead = 1e-3;           ///< forward logits come from so much later (s)
  static constexpr double threshold = 1.0;       ///< mean logit of both states alike (nats)
  static constexpr double switch_cost = 3.0;     ///< of a takeoff or a landing (nats)
  static constexpr double correlation = 1e-3;    ///< a step counts by its part of this time (s)
};

using Logits = std::array<double, models::wheel_count>;  ///< NaN: no inputs

/// A step with inputs of both wheels.
struct KnownStep {
  double time = 0.0;
  double counts = 1.0;  ///< of the evidence
  Logits logit = {};    ///< above the threshold
};

/// Contact of a wheel, one per step.
using Path = std::vector<std::uint8_t>;

Logits logits_of(const ContactEstimator& estimator) {
  const Evidence evidence = estimator.evidence();
  Logits logits;
  for (std::size_t wheel = 0; wheel < logits.size(); ++wheel) {
    const Evidence::Contributions& one = evidence.contributions[wheel];
    constexpr double surest = 30.0;  // as in `LogitDecision`
    const double sum =
        one.load + one.ground_torque + one.axle_motion + one.torso + one.other_leg + one.offset;
    logits[wheel] = std::isnan(sum) ? sum : std::clamp(sum, -surest, surest);
  }
  return logits;
}

/// One logit of two, by weight; the other one where one is missing.
double mean_of_passes(double forward, double backward) {
  if (std::isnan(forward)) return backward;
  if (std::isnan(backward)) return forward;
  return Smoothing::forward_weight * forward + (1.0 - Smoothing::forward_weight) * backward;
}

/// The sequence with the most evidence, less the costs of its switches (Viterbi).
Path most_probable(std::span<const KnownStep> steps, std::size_t wheel) {
  const auto evidence = [&](std::size_t k) { return steps[k].counts * steps[k].logit.at(wheel); };
  std::vector<std::array<std::uint8_t, 2>> from(steps.size());  ///< the best state before
  std::array<double, 2> sum = {0.0, evidence(0)};               ///< air, contact
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const bool landed = sum[0] - Smoothing::switch_cost > sum[1];
    const bool took_off = sum[1] - Smoothing::switch_cost > sum[0];
    from[k] = {std::uint8_t{took_off}, std::uint8_t{!landed}};
    sum = {took_off ? sum[1] - Smoothing::switch_cost : sum[0],
           (landed ? sum[0] - Smoothing::switch_cost : sum[1]) + evidence(k)};
  }
  Path path(steps.size());
  path.back() = std::uint8_t{sum[1] > sum[0]};
  for (std::size_t k = steps.size() - 1; k > 0; --k) path[k - 1] = from[k].at(path[k]);
  return path;
}

/// The lowest mean probability of the path over any 20 ms of these steps.
double sureness(std::span<const KnownStep> steps, std::span<const std::uint8_t> path,
                std::size_t wheel, double period) {
  const std::size_t window =
      std::min(steps.size(), static_cast<std::size_t>(std::max(std::llround(0.02 / period), 1LL)));
  const auto probability = [&](std::size_t k) {
    const double logit = steps[k].logit.at(wheel);
    return 1.0 / (1.0 + std::exp(path[k] != 0 ? -logit : logit));
  };
  double sum = 0.0;
  double lowest = 1.0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    sum += probability(k);
    if (k >= window) sum -= probability(k - window);
    if (k + 1 >= window) lowest = std::min(lowest, sum / static_cast<double>(window));
  }
  return std::max(lowest, 0.0);
}

/// Adds the intervals of steps without a gap.
void add_intervals(std::span<const KnownStep> steps, double period,
                   std::vector<logs::ContactInterval>& intervals) {
  if (steps.empty()) return;
  const std::array<Path, 2> path = {most_probable(steps, 0), most_probable(steps, 1)};
  std::size_t begin = 0;
  for (std::size_t k = 1; k <= steps.size(); ++k) {
    const bool is_end = k == steps.size();
    if (!is_end && path[0][k] == path[0][k - 1] && path[1][k] == path[1][k - 1]) continue;
    logs::ContactInterval& one = intervals.emplace_back();
    one.start = steps[begin].time;
    one.end = is_end ? steps.back().time + period : steps[k].time;
    one.sure = 1.0;
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      one.contact[wheel] = path[wheel][begin] != 0;
      one.sure = std::min(
          *one.sure, sureness(steps.subspan(begin, k - begin),
                              std::span(path[wheel]).subspan(begin, k - begin), wheel, period));
    }
    begin = k;
  }
}

/// The same motion backwards in time, which torques and targets' torques fit, too; times count from
/// `end` (s).
Signals backwards(Signals signals, double end) {
  signals.time = end - signals.time;
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    LegSignals& leg = signals.leg[side];
    LegTargets& targets = signals.target[side];
    const auto turn = [](JointSignals& joint, JointTarget& target) {
      // The law's torque stays that of the motion forwards.
      target.feedforward_torque += 2.0 * target.kd * (target.velocity - joint.velocity);
      target.velocity = -target.velocity;
      joint.velocity = -joint.velocity;
    };
    turn(leg.hip, targets.hip);
    turn(leg.knee, targets.knee);
    turn(leg.wheel, targets.wheel);
  }
  signals.angular_velocity = -signals.angular_velocity;
  signals.ground_velocity_command = -signals.ground_velocity_command;
  return signals;
}

}  // namespace

logs::ContactIntervals smoothed_contact(LogSteps& log, const LogEstimator& chosen,
                                        const logs::RecordingInfo& info) {
  if (!share_model(chosen.entry, evidence_curves_entry())) {
    throw InputError(fmt::format(
        "label: expected evidence curves, which serve both directions of time, found '{}'",
        chosen.entry.name));
  }
  const std::unique_ptr<ContactEstimator> estimator = chosen.make(log.sample_rate(), info);
  std::vector<Signals> signals;
  std::vector<Logits> forward;
  while (const LogStep* step = log.next()) {
    if (!std::isfinite(step->signals.time)) continue;
    if (!signals.empty() && !(step->signals.time > signals.back().time)) continue;
    signals.push_back(step->signals);
    estimator->update(step->signals);
    forward.push_back(logits_of(*estimator));
  }
  estimator->reset();
  std::vector<Logits> backward(signals.size());
  for (std::size_t k = signals.size(); k-- > 0;) {
    estimator->update(backwards(signals[k], signals.back().time));
    backward[k] = logits_of(*estimator);
  }
  const double gap = SignalGuardConfig{}.maximum_gap;
  const auto lead = static_cast<std::size_t>(std::llround(Smoothing::lead / log.period()));
  logs::ContactIntervals labels;
  std::vector<KnownStep> known;
  for (std::size_t k = 0; k < signals.size(); ++k) {
    KnownStep step{.time = signals[k].time};
    const Logits& later = forward[std::min(k + lead, signals.size() - 1)];
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      step.logit[wheel] = mean_of_passes(later[wheel], backward[k][wheel]) - Smoothing::threshold;
    }
    if (std::isnan(step.logit[0]) || std::isnan(step.logit[1])) continue;
    const double elapsed = known.empty() ? log.period() : step.time - known.back().time;
    if (elapsed > gap) {
      add_intervals(known, log.period(), labels.intervals);
      known.clear();
    }
    step.counts = std::min(elapsed, gap) / Smoothing::correlation;
    known.push_back(step);
  }
  add_intervals(known, log.period(), labels.intervals);
  return labels;
}

}  // namespace touchdown::experiments
