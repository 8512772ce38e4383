#include "scoring/score.hpp"

#include <algorithm>
#include <cmath>

namespace touchdown::scoring {

namespace {

/// Calls `visit(segment, step)` for every scored step.
template <typename Visit>
void for_scored_steps(std::size_t steps, const std::vector<std::size_t>& segments,
                      std::int64_t period_us, const ScoringConfig& config, const Visit& visit) {
  const std::size_t first = first_scored_step(period_us, config);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::size_t end = i + 1 < segments.size() ? segments[i + 1] : steps;
    for (std::size_t k = std::max(segments[i], first); k < end; ++k) visit(i, k);
  }
}

}  // namespace

std::size_t first_scored_step(std::int64_t period_us, const ScoringConfig& config) {
  return static_cast<std::size_t>(
      std::llround(config.skip / (1e-6 * static_cast<double>(period_us))));
}

Score& Score::operator+=(const Score& other) {
  points += other.points;
  takeoff += other.takeoff;
  landing += other.landing;
  calibration += other.calibration;
  scored_us += other.scored_us;
  return *this;
}

std::vector<Score> score(const ContactSequence& truth, const Track& track,
                         const std::vector<std::size_t>& segments, std::int64_t period_us,
                         const ScoringConfig& config) {
  std::vector<Score> result(segments.size());
  for_scored_steps(truth.size(), segments, period_us, config,
                   [&](std::size_t segment, std::size_t k) {
                     result[segment].points.add(truth[k] != 0, track.contact[k] != 0);
                     result[segment].calibration.add(truth[k] != 0, track.p_contact[k]);
                     result[segment].scored_us += period_us;
                   });
  const double period = 1e-6 * static_cast<double>(period_us);
  for (const JudgedTransition& judged : judge_transitions(truth, track.contact, period, config)) {
    const auto after = std::upper_bound(segments.begin(), segments.end(), judged.step);
    Score& segment = result[static_cast<std::size_t>(after - segments.begin()) - 1];
    (judged.kind == EventKind::takeoff ? segment.takeoff : segment.landing).add(judged, period_us);
  }
  return result;
}

std::vector<Classification> classify(const ContactSequence& truth, const ContactSequence& predicted,
                                     const std::vector<std::size_t>& segments,
                                     std::int64_t period_us, const ScoringConfig& config) {
  std::vector<Classification> result(segments.size());
  for_scored_steps(truth.size(), segments, period_us, config,
                   [&](std::size_t segment, std::size_t k) {
                     result[segment].add(truth[k] != 0, predicted[k] != 0);
                   });
  return result;
}

RobotScore& RobotScore::operator+=(const RobotScore& other) {
  for (std::size_t v = 0; v < view_count; ++v) view[v] += other.view[v];
  return *this;
}

Score RobotScore::wheels() const {
  Score sum = (*this)[View::left_wheel];
  sum += (*this)[View::right_wheel];
  return sum;
}

std::vector<RobotScore> score(const std::array<ContactSequence, models::wheel_count>& truth,
                              const Prediction& prediction,
                              const std::vector<std::size_t>& segments, std::int64_t period_us,
                              const ScoringConfig& config) {
  const std::array<ContactSequence, view_count> truths = {truth[0], truth[1], any_wheel(truth),
                                                          both_wheels(truth)};
  std::vector<RobotScore> result(segments.size());
  for (std::size_t v = 0; v < view_count; ++v) {
    const std::vector<Score> scores = score(truths[v], prediction[v], segments, period_us, config);
    for (std::size_t i = 0; i < segments.size(); ++i) result[i].view[v] = scores[i];
  }
  return result;
}

}  // namespace touchdown::scoring
