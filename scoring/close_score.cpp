#include "scoring/close_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace touchdown::scoring {

namespace {

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

}  // namespace

CloseScore& CloseScore::operator+=(const CloseScore& other) {
  away_from_events += other.away_from_events;
  firm += other.firm;
  for (std::size_t i = 0; i < latencies; ++i) takeoff_ms[i] += other.takeoff_ms[i];
  return *this;
}

double CloseScore::takeoff_percentile(double share) const {
  const auto all = std::accumulate(takeoff_ms.begin(), takeoff_ms.end(), std::int64_t{0});
  const auto wanted = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(all)));
  std::int64_t passed = 0;
  for (std::size_t i = 0; i < latencies; ++i) {
    passed += takeoff_ms[i];
    if (all > 0 && passed >= wanted) return static_cast<double>(first_ms + static_cast<int>(i));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

CloseScore close_score(const std::array<ContactSequence, models::wheel_count>& truth,
                       const std::array<std::vector<double>, models::wheel_count>& normal_force,
                       const Prediction& prediction, std::int64_t period_us,
                       const ScoringConfig& config) {
  constexpr double light = 10.0;  // N
  CloseScore result;
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    const ContactSequence& predicted = prediction[w].contact;
    const std::vector<bool> near = near_events(truth[w], period_us);
    for (std::size_t k = first_scored_step(period_us, config); k < truth[w].size(); ++k) {
      const bool touches = truth[w][k] != 0;
      if (!near[k]) result.away_from_events.add(touches, predicted[k] != 0);
      if (!touches || normal_force[w][k] >= light) result.firm.add(touches, predicted[k] != 0);
    }
    const double period = 1e-6 * static_cast<double>(period_us);
    for (const JudgedTransition& judged : judge_transitions(truth[w], predicted, period, config)) {
      if (judged.kind != EventKind::takeoff || judged.verdict != Judgement::detected) continue;
      const std::int64_t bin = judged.latency * period_us / 1000 - CloseScore::first_ms;
      result.takeoff_ms[static_cast<std::size_t>(
          std::clamp<std::int64_t>(bin, 0, CloseScore::latencies - 1))] += 1;
    }
  }
  return result;
}

}  // namespace touchdown::scoring
