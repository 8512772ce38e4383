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

/// The last step with `margin` steps on either side over which no sequence changes; 0 if none.
std::size_t quiet_step(const std::array<const ContactSequence*, 4>& sequences, std::size_t known,
                       std::size_t margin) {
  std::size_t end = known;  // end of the interval without changes that contains step k
  for (std::size_t k = known; k-- > 1;) {
    if (end - k > 2 * margin) return k + margin;
    const bool changes = std::any_of(sequences.begin(), sequences.end(),
                                     [k](const auto* s) { return (*s)[k] != (*s)[k - 1]; });
    if (changes) end = k;
  }
  return 0;
}

/// Removes the first `count` entries from `sequence` and returns them.
template <typename Sequence>
Sequence take_front(Sequence& sequence, std::size_t count) {
  const auto end = sequence.begin() + static_cast<std::ptrdiff_t>(count);
  Sequence front(sequence.begin(), end);
  sequence.erase(sequence.begin(), end);
  return front;
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

ScoreStream::ScoreStream(std::int64_t period_us, const LabelConfig& labels, double robot_mass,
                         const ScoringConfig& scoring)
    : period_us_(period_us),
      scoring_(scoring),
      labels_{LabelStream(1e-6 * static_cast<double>(period_us), robot_mass, labels,
                          [this](std::uint8_t contact) { truth_[0].push_back(contact); }),
              LabelStream(1e-6 * static_cast<double>(period_us), robot_mass, labels,
                          [this](std::uint8_t contact) { truth_[1].push_back(contact); })} {
  const auto steps = [period_us](double seconds) {
    return static_cast<std::size_t>(std::ceil(1e6 * seconds / static_cast<double>(period_us)));
  };
  margin_ = steps(scoring.hold_off + scoring.takeoff_opens + scoring.landing_opens +
                  scoring.minimum_flight + 1e-3 * static_cast<double>(Latencies::longest_ms)) +
            2;
  retry_after_ = steps(10.0);
  next_attempt_ = retry_after_ + steps(scoring.skip) + 2 * margin_;
  longest_ = steps(300.0);
}

void ScoreStream::add(const std::array<double, models::wheel_count>& normal_force,
                      const Belief& belief) {
  add_step(prediction_, belief);
  for (std::size_t wheel = 0; wheel < labels_.size(); ++wheel) {
    labels_[wheel].add(normal_force[wheel]);
  }
  if (prediction_[0].contact.size() >= next_attempt_) cut_if_quiet();
}

void ScoreStream::cut_if_quiet() {
  const std::size_t known = std::min(truth_[0].size(), truth_[1].size());
  // Decisions about any and both wheels change only with a wheel's decision.
  std::size_t end = quiet_step(
      {&truth_[0], &truth_[1], &prediction_[0].contact, &prediction_[1].contact}, known, margin_);
  if (end < first_scored_step(period_us_, scoring_) + margin_) end = 0;
  if (end == 0 && known >= longest_) end = known;
  if (end > 0) score_until(end);
  next_attempt_ = prediction_[0].contact.size() + retry_after_;
}

void ScoreStream::score_until(std::size_t end) {
  std::array<ContactSequence, models::wheel_count> truth;
  Prediction prediction;
  for (std::size_t wheel = 0; wheel < truth.size(); ++wheel) {
    truth[wheel] = take_front(truth_[wheel], end);
  }
  for (std::size_t v = 0; v < view_count; ++v) {
    prediction[v] = {
        take_front(prediction_[v].contact, end), take_front(prediction_[v].p_contact, end), {}};
    prediction_[v].load.clear();  // not scored
  }
  total_ += score(truth, prediction, {0}, period_us_, scoring_).front();
  scoring_.skip = 0.0;  // only the beginning of the run is skipped, not that of a segment
}

RobotScore ScoreStream::finish() {
  for (LabelStream& labels : labels_) labels.finish();
  score_until(truth_[0].size());
  return total_;
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
