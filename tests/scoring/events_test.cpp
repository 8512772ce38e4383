#include "scoring/events.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "scoring/score.hpp"

namespace touchdown::scoring {
namespace {

using Steps = std::vector<int>;

ContactSequence with_flights(const std::vector<std::pair<int, int>>& flights, int steps = 3000) {
  ContactSequence contact(static_cast<std::size_t>(steps), 1);
  for (const auto& [takeoff, landing] : flights) {
    std::fill(contact.begin() + takeoff, contact.begin() + landing, 0);
  }
  return contact;
}

EventScore score_of(const ContactSequence& truth, const ContactSequence& decided,
                    const ScoringConfig& config = {}) {
  return event_scores(truth, decided, {0}, 1000, config).front();
}

TEST(EventScore, OfTheTruthIsPerfect) {
  const ContactSequence truth = with_flights({{1000, 1200}, {1500, 1512}, {2980, 3000}});
  const EventScore score = score_of(truth, truth);
  EXPECT_EQ(score.truth, 5);
  EXPECT_EQ(score.f1(), 1.0);
  EXPECT_EQ(score.extra, 0);
  EXPECT_EQ(score.wrong_us, 0);
  EXPECT_EQ(score.takeoff.median(), 0.0);
}

TEST(EventScore, HasSignedLatenciesBeyondTheToleranceOfMatches) {
  const ContactSequence truth = with_flights({{1000, 1200}, {2000, 2200}});
  const EventScore score = score_of(truth, with_flights({{990, 1220}, {2040, 2150}}));
  EXPECT_EQ(score.matched, 2);  // 10 ms early, 20 ms late; 40 and 50 ms are too far
  EXPECT_EQ(score.f1(), 0.5);
  EXPECT_EQ(score.takeoff.median(), 15.0);   // of −10 and 40
  EXPECT_EQ(score.landing.median(), -15.0);  // of 20 and −50
}

TEST(EventScore, CountsFlickerAsExtraSwitchesWhichMissedFlightsDoNotOffset) {
  const ContactSequence truth = with_flights({{1000, 1200}, {2000, 2200}});
  EXPECT_EQ(score_of(truth, with_flights({{1000, 1100}, {1150, 1200}, {2000, 2200}})).extra, 2);
  EXPECT_EQ(score_of(truth, with_flights({{1000, 1100}, {1150, 1200}})).extra, 2);
  EXPECT_EQ(score_of(truth, with_flights({})).extra, 0);
}

TEST(EventScore, CountsTheTimeInWrongIntervalsOfMoreThanFiftyMilliseconds) {
  const ContactSequence truth = with_flights({{1000, 1200}});
  EXPECT_EQ(score_of(truth, with_flights({{1050, 1200}})).wrong_us, 0);
  EXPECT_EQ(score_of(truth, with_flights({{1051, 1200}})).wrong_us, 51'000);
  EXPECT_EQ(score_of(truth, with_flights({{1051, 1300}})).wrong_us, 151'000);
  // A late takeoff that joins an early flight of another place is one interval.
  EXPECT_EQ(score_of(truth, with_flights({{900, 1000}})).wrong_us, 300'000);
}

Steps switches(const ContactSequence& contact, int state, int first) {
  Steps steps;
  for (int k = std::max(first, 1); k < static_cast<int>(contact.size()); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (contact[i] == state && contact[i - 1] != state) steps.push_back(k);
  }
  return steps;
}

/// The closest free pair, again and again.
std::vector<std::pair<int, int>> naive_matches(Steps truth, Steps decided, int reach) {
  std::vector<std::pair<int, int>> pairs;
  while (true) {
    std::optional<std::pair<int, int>> best;
    for (const int event : truth) {
      for (const int one : decided) {
        const int distance = std::abs(event - one);
        if (distance > reach) continue;
        if (!best || distance < std::abs(best->first - best->second)) best = {event, one};
      }
    }
    if (!best) return pairs;
    pairs.push_back(*best);
    std::erase(truth, best->first);
    std::erase(decided, best->second);
  }
}

double naive_median(std::vector<int> values) {
  if (values.empty()) return NAN;
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// Decided switches of a kind that are not the first one in the window of a true event.
int naive_extra(const ContactSequence& truth, const ContactSequence& decided, int state,
                int first) {
  const int early = state == 0 ? 60 : 20;  // ms
  const Steps others = switches(truth, 1 - state, 1);
  Steps left = switches(decided, state, first);
  for (const int event : switches(truth, state, 1)) {
    int from = std::max(event - early, 0), to = event + 250;
    for (const int other : others) {
      if (other <= event) from = std::max(from, other);
      if (other > event) to = std::min(to, other - 1);
    }
    const auto found = std::ranges::find_if(left, [&](int k) { return k >= from && k <= to; });
    if (found != left.end()) left.erase(found);
  }
  return static_cast<int>(left.size());
}

ContactSequence random_contact(std::mt19937& random, const ContactSequence* near) {
  ContactSequence contact;
  std::uint8_t state = 1;
  while (contact.size() < 4000) {
    const std::size_t length = random() % 3 == 0 ? 1 + random() % 30 : 20 + random() % 300;
    contact.insert(contact.end(), length, state);
    state = state == 0 ? 1 : 0;
  }
  contact.resize(4000);
  if (near == nullptr) return contact;
  // Decisions: the truth, shifted by some milliseconds, with flicker.
  const std::size_t shift = random() % 40;
  for (std::size_t k = 0; k < contact.size(); ++k) {
    contact[k] = (*near)[k < shift ? 0 : k - shift];
    if (random() % 150 == 0) contact[k] = contact[k] == 0 ? 1 : 0;
  }
  return contact;
}

TEST(EventScore, EqualsANaiveCount) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const ContactSequence truth = random_contact(random, nullptr);
    const ContactSequence decided = random_contact(random, trial % 4 == 0 ? nullptr : &truth);
    const EventScore score = score_of(truth, decided);
    std::int64_t events = 0, found = 0, matched = 0, extra = 0;
    for (const int state : {0, 1}) {
      const Steps true_steps = switches(truth, state, 300);
      const Steps decided_steps = switches(decided, state, 300);
      events += std::ssize(true_steps);
      found += std::ssize(decided_steps);
      matched += std::ssize(naive_matches(true_steps, decided_steps, 20));
      extra += naive_extra(truth, decided, state, 300);
      std::vector<int> latencies;
      for (const auto& [event, one] : naive_matches(true_steps, decided_steps, 100)) {
        latencies.push_back(one - event);
      }
      const double median = (state == 0 ? score.takeoff : score.landing).median();
      ASSERT_EQ(std::isnan(median), latencies.empty());
      if (!latencies.empty()) {
        ASSERT_EQ(median, naive_median(latencies)) << trial;
      }
    }
    std::int64_t wrong_ms = 0;
    for (int k = 300, begin = 300; k <= 4000; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (k < 4000 && truth[i] != decided[i]) continue;
      if (k - begin > 50) wrong_ms += k - begin;
      begin = k + 1;
    }
    ASSERT_EQ(score.truth, events) << trial;
    ASSERT_EQ(score.decided, found) << trial;
    ASSERT_EQ(score.matched, matched) << trial;
    ASSERT_EQ(score.extra, extra) << trial;
    ASSERT_EQ(score.wrong_us, 1000 * wrong_ms) << trial;
    // The segments of a run add up to it.
    EventScore sum;
    for (const EventScore& part : event_scores(truth, decided, {0, 700, 1900, 2300}, 1000, {})) {
      sum += part;
    }
    ASSERT_EQ(sum, score) << trial;
  }
}

TEST(Latencies, MedianIsTheMeanOfTheMiddleTwo) {
  const auto median_of = [](const std::vector<int>& latencies_ms) {
    Latencies latencies;
    for (const int ms : latencies_ms) latencies.add(1000 * ms);
    return latencies.median();
  };
  EXPECT_EQ(median_of({7}), 7.0);
  EXPECT_EQ(median_of({2, 5}), 3.5);
  EXPECT_EQ(median_of({2, -5, 90}), 2.0);
  EXPECT_EQ(median_of({-100, -100, -99, 100}), -99.5);
  EXPECT_TRUE(std::isnan(median_of({})));
}

}  // namespace
}  // namespace touchdown::scoring
