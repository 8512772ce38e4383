#include "scoring/transitions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fields.hpp"
#include "scoring/classification.hpp"

namespace touchdown::scoring {

namespace {

using Step = std::int64_t;

/// An interval of steps, both ends included.
struct Window {
  Step first = 0;
  Step last = 0;

  bool contains(Step step) const { return first <= step && step <= last; }
};

/// A takeoff or landing, and the steps between its neighbours.
struct TrueEvent {
  Step step = 0;
  Window between;
};

struct Limits {
  Step skip, hold_off, takeoff_opens, landing_opens, minimum_flight;

  /// The steps in which a prediction detects an event, before its neighbours are considered.
  Window around(EventKind kind, Step step) const {
    return {step - (kind == EventKind::takeoff ? takeoff_opens : landing_opens), step + hold_off};
  }
  /// The same between its neighbours.
  Window of(EventKind kind, const TrueEvent& event) const {
    const Window wide = around(kind, event.step);
    return {std::max(wide.first, event.between.first), std::min(wide.last, event.between.last)};
  }
};

Limits limits_in_steps(const ScoringConfig& config, double period) {
  const auto to_steps = [period](double seconds) { return Step{std::llround(seconds / period)}; };
  return {to_steps(config.skip), to_steps(config.hold_off), to_steps(config.takeoff_opens),
          to_steps(config.landing_opens), to_steps(config.minimum_flight)};
}

/// The takeoffs or landings of these flights inside the sequence of `end` steps.
std::vector<TrueEvent> events_of(EventKind kind, const std::vector<Flight>& all, Step end) {
  constexpr Step never = std::numeric_limits<Step>::max();
  std::vector<TrueEvent> events;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto takeoff = static_cast<Step>(all[i].takeoff);
    const auto landing = static_cast<Step>(all[i].landing);
    if (kind == EventKind::takeoff && takeoff > 0) {
      const Step before = i == 0 ? 0 : static_cast<Step>(all[i - 1].landing);
      events.push_back({takeoff, {before, landing < end ? landing - 1 : never}});
    }
    if (kind == EventKind::landing && landing < end) {
      const bool is_last = i + 1 == all.size();
      const Step next = is_last ? never : static_cast<Step>(all[i + 1].takeoff) - 1;
      events.push_back({landing, {takeoff, next}});
    }
  }
  return events;
}

std::vector<Step> predicted_steps(EventKind kind, const ContactSequence& predicted, Step skip) {
  const std::uint8_t after = kind == EventKind::landing ? 1 : 0;
  std::vector<Step> steps;
  for (std::size_t k = 1; k < predicted.size(); ++k) {
    if (predicted[k] == after && predicted[k - 1] != after && static_cast<Step>(k) >= skip) {
      steps.push_back(static_cast<Step>(k));
    }
  }
  return steps;
}

}  // namespace

void describe(Fields& fields, ScoringConfig& scoring) {
  fields("skip", scoring.skip, 0.0, 1e3)
      .doc("s", "The beginning of each run is not scored for this long.");
  fields("hold_off", scoring.hold_off, 0.0, 10.0)
      .doc("s", "After a transition, further ones are ignored for this long.");
  fields("takeoff_opens", scoring.takeoff_opens, 0.0, 10.0)
      .doc("s", "A takeoff may be predicted this early.");
  fields("landing_opens", scoring.landing_opens, 0.0, 10.0)
      .doc("s", "A landing may be predicted this early.");
  fields("minimum_flight", scoring.minimum_flight, 0.0, 10.0)
      .doc("s", "Shorter flights are no events.");
}

std::vector<JudgedTransition> judge_transitions(const ContactSequence& truth,
                                                const ContactSequence& predicted, double period,
                                                const ScoringConfig& config) {
  const Limits limit = limits_in_steps(config, period);
  const auto end = static_cast<Step>(truth.size());
  const std::vector<Flight> all_flights = flights(truth);
  const std::vector<Flight> long_flights =
      flights(truth, static_cast<std::size_t>(limit.minimum_flight));
  // Predictions in these windows are no false alarms: around every true flight, however short, and
  // for the hold-off after it.
  std::vector<Window> tolerated;
  for (const EventKind kind : {EventKind::takeoff, EventKind::landing}) {
    for (const TrueEvent& event : events_of(kind, all_flights, end)) {
      tolerated.push_back(limit.around(kind, event.step));
    }
  }
  std::vector<JudgedTransition> judged;

  for (const EventKind kind : {EventKind::takeoff, EventKind::landing}) {
    const std::vector<Step> predicted_at = predicted_steps(kind, predicted, limit.skip);
    for (const TrueEvent& event : events_of(kind, long_flights, end)) {
      const Window window = limit.of(kind, event);
      // An event with a window that exceeds the scored steps is not counted.
      if (window.first < limit.skip || window.last >= end) continue;
      const auto first = std::find_if(predicted_at.begin(), predicted_at.end(),
                                      [&](Step step) { return window.contains(step); });
      const bool found = first != predicted_at.end();
      judged.push_back({kind, found ? Judgement::detected : Judgement::missed,
                        static_cast<std::size_t>(event.step), found ? *first - event.step : 0});
    }
    Step quiet_until = -1;
    for (const Step step : predicted_at) {
      const bool irrelevant =
          step <= quiet_until || std::any_of(tolerated.begin(), tolerated.end(),
                                             [&](const Window& w) { return w.contains(step); });
      if (irrelevant) continue;
      judged.push_back({kind, Judgement::false_alarm, static_cast<std::size_t>(step), 0});
      quiet_until = step + limit.hold_off;
    }
  }
  return judged;
}

std::vector<std::size_t> extra_switches(const ContactSequence& truth,
                                        const ContactSequence& predicted, double period,
                                        const ScoringConfig& config) {
  const Limits limit = limits_in_steps(config, period);
  const std::vector<Flight> all = flights(truth);
  std::vector<std::size_t> extra;
  for (const EventKind kind : {EventKind::takeoff, EventKind::landing}) {
    const std::vector<Step> steps = predicted_steps(kind, predicted, limit.skip);
    std::vector<bool> detects(steps.size());
    for (const TrueEvent& event : events_of(kind, all, static_cast<Step>(truth.size()))) {
      const Window window = limit.of(kind, event);
      const auto first = std::ranges::lower_bound(steps, window.first);
      if (first == steps.end() || !window.contains(*first)) continue;
      detects[static_cast<std::size_t>(first - steps.begin())] = true;
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (!detects[i]) extra.push_back(static_cast<std::size_t>(steps[i]));
    }
  }
  return extra;
}

void TransitionCounts::add(const JudgedTransition& judged, std::int64_t period_us) {
  if (judged.verdict == Judgement::false_alarm) {
    false_alarms += 1;
    return;
  }
  events += 1;
  if (judged.verdict == Judgement::missed) return;
  const std::int64_t us = judged.latency * period_us;
  detected += 1;
  latency_us += us;
  latency_us_squared += us * us;
  latency.add(us);
}

TransitionCounts& TransitionCounts::operator+=(const TransitionCounts& other) {
  events += other.events;
  detected += other.detected;
  false_alarms += other.false_alarms;
  latency_us += other.latency_us;
  latency_us_squared += other.latency_us_squared;
  latency += other.latency;
  return *this;
}

double TransitionCounts::precision() const { return ratio(detected, detected + false_alarms); }

double TransitionCounts::recall() const { return ratio(detected, events); }

double TransitionCounts::latency_mean() const { return 1e-6 * ratio(latency_us, detected); }

double TransitionCounts::latency_deviation() const {
  if (detected < 2) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(detected);
  const auto sum = static_cast<double>(latency_us);
  const double scatter = static_cast<double>(latency_us_squared) - sum * sum / n;
  return 1e-6 * std::sqrt(std::max(scatter, 0.0) / (n - 1.0));
}

std::size_t first_scored_step(std::int64_t period_us, const ScoringConfig& config) {
  return static_cast<std::size_t>(
      std::llround(config.skip / (1e-6 * static_cast<double>(period_us))));
}

}  // namespace touchdown::scoring
