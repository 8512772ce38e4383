#include "scoring/extended_score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace touchdown::scoring {

namespace {

/// Whether a step is within 20 ms of a takeoff or 5 ms of a landing.
std::vector<bool> near_events(const ContactSequence& truth, std::int64_t period_us) {
  std::vector<bool> near(truth.size());
  const auto mark = [&](std::size_t event, std::int64_t margin_us) {
    const auto margin = static_cast<std::size_t>(margin_us / period_us);
    const std::size_t begin = event > margin ? event - margin : 0;
    for (std::size_t k = begin; k < std::min(event + margin, near.size()); ++k) near[k] = true;
  };
  for (const Flight& flight : flights(truth)) {
    mark(flight.takeoff, 20'000);
    mark(flight.landing, 5'000);
  }
  return near;
}

/// Flights of a sequence, cut to the steps from `first` on.
std::vector<Flight> flights_from(const ContactSequence& contact, std::size_t first) {
  std::vector<Flight> result = flights(contact);
  std::erase_if(result, [&](const Flight& flight) { return flight.landing <= first; });
  for (Flight& flight : result) flight.takeoff = std::max(flight.takeoff, first);
  return result;
}

std::size_t common_steps(const Flight& a, const Flight& b) {
  const std::size_t begin = std::max(a.takeoff, b.takeoff);
  return std::max(begin, std::min(a.landing, b.landing)) - begin;
}

std::size_t length(const Flight& flight) { return flight.landing - flight.takeoff; }

FlightCounts match_flights(const ContactSequence& truth, const ContactSequence& prediction,
                           std::size_t first, std::size_t shortest) {
  FlightCounts counts;
  const std::vector<Flight> real = flights_from(truth, first);
  std::vector<Flight> predicted = flights_from(prediction, first);
  const auto is_short = [&](const Flight& flight) { return length(flight) < shortest; };
  const auto matches = [](const Flight& flight, const Flight& one) {
    const std::size_t common = common_steps(flight, one);
    return 2 * common > length(flight) + length(one) - common;
  };
  // Each flight has at most one match: it shares more than half of the union.
  std::erase_if(predicted, [&](const Flight& one) {
    const bool is_match = std::ranges::any_of(
        real, [&](const Flight& flight) { return !is_short(flight) && matches(flight, one); });
    counts.matched += is_match ? 1 : 0;
    counts.predicted += is_match ? 1 : 0;
    return is_match;
  });
  // Of the others, a flight that overlaps a true flight below the minimum duration is not counted.
  counts.predicted += std::count_if(predicted.begin(), predicted.end(), [&](const Flight& one) {
    return std::none_of(real.begin(), real.end(), [&](const Flight& flight) {
      return is_short(flight) && common_steps(flight, one) > 0;
    });
  });
  counts.truth = static_cast<std::int64_t>(std::count_if(
      real.begin(), real.end(), [&](const Flight& flight) { return !is_short(flight); }));
  return counts;
}

}  // namespace

void Latencies::add(std::int64_t latency_us) {
  const std::int64_t bin = latency_us / 1000 - first_ms;
  events[static_cast<std::size_t>(
      std::clamp<std::int64_t>(bin, 0, static_cast<std::int64_t>(count) - 1))] += 1;
}

Latencies& Latencies::operator+=(const Latencies& other) {
  for (std::size_t i = 0; i < count; ++i) events[i] += other.events[i];
  return *this;
}

std::int64_t Latencies::total() const {
  return std::accumulate(events.begin(), events.end(), std::int64_t{0});
}

double Latencies::ranked(std::int64_t rank) const {
  std::int64_t passed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    passed += events[i];
    if (rank >= 1 && passed >= rank) return static_cast<double>(first_ms + static_cast<int>(i));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Latencies Latencies::absolute() const {
  Latencies absolute;
  for (std::size_t i = 0; i < count; ++i) {
    const auto ms = std::abs(first_ms + static_cast<std::int64_t>(i));
    absolute.events[static_cast<std::size_t>(ms - first_ms)] += events[i];
  }
  return absolute;
}

double Latencies::percentile(double share) const {
  const std::int64_t all = total();
  const auto rank = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(all)));
  return ranked(all > 0 ? std::max<std::int64_t>(rank, 1) : 0);
}

double Latencies::absolute_percentile(double share) const { return absolute().percentile(share); }

double Latencies::absolute_median() const {
  const std::int64_t all = total();
  const Latencies sorted = absolute();
  return 0.5 * (sorted.ranked((all + 1) / 2) + sorted.ranked(all / 2 + 1));
}

double Latencies::early_share() const {
  const auto on_time = events.begin() - first_ms;
  return ratio(std::accumulate(events.begin(), on_time, std::int64_t{0}), total());
}

FlightCounts& FlightCounts::operator+=(const FlightCounts& other) {
  truth += other.truth;
  predicted += other.predicted;
  matched += other.matched;
  return *this;
}

void LoadScore::add(double normal_force, const WheelLoad& load) {
  ++steps;
  const double error = std::abs(load.force - normal_force);
  if (std::isnan(error)) return;
  ++errors[std::min(static_cast<std::size_t>(error / bin_width), count - 1)];
  covered += error <= 2.0 * load.deviation ? 1 : 0;
}

LoadScore& LoadScore::operator+=(const LoadScore& other) {
  for (std::size_t i = 0; i < count; ++i) errors[i] += other.errors[i];
  covered += other.covered;
  steps += other.steps;
  return *this;
}

double LoadScore::median_error() const {
  const std::int64_t all = known();
  std::int64_t passed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    passed += errors[i];
    if (all > 0 && 2 * passed >= all) return bin_width * (static_cast<double>(i) + 0.5);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

ExtendedScore& ExtendedScore::operator+=(const ExtendedScore& other) {
  away_from_events += other.away_from_events;
  loaded += other.loaded;
  takeoff += other.takeoff;
  landing += other.landing;
  flights += other.flights;
  load += other.load;
  extra_switches += other.extra_switches;
  log_loss += other.log_loss;
  steps += other.steps;
  return *this;
}

ExtendedScore extended_score(
    const std::array<ContactSequence, models::wheel_count>& truth,
    const std::array<std::vector<double>, models::wheel_count>& normal_force,
    const Prediction& prediction, std::int64_t period_us, const ScoringConfig& config) {
  constexpr double loaded_force = 10.0;  // N
  constexpr double least_probability = 1e-6;
  ExtendedScore result;
  const std::size_t first = first_scored_step(period_us, config);
  const double period = 1e-6 * static_cast<double>(period_us);
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    const ContactSequence& predicted = prediction[w].contact;
    const std::vector<bool> near = near_events(truth[w], period_us);
    for (std::size_t k = first; k < truth[w].size(); ++k) {
      const bool in_contact = truth[w][k] != 0;
      if (!near[k]) result.away_from_events.add(in_contact, predicted[k] != 0);
      if (!in_contact || normal_force[w][k] >= loaded_force)
        result.loaded.add(in_contact, predicted[k] != 0);
      const double p_contact = prediction[w].p_contact[k];
      result.log_loss -=
          std::log(std::clamp(in_contact ? p_contact : 1.0 - p_contact, least_probability, 1.0));
      result.steps += 1;
      if (!prediction[w].load.empty()) {
        result.load.add(normal_force[w][k], prediction[w].load[k]);
      }
    }
    for (const JudgedTransition& judged : judge_transitions(truth[w], predicted, period, config)) {
      if (judged.verdict != Judgement::detected) continue;
      const bool is_takeoff = judged.kind == EventKind::takeoff;
      (is_takeoff ? result.takeoff : result.landing).add(judged.latency * period_us);
    }
    result.extra_switches += extra_switches(truth[w], predicted, period, config);
    result.flights +=
        match_flights(truth[w], predicted, first,
                      static_cast<std::size_t>(std::llround(config.minimum_flight / period)));
  }
  return result;
}

}  // namespace touchdown::scoring
