#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/rows.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/evaluation/query.hpp"
#include "experiments/studies/cross_simulator.hpp"
#include "scoring/bootstrap.hpp"
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

constexpr std::array<QuantityName, quantity_count> quantity_names = {{
    {"flight_duration", "flight duration", "ms"},
    {"peak_acceleration", "peak landing acceleration", "m/s²"},
    {"edge_contacts", "touches after the nosing, per drop", ""},
    {"bounces", "bounces, per drop", ""},
    {"contact_ratio", "contact ratio", ""},
    {"descent", "time to the bottom", "s"},
}};

constexpr std::array<const char*, torque_set_count> torque_names = {
    "knee, in contact", "knee, in flight", "wheel, in contact", "wheel, in flight"};

Mean& mean_of(RunFacts& facts, Quantity quantity) {
  return facts.quantity[static_cast<std::size_t>(quantity)];
}

/// Flights, edge contacts between them and landings, of the robot as a whole.
void add_drops(const RunSignals& run, const scoring::ScoringConfig& scoring, RunFacts& facts) {
  const double period = run.period();
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

const QuantityName& name_of(std::size_t quantity) { return quantity_names[quantity]; }

RunFacts& RunFacts::operator+=(const RunFacts& other) {
  for (std::size_t i = 0; i < quantity_count; ++i) quantity[i] += other.quantity[i];
  for (std::size_t i = 0; i < torque_set_count; ++i) torque[i] += other.torque[i];
  return *this;
}

RunFacts facts_of(const RunSignals& run, const scoring::ScoringConfig& scoring) {
  RunFacts facts;
  add_drops(run, scoring, facts);
  add_torques(run, scoring, facts);
  return facts;
}

void add_descent(const FinishedRun& run, RunFacts& facts) {
  if (run.report.outcome != logs::Outcome::finished) return;
  const scenarios::End& end = run.plan.scenario.end;
  mean_of(facts, Quantity::descent)
      .add(run.report.duration - (std::isfinite(end.x) ? end.settle : 0.0));
}

static constexpr const char* facts_name = "facts";

Measure facts_measure() {
  return {.name = facts_name, .of_run = [](const MeasuredRun& run) {
            return run.seed > 0 ? std::string()
                                : pack(std::vector{facts_of(run.signals, run.scoring)});
          }};
}

RunFacts saved_facts(std::size_t run, const Evaluation& evaluation) {
  RunFacts facts =
      rows_of<RunFacts>(facts_name, {&run, 1}, evaluation.plan, evaluation.saved).front().score;
  add_descent(evaluation.runs.at(run), facts);
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
    result.quantities.push_back({quantity_names[q].title, quantity_names[q].unit, intervals[3 * q],
                                 intervals[3 * q + 1], intervals[3 * q + 2]});
  }
  for (std::size_t t = 0; t < torque_set_count; ++t) {
    const std::size_t at = 3 * quantity_count + 2 * t;
    result.torques.push_back({torque_names[t], intervals[at], intervals[at + 1],
                              std::max(within_engine(first, t), within_engine(second, t))});
  }
  return result;
}

std::vector<Condition> transfer_conditions(const Experiment& experiment) {
  std::vector<std::string> estimators = experiment.estimators;
  std::erase(estimators, always_contact_name);
  estimators.emplace_back(always_contact_name);
  std::vector<Condition> conditions;
  for (const std::string& estimator : estimators) {
    for (const std::string& fit : experiment.simulators) {
      for (const std::string& test : experiment.simulators) {
        conditions.push_back({fit, test, estimator});
      }
    }
  }
  return conditions;
}

namespace {

/// Losses and gains at every highlighted noise setting, in the order of `transfer_conditions`.
/// Loss: success rate of the same estimator fitted in the test engine, minus this one's. Gain: over
/// always contact. Both on the same runs.
Table transfers(const std::vector<Scored<scoring::Classification>>& counted,
                const Experiment& experiment) {
  using scoring::Classification;
  using Row = Scored<Classification>;
  const auto conditions = transfer_conditions(experiment);
  const auto place = [&](const Condition& condition) {
    return std::ranges::find(conditions, condition) - conditions.begin();
  };
  std::vector<Row> rows;
  for (const noise::NoiseCell& cell : experiment.highlights) {
    auto at_cell = where(counted, [&](const Row& row) {
      return *row.noise == cell && place(*row.condition) < std::ssize(conditions);
    });
    std::ranges::stable_sort(at_cell, {}, [&](const Row& row) { return place(*row.condition); });
    rows.insert(rows.end(), at_cell.begin(), at_cell.end());
  }
  const auto is_in = [](const Row& line, const Row& other, const std::string& estimator) {
    const std::string& engine = line.condition->test_simulator;
    return other.noise == line.noise && *other.condition == Condition{engine, engine, estimator};
  };
  Query<Classification> query;
  query.by.part([](const Row& row) { return *row.noise; }, noise_columns())
      .text("estimator", [](const Row& row) { return row.condition->estimator; })
      .text("fit_simulator", [](const Row& row) { return row.condition->fit_simulator; })
      .text("test_simulator", [](const Row& row) { return row.condition->test_simulator; })
      .as("simulator")
      .flag("is_fitted",
            [&](const Row& row) {
              return estimator_entry(experiment, row.condition->estimator).fits();
            })
      .is(ColumnRole::note);
  query.statistics = {{"success", &Classification::success},
                      {"no_contact_recall", &Classification::no_contact_recall}};
  query.differences = {
      {.name = "loss",
       .of = &Classification::success,
       .from = [&](const Row& line,
                   const Row& other) { return is_in(line, other, line.condition->estimator); },
       .is_reversed = true},
      {.name = "gain",
       .of = &Classification::success,
       .from = [&](const Row& line, const Row& other) {
         return is_in(line, other, std::string(always_contact_name));
       }}};
  return answer(rows, query, experiment.intervals.bootstrap).table;
}

std::string words_of(const Verdict& verdict, const Experiment& experiment) {
  const VerdictConfig& config = experiment.studies.at<CrossSimulatorConfig>().verdict;
  const EstimatorEntry& estimator = estimator_entry(experiment, verdict.estimator);
  const bool keeps = verdict.loss < config.largest_loss;
  const bool gains = verdict.gain > config.smallest_gain;
  const std::string interval =
      fmt::format("{:.0f} % interval", 100.0 * experiment.intervals.bootstrap.level);
  const std::string loss =
      estimator.fits()
          ? fmt::format(
                "fitted in the other engine it loses at most {:.4f} of success rate (upper end of "
                "the "
                "{}; {}, limit {})",
                verdict.loss, interval, keeps ? "passed" : "too much", config.largest_loss)
          : "it is not fitted, so it loses nothing";
  return fmt::format(
      "{} {}: {}, and its success rate is at least {:.4f} above always contact (lower end; {}, "
      "limit "
      "{}).",
      estimator.title, verdict.holds ? "holds" : "FAILS", loss, verdict.gain,
      gains ? "passed" : "too little", config.smallest_gain);
}

/// Greater or smaller of two; NaN if one is NaN, so that undefined values show.
double worse(double a, double b, bool greater_is_worse) {
  if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<double>::quiet_NaN();
  return greater_is_worse ? std::max(a, b) : std::min(a, b);
}

}  // namespace

std::vector<Verdict> verdicts(const Table& transfers, const Experiment& experiment) {
  const VerdictConfig& config = experiment.studies.at<CrossSimulatorConfig>().verdict;
  std::vector<Verdict> result;
  for (const TableRow& transfer : transfers.all()) {
    const std::string estimator = transfer.text("estimator");
    if (estimator == always_contact_name) continue;
    if (transfer.text("fit_simulator") == transfer.text("test_simulator")) continue;
    auto verdict = std::ranges::find(result, estimator, &Verdict::estimator);
    if (verdict == result.end()) {
      result.push_back({estimator, false, false, -std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::infinity(), ""});
      verdict = result.end() - 1;
    }
    verdict->loss = worse(verdict->loss, transfer.interval("loss").high, true);
    verdict->gain = worse(verdict->gain, transfer.interval("gain").low, false);
  }
  for (Verdict& verdict : result) {
    verdict.holds = verdict.loss < config.largest_loss && verdict.gain > config.smallest_gain;
    verdict.is_demanded = std::find(config.demanded.begin(), config.demanded.end(),
                                    verdict.estimator) != config.demanded.end();
    verdict.words = words_of(verdict, experiment);
  }
  return result;
}

std::vector<std::string> failed_demands(const std::vector<Verdict>& verdicts) {
  std::vector<std::string> names;
  for (const Verdict& verdict : verdicts) {
    if (verdict.is_demanded && !verdict.holds) names.push_back(verdict.estimator);
  }
  return names;
}

namespace {

/// The agreement over the runs that the robot completes in both engines.
Agreement agreement_of(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const auto first = evaluation.plan.runs_in(0, experiment.simulators[0]);
  const auto second = evaluation.plan.runs_in(0, experiment.simulators[1]);
  std::vector<RunFacts> first_facts;
  std::vector<RunFacts> second_facts;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (evaluation.runs.at(first[i]).failed() || evaluation.runs.at(second[i]).failed()) continue;
    first_facts.push_back(saved_facts(first[i], evaluation));
    second_facts.push_back(saved_facts(second[i], evaluation));
  }
  if (first_facts.empty()) {
    throw Error("there is no test run that the robot completes in both engines");
  }
  return agreement(first_facts, second_facts, experiment.intervals.bootstrap);
}

}  // namespace

CrossSimulatorResult check_across_simulators(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  CrossSimulatorResult result{experiment,
                              agreement_of(evaluation),
                              transfers(evaluation.own.counted, experiment),
                              {},
                              causes_of(evaluation)};
  result.verdicts = verdicts(result.transfers, experiment);
  return result;
}

}  // namespace touchdown::experiments
