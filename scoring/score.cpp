#include "scoring/score.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml.hpp"

namespace touchdown::scoring {

namespace {

using Counts = TransitionCounts Score::*;

Metric transition_precision(const char* name, Counts of) {
  return {name, [of](const Score& s) { return (s.*of).precision(); },
          [of](const Score& s) { return (s.*of).detected + (s.*of).false_alarms; }};
}

Metric transition_recall(const char* name, Counts of) {
  return {name, [of](const Score& s) { return (s.*of).recall(); },
          [of](const Score& s) { return (s.*of).events; }};
}

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

Score& Score::operator+=(const Score& other) {
  points += other.points;
  events += other.events;
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
  const std::vector<EventScore> events =
      event_scores(truth, track.contact, segments, period_us, config);
  for (std::size_t i = 0; i < segments.size(); ++i) result[i].events = events[i];
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

void add_step(Prediction& prediction, const Belief& belief) {
  const auto views = views_of(belief);
  for (std::size_t v = 0; v < view_count; ++v) {
    prediction[v].contact.push_back(std::uint8_t{views[v].contact});
    prediction[v].p_contact.push_back(views[v].p_contact);
  }
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    prediction[w].load.push_back(belief.wheel[w].load);
  }
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

// N_ab: steps of true state a that are predicted as b, with C contact and F flight. Transitions are
// found, missed or false alarms. t: steps from a true event to its detection, negative if early.
// T: duration of a step.
const std::vector<Metric>& metrics() {
  static const std::vector<Metric> all = {
      // 2 m / (n + d): n true and d decided takeoffs and landings, m pairs at most 20 ms apart.
      {"event_f1", [](const Score& s) { return s.events.f1(); }},
      // Decided switches that detect no event, per minute of a wheel.
      {"extra_switches_per_minute", [](const Score& s) { return s.extra_switches_per_minute(); }},
      // Seconds in wrong intervals of more than 50 ms, per minute of a wheel.
      {"long_errors_s_per_minute", [](const Score& s) { return s.long_errors_s_per_minute(); }},
      // Medians over pairs at most 100 ms apart; negative is early.
      {"takeoff_latency_median_ms", [](const Score& s) { return s.events.takeoff.median(); }},
      {"landing_latency_median_ms", [](const Score& s) { return s.events.landing.median(); }},
      // Mean of the recalls of contact and of flight; in a scene with one of them, its recall.
      {"balanced_accuracy", [](const Score& s) { return s.points.balanced_accuracy(); }},
      // Accuracy: (N_CC + N_FF) / (N_CC + N_CF + N_FC + N_FF).
      {"success", [](const Score& s) { return s.points.success(); }},
      // Share of predicted contact that is true: N_CC / (N_CC + N_FC).
      {"contact_precision", [](const Score& s) { return s.points.contact_precision(); }},
      // Share of true contact that is predicted: N_CC / (N_CC + N_CF).
      {"contact_recall", [](const Score& s) { return s.points.contact_recall(); }},
      // Share of predicted flight that is true: N_FF / (N_FF + N_CF).
      {"no_contact_precision", [](const Score& s) { return s.points.no_contact_precision(); }},
      // Share of true flight that is predicted: N_FF / (N_FF + N_FC).
      {"no_contact_recall", [](const Score& s) { return s.points.no_contact_recall(); }},
      // Share of predicted takeoffs or landings that are true: found / (found + false alarms).
      transition_precision("takeoff_precision", &Score::takeoff),
      // Share of true events that are predicted in time: found / (found + missed).
      transition_recall("takeoff_recall", &Score::takeoff),
      transition_precision("landing_precision", &Score::landing),
      transition_recall("landing_recall", &Score::landing),
      // False alarms of takeoffs per scored minute of a wheel.
      {"false_takeoffs_per_minute", [](const Score& s) { return s.false_takeoffs_per_minute(); }},
      // Mean of t·T over found events, and its sample standard deviation (n − 1).
      {"takeoff_latency_ms", [](const Score& s) { return 1e3 * s.takeoff.latency_mean(); }},
      {"takeoff_latency_deviation_ms",
       [](const Score& s) { return 1e3 * s.takeoff.latency_deviation(); }},
      {"landing_latency_ms", [](const Score& s) { return 1e3 * s.landing.latency_mean(); }},
      {"landing_latency_deviation_ms",
       [](const Score& s) { return 1e3 * s.landing.latency_deviation(); }},
      // Mean squared error of P(contact), p(k), against the truth y(k): Σ (p(k) − y(k))² / N.
      {"brier", [](const Score& s) { return s.calibration.brier(); }},
  };
  return all;
}

std::size_t metric_index(std::string_view name) {
  const std::vector<Metric>& all = metrics();
  const auto found = std::ranges::find(all, name, &Metric::name);
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  std::vector<std::string> names;
  for (const Metric& metric : all) names.push_back(metric.name);
  throw InputError(
      fmt::format("unknown metric '{}' (did you mean '{}'?)", name, nearest(name, names)));
}

const std::vector<std::string>& scored_views() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {"wheels"};
    for (const std::string_view view : view_names) all.emplace_back(view);
    return all;
  }();
  return names;
}

Score score_of_view(const RobotScore& robot, std::size_t view) {
  return view == 0 ? robot.wheels() : robot.view[view - 1];
}

}  // namespace touchdown::scoring
