#include "experiments/phase_study_score.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace touchdown {

namespace {

std::vector<bool> near_events(const ContactSequence& truth) {
  std::vector<bool> near(truth.size());
  const auto mark = [&](std::size_t event, std::size_t margin) {
    const std::size_t begin = event > margin ? event - margin : 0;
    for (std::size_t k = begin; k < std::min(event + margin, near.size()); ++k) near[k] = true;
  };
  for (const Flight& flight : flights(truth)) {
    mark(flight.takeoff, 20);
    mark(flight.landing, 5);
  }
  return near;
}

/// A tenth of the samples are outliers, four times as far out. Which ones is drawn from a channel
/// that is not otherwise used here: hip encoders are exact.
void give_heavy_tails(UnitNoise& noise, const NoiseKey& key) {
  std::vector<double> pick(noise.vertical_acceleration.size());
  fill_standard_normal(key, NoiseChannel::left_hip_position, 0, pick);
  constexpr double upper_tenth = 1.2815515655446004;
  for (std::size_t k = 0; k < pick.size(); ++k) {
    if (pick[k] < upper_tenth) continue;
    for (std::size_t leg = 0; leg < wheel_count; ++leg) {
      noise.knee_torque[leg][k] *= 4.0;
      noise.wheel_torque[leg][k] *= 4.0;
    }
    for (auto& axis : noise.acceleration) axis[k] *= 4.0;
    noise.vertical_acceleration[k] *= 4.0;
  }
}

Signals disturbed(const HeardRun& run, const UnitNoise& noise, const NoiseLevels& levels,
                  std::size_t k, const Disturbance& d) {
  Signals s = noisy(run, noise, levels, k);
  const Signals late = noisy(run, noise, levels, k - std::min(k, d.imu_delay));
  s.vertical_acceleration = late.vertical_acceleration;
  s.linear_acceleration = late.linear_acceleration;
  s.angular_velocity = late.angular_velocity;
  for (LegSignals& leg : s.leg) {
    leg.knee.torque = d.torque_gain * leg.knee.torque + d.torque_bias;
    leg.wheel.torque = d.torque_gain * leg.wheel.torque + 0.25 * d.torque_bias;
  }
  return s;
}

RunScore judge(const HeardRun& run, const Prediction& prediction) {
  const ScoringConfig scoring;
  RunScore result;
  for (std::size_t w = 0; w < wheel_count; ++w) {
    const ContactSequence& truth = run.contact[w];
    const Score counts = score(truth, prediction[w], {0}, 1000, scoring).front();
    result.points += counts.points;
    result.takeoff += counts.takeoff;
    result.landing += counts.landing;
    result.calibration += counts.calibration;
    const std::vector<bool> near = near_events(truth);
    constexpr double light = 10.0;
    for (std::size_t k = 300; k < truth.size(); ++k) {
      const bool touches = truth[k] != 0;
      const bool predicted = prediction[w].contact[k] != 0;
      if (!near[k]) result.away_from_events.add(touches, predicted);
      if (!touches || run.normal_force[w][k] >= light) result.but_light.add(touches, predicted);
    }
    for (const JudgedTransition& judged :
         judge_transitions(truth, prediction[w].contact, 1e-3, scoring)) {
      if (judged.kind == EventKind::takeoff && judged.verdict == Judgement::detected) {
        result.takeoff_latency.push_back(static_cast<double>(judged.latency));
      }
    }
  }
  result.seconds = 1e-3 * static_cast<double>(run.steps());
  return result;
}

RunScore score_run(const Make& make, const HeardRun& run, const NoiseLevels& levels, int seed,
                   const Disturbance& d) {
  const NoiseKey key{7000 + static_cast<std::uint64_t>(seed),
                     static_cast<std::uint64_t>(run.info.run) + 100'000 * run.info.seed};
  UnitNoise noise = unit_noise(run, key);
  if (d.heavy_tails) give_heavy_tails(noise, key);
  const auto estimator = make();
  Prediction prediction;
  prediction.fill({ContactSequence(run.steps()), std::vector<double>(run.steps())});
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Belief& belief = estimator->update(disturbed(run, noise, levels, k, d));
    for (std::size_t w = 0; w < wheel_count; ++w) {
      prediction[w].contact[k] = std::uint8_t{belief.wheel[w].contact};
      prediction[w].p_contact[k] = belief.wheel[w].p_contact;
    }
  }
  return judge(run, prediction);
}

}  // namespace

std::vector<RunScore> score_runs(const Make& make, const Runs& runs, const NoiseLevels& levels,
                                 const Disturbance& disturbance) {
  std::vector<RunScore> parts(runs.size() * study_noise_seeds);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    parts[i] = score_run(make, runs[i / study_noise_seeds], levels,
                         static_cast<int>(i % study_noise_seeds), disturbance);
  });
  std::vector<RunScore> scores(runs.size());
  for (std::size_t i = 0; i < parts.size(); ++i) scores[i / study_noise_seeds] += parts[i];
  return scores;
}

RunScore sum(const std::vector<RunScore>& scores) {
  RunScore all;
  for (const RunScore& score : scores) all += score;
  return all;
}

double success(const RunScore& score) { return score.points.success(); }

}  // namespace touchdown
