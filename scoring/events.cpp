#include "scoring/events.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <tuple>
#include <utility>

#include "scoring/transitions.hpp"

namespace touchdown::scoring {

namespace {

using Steps = std::vector<std::size_t>;

/// Where the sequence changes to `state`, from step `first` on.
Steps changes_to(std::uint8_t state, const ContactSequence& contact, std::size_t first) {
  Steps steps;
  for (std::size_t k = std::max(first, std::size_t{1}); k < contact.size(); ++k) {
    if (contact[k] != contact[k - 1] && contact[k] == state) steps.push_back(k);
  }
  return steps;
}

/// One-to-one pairs of a true and a decided event, at most `reach` steps apart, the nearest first.
std::vector<std::pair<std::size_t, std::size_t>> matches(const Steps& truth, const Steps& decided,
                                                         std::size_t reach) {
  std::vector<std::tuple<std::size_t, std::size_t, std::size_t>> candidates;
  for (const std::size_t event : truth) {
    const auto from = event - std::min(event, reach);
    for (auto one = std::ranges::lower_bound(decided, from);
         one != decided.end() && *one <= event + reach; ++one) {
      candidates.emplace_back(*one > event ? *one - event : event - *one, event, *one);
    }
  }
  std::ranges::sort(candidates);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<bool> is_taken(candidates.empty() ? 0 : truth.back() + reach + 1);
  std::vector<bool> is_matched(is_taken.size());
  for (const auto& [distance, event, one] : candidates) {
    if (is_matched[event] || is_taken[one]) continue;
    is_matched[event] = is_taken[one] = true;
    pairs.emplace_back(event, one);
  }
  return pairs;
}

}  // namespace

void Latencies::add(std::int64_t latency_us) {
  const auto ms = std::int64_t{std::llround(1e-3 * static_cast<double>(latency_us))};
  events[static_cast<std::size_t>(std::clamp(ms, -longest_ms, longest_ms) + longest_ms)] += 1;
}

Latencies& Latencies::operator+=(const Latencies& other) {
  for (std::size_t i = 0; i < bins; ++i) events[i] += other.events[i];
  return *this;
}

double Latencies::median() const {
  std::int64_t all = 0;
  for (const std::int32_t count : events) all += count;
  if (all == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto ranked = [&](std::int64_t rank) {  // counted from 1
    std::size_t bin = 0;
    for (std::int64_t passed = events[0]; passed < rank; passed += events[bin]) ++bin;
    return static_cast<double>(static_cast<std::int64_t>(bin) - longest_ms);
  };
  return 0.5 * (ranked((all + 1) / 2) + ranked(all / 2 + 1));
}

EventScore& EventScore::operator+=(const EventScore& other) {
  truth += other.truth;
  decided += other.decided;
  matched += other.matched;
  extra += other.extra;
  wrong_us += other.wrong_us;
  takeoff += other.takeoff;
  landing += other.landing;
  return *this;
}

std::vector<EventScore> event_scores(const ContactSequence& truth, const ContactSequence& decided,
                                     const std::vector<std::size_t>& segments,
                                     std::int64_t period_us, const ScoringConfig& config) {
  std::vector<EventScore> result(segments.size());
  const auto at = [&](std::size_t step) -> EventScore& {
    const auto after = std::ranges::upper_bound(segments, step);
    return result[static_cast<std::size_t>(after - segments.begin()) - 1];
  };
  const std::size_t first = first_scored_step(period_us, config);
  const auto steps = [period_us](std::int64_t us) {
    return static_cast<std::size_t>(us / period_us);
  };
  for (const std::uint8_t state : {std::uint8_t{0}, std::uint8_t{1}}) {
    const Steps true_steps = changes_to(state, truth, first);
    const Steps decided_steps = changes_to(state, decided, first);
    for (const std::size_t step : true_steps) at(step).truth += 1;
    for (const std::size_t step : decided_steps) at(step).decided += 1;
    for (const auto& [event, one] :
         matches(true_steps, decided_steps, steps(EventScore::tolerance_us))) {
      at(event).matched += 1;
    }
    for (const auto& [event, one] :
         matches(true_steps, decided_steps, steps(1000 * Latencies::longest_ms))) {
      EventScore& score = at(event);
      const auto late = static_cast<std::int64_t>(one) - static_cast<std::int64_t>(event);
      (state == 0 ? score.takeoff : score.landing).add(late * period_us);
    }
  }
  const double period = 1e-6 * static_cast<double>(period_us);
  for (const std::size_t step : extra_switches(truth, decided, period, config)) {
    at(step).extra += 1;
  }
  std::int64_t wrong = 0;  // steps of the wrong interval that ends before step k
  for (std::size_t k = first; k <= truth.size(); ++k) {
    if (k < truth.size() && truth[k] != decided[k]) {
      ++wrong;
      continue;
    }
    if (wrong * period_us > EventScore::long_error_us) {
      at(k - static_cast<std::size_t>(wrong)).wrong_us += wrong * period_us;
    }
    wrong = 0;
  }
  return result;
}

}  // namespace touchdown::scoring
