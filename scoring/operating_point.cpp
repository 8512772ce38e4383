#include "scoring/operating_point.hpp"

#include <cstdlib>

namespace touchdown::scoring {

ContactSequence decisions(const std::vector<double>& p_contact, double period,
                          const OperatingPoint& point) {
  ContactSequence decided;
  decided.reserve(p_contact.size());
  bool is_contact = true;
  ContactDecision decision;
  for (const double p : p_contact) {
    is_contact = decision.update(is_contact, p, period, point);
    decided.push_back(is_contact ? 1 : 0);
  }
  return decided;
}

OperatingScore& OperatingScore::operator+=(const OperatingScore& other) {
  points += other.points;
  extra_switches += other.extra_switches;
  false_takeoffs += other.false_takeoffs;
  flights += other.flights;
  found += other.found;
  takeoff_error_us += other.takeoff_error_us;
  scored_us += other.scored_us;
  return *this;
}

OperatingScore operating_score(const std::array<ContactSequence, models::wheel_count>& truth,
                               const std::array<ContactSequence, models::wheel_count>& decided,
                               std::int64_t period_us, const ScoringConfig& config) {
  const double period = 1e-6 * static_cast<double>(period_us);
  OperatingScore sum;
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    sum.points += classify(truth[w], decided[w], {0}, period_us, config).front();
    sum.extra_switches += extra_switches(truth[w], decided[w], period, config);
    for (const JudgedTransition& judged : judge_transitions(truth[w], decided[w], period, config)) {
      if (judged.kind != EventKind::takeoff) continue;
      const bool is_found = judged.verdict == Judgement::detected;
      const bool is_false = judged.verdict == Judgement::false_alarm;
      sum.false_takeoffs += is_false ? 1 : 0;
      sum.flights += is_false ? 0 : 1;
      sum.found += is_found ? 1 : 0;
      sum.takeoff_error_us += is_found ? std::abs(judged.latency) * period_us : 0;
    }
  }
  sum.scored_us = sum.points.points() * period_us;
  return sum;
}

}  // namespace touchdown::scoring
