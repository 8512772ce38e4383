#include "scoring/transitions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fields.hpp"
#include "scoring/classification.hpp"

namespace touchdown::scoring {

namespace {

using Step = std::int64_t;

/// A stretch of steps, both ends included.
struct Window {
  Step first = 0;
  Step last = 0;

  bool contains(Step step) const { return first <= step && step <= last; }
};

/// A true event that an estimator should announce within `window`.
struct Event {
  Step step = 0;
  Window window;
};

struct Limits {
  Step skip, hold_off, takeoff_opens, landing_opens, minimum_flight, end;
};

Limits limits_in_steps(const ScoringConfig& config, double period, std::size_t steps) {
  const auto to_steps = [period](double seconds) { return Step{std::llround(seconds / period)}; };
  return {to_steps(config.skip),           to_steps(config.hold_off),
          to_steps(config.takeoff_opens),  to_steps(config.landing_opens),
          to_steps(config.minimum_flight), static_cast<Step>(steps)};
}

/// The true flights that are long enough, with both their ends inside the sequence or at its end.
std::vector<Flight> true_flights(const ContactSequence& truth, Step minimum) {
  std::vector<Flight> result = flights(truth);
  std::erase_if(result, [&](const Flight& flight) {
    return static_cast<Step>(flight.landing - flight.takeoff) < minimum;
  });
  return result;
}

std::vector<Event> events_of(EventKind kind, const std::vector<Flight>& all, const Limits& limit) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto takeoff = static_cast<Step>(all[i].takeoff);
    const auto landing = static_cast<Step>(all[i].landing);
    if (kind == EventKind::takeoff && takeoff > 0) {
      const Step before = i == 0 ? 0 : static_cast<Step>(all[i - 1].landing);
      const Step closes = landing < limit.end ? landing - 1 : std::numeric_limits<Step>::max();
      events.push_back({takeoff,
                        {std::max(takeoff - limit.takeoff_opens, before),
                         std::min(takeoff + limit.hold_off, closes)}});
    }
    if (kind == EventKind::landing && landing < limit.end) {
      const Step closes = i + 1 < all.size() ? static_cast<Step>(all[i + 1].takeoff) - 1
                                             : std::numeric_limits<Step>::max();
      events.push_back({landing,
                        {std::max(landing - limit.landing_opens, takeoff),
                         std::min(landing + limit.hold_off, closes)}});
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

/// Where a prediction that announces nothing is not held against the estimator: around every true
/// flight, however short, and for the hold-off after it.
std::vector<Window> excused(const ContactSequence& truth, const Limits& limit) {
  std::vector<Window> windows;
  for (const Flight& flight : flights(truth)) {
    const auto takeoff = static_cast<Step>(flight.takeoff);
    const auto landing = static_cast<Step>(flight.landing);
    if (takeoff > 0) windows.push_back({takeoff - limit.takeoff_opens, takeoff + limit.hold_off});
    if (landing < limit.end) {
      windows.push_back({landing - limit.landing_opens, landing + limit.hold_off});
    }
  }
  return windows;
}

}  // namespace

void describe(Fields& fields, ScoringConfig& scoring) {
  fields("skip", scoring.skip, 0.0, 1e3);
  fields("hold_off", scoring.hold_off, 0.0, 10.0);
  fields("takeoff_opens", scoring.takeoff_opens, 0.0, 10.0);
  fields("landing_opens", scoring.landing_opens, 0.0, 10.0);
  fields("minimum_flight", scoring.minimum_flight, 0.0, 10.0);
}

std::vector<JudgedTransition> judge_transitions(const ContactSequence& truth,
                                                const ContactSequence& predicted, double period,
                                                const ScoringConfig& config) {
  const Limits limit = limits_in_steps(config, period, truth.size());
  const std::vector<Flight> long_flights = true_flights(truth, limit.minimum_flight);
  const std::vector<Window> forgiving = excused(truth, limit);
  std::vector<JudgedTransition> judged;

  for (const EventKind kind : {EventKind::takeoff, EventKind::landing}) {
    const std::vector<Step> announced = predicted_steps(kind, predicted, limit.skip);
    for (const Event& event : events_of(kind, long_flights, limit)) {
      // An event that could not have been found in time is not judged.
      if (event.window.first < limit.skip || event.window.last >= limit.end) continue;
      const auto first = std::find_if(announced.begin(), announced.end(),
                                      [&](Step step) { return event.window.contains(step); });
      const bool found = first != announced.end();
      judged.push_back({kind, found ? Judgement::detected : Judgement::missed,
                        static_cast<std::size_t>(event.step), found ? *first - event.step : 0});
    }
    Step quiet_until = -1;
    for (const Step step : announced) {
      const bool irrelevant =
          step <= quiet_until || std::any_of(forgiving.begin(), forgiving.end(),
                                             [&](const Window& w) { return w.contains(step); });
      if (irrelevant) continue;
      judged.push_back({kind, Judgement::false_alarm, static_cast<std::size_t>(step), 0});
      quiet_until = step + limit.hold_off;
    }
  }
  return judged;
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

}  // namespace touchdown::scoring
