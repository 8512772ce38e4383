#include "experiments/studies/cross_simulator/agreement.hpp"

#include <algorithm>
#include <cmath>

#include "scoring/histogram.hpp"

namespace touchdown::experiments {

namespace {

constexpr double impact_lasts = 0.1;  // s: window after a landing for its peak and its bounces
constexpr double edge_contact_lasts = 0.05;  // s: longer contacts are no edge contacts
constexpr double knee_range = 16.0;          // N·m
constexpr double wheel_range = 1.7;          // N·m
constexpr std::size_t knee_bins = 3200;      // of 0.01 N·m
constexpr std::size_t wheel_bins = 1700;     // of 0.002 N·m
constexpr std::size_t merged = 10;           // bins into one for the overlap: 0.1 and 0.02 N·m

struct QuantityName {
  const char* name;
  const char* unit;
};
constexpr std::array<QuantityName, quantity_count> quantity_names = {{
    {"flight duration", "ms"},
    {"peak landing acceleration", "m/s²"},
    {"touches after the nosing, per drop", ""},
    {"bounces, per drop", ""},
    {"contact ratio", ""},
    {"time to the bottom", "s"},
}};
constexpr std::array<const char*, torque_set_count> torque_names = {
    "knee, in contact", "knee, in flight", "wheel, in contact", "wheel, in flight"};

Mean& mean_of(RunFacts& facts, Quantity quantity) {
  return facts.quantity[static_cast<std::size_t>(quantity)];
}

/// Flights, edge contacts between them and landings, of the robot as a whole.
void add_drops(const RunSignals& run, const scoring::ScoringConfig& scoring, RunFacts& facts) {
  const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(std::llround(seconds / period));
  };
  std::vector<scoring::Flight> all = scoring::flights(scoring::any_wheel(run.contact));
  std::erase_if(all, [&](const scoring::Flight& flight) {
    return flight.takeoff < steps(scoring.skip) || flight.landing == run.steps();
  });
  const auto is_drop = [&](const scoring::Flight& flight) {
    return flight.landing - flight.takeoff >= steps(scoring.minimum_flight);
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_drop(all[i])) continue;
    mean_of(facts, Quantity::flight_duration)
        .add(1e3 * period * static_cast<double>(all[i].landing - all[i].takeoff));
    double peak = 0.0;
    const std::size_t end = std::min(run.steps(), all[i].landing + steps(impact_lasts));
    for (std::size_t k = all[i].landing; k < end; ++k) {
      peak = std::max(peak, std::abs(run.signals[k].vertical_acceleration));
    }
    mean_of(facts, Quantity::peak_acceleration).add(peak);
    const bool has_edge_contact = i > 0 && !is_drop(all[i - 1]) &&
                                  all[i].takeoff - all[i - 1].landing < steps(edge_contact_lasts);
    mean_of(facts, Quantity::edge_contacts).add(has_edge_contact ? 1.0 : 0.0);
    double bounces = 0.0;
    for (std::size_t j = i + 1; j < all.size() && all[j].takeoff < end; ++j) bounces += 1.0;
    mean_of(facts, Quantity::bounces).add(bounces);
  }
}

void add_torques(const RunSignals& run, const scoring::ScoringConfig& scoring, RunFacts& facts) {
  using enum TorqueSet;
  const auto set = [&](TorqueSet which) -> scoring::Histogram& {
    return facts.torque[static_cast<std::size_t>(which)];
  };
  set(knee_contact) = set(knee_flight) = scoring::Histogram(-knee_range, knee_range, knee_bins);
  set(wheel_contact) = set(wheel_flight) =
      scoring::Histogram(-wheel_range, wheel_range, wheel_bins);
  Mean& contact_ratio = mean_of(facts, Quantity::contact_ratio);
  for (std::size_t k = scoring::first_scored_step(run.info.control_period_us, scoring);
       k < run.steps(); ++k) {
    for (std::size_t side = 0; side < models::wheel_count; ++side) {
      const bool contact = run.contact[side][k] != 0;
      const double sign = side == 0 ? 1.0 : -1.0;  // the right leg's axes point the other way
      const LegSignals& leg = run.signals[k].leg[side];
      set(contact ? knee_contact : knee_flight).add(sign * leg.knee.torque);
      set(contact ? wheel_contact : wheel_flight).add(sign * leg.wheel.torque);
      contact_ratio.add(contact ? 1.0 : 0.0);
    }
  }
}

double within_engine(const std::vector<RunFacts>& runs, std::size_t set) {
  std::array<scoring::Histogram, 2> half;
  for (std::size_t i = 0; i < runs.size(); ++i) half[i % 2] += runs[i].torque[set];
  return scoring::wasserstein_distance(half[0], half[1]);
}

}  // namespace

RunFacts& RunFacts::operator+=(const RunFacts& other) {
  for (std::size_t i = 0; i < quantity_count; ++i) quantity[i] += other.quantity[i];
  for (std::size_t i = 0; i < torque_set_count; ++i) torque[i] += other.torque[i];
  return *this;
}

RunFacts facts_of(const Rollout& run, const Experiment& experiment) {
  RunFacts facts;
  add_drops(run.signals, experiment.scoring, facts);
  add_torques(run.signals, experiment.scoring, facts);
  if (run.report.outcome == recordings::Outcome::finished) {
    const scenarios::End& end = run.plan.scenario.end;
    mean_of(facts, Quantity::descent)
        .add(run.report.duration - (std::isfinite(end.x) ? end.settle : 0.0));
  }
  return facts;
}

Agreement agreement(const std::vector<RunFacts>& first, const std::vector<RunFacts>& second,
                    const scoring::BootstrapConfig& config) {
  using Both = scoring::Paired<RunFacts>;
  std::vector<std::function<double(const Both&)>> statistics;
  for (std::size_t q = 0; q < quantity_count; ++q) {
    statistics.emplace_back([q](const Both& both) { return both.first.quantity[q].value(); });
    statistics.emplace_back([q](const Both& both) { return both.second.quantity[q].value(); });
    statistics.emplace_back([q](const Both& both) {
      return both.second.quantity[q].value() - both.first.quantity[q].value();
    });
  }
  for (std::size_t t = 0; t < torque_set_count; ++t) {
    statistics.emplace_back([t](const Both& both) {
      return scoring::wasserstein_distance(both.first.torque[t], both.second.torque[t]);
    });
    statistics.emplace_back([t](const Both& both) {
      return scoring::overlap(both.first.torque[t].shares(merged),
                              both.second.torque[t].shares(merged));
    });
  }
  const std::vector<Interval> intervals =
      scoring::bootstrap<Both>(scoring::paired(first, second), statistics, config);

  Agreement result{first.size(), {}, {}};
  for (std::size_t q = 0; q < quantity_count; ++q) {
    result.quantities.push_back({quantity_names[q].name, quantity_names[q].unit, intervals[3 * q],
                                 intervals[3 * q + 1], intervals[3 * q + 2]});
  }
  for (std::size_t t = 0; t < torque_set_count; ++t) {
    const std::size_t at = 3 * quantity_count + 2 * t;
    result.torques.push_back({torque_names[t], intervals[at], intervals[at + 1],
                              std::max(within_engine(first, t), within_engine(second, t))});
  }
  return result;
}

}  // namespace touchdown::experiments
