#include "experiments/studies/cross_simulator/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiments/config/experiment_estimators.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/studies/cross_simulator/config.hpp"

namespace touchdown::experiments {

namespace {

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
                "fitted in the other engine it loses at most {:.4f} of accuracy (upper end of the "
                "{}; {}, limit {})",
                verdict.loss, interval, keeps ? "passed" : "too much", config.largest_loss)
          : "it is not fitted, so it loses nothing";
  return fmt::format(
      "{} {}: {}, and its accuracy is at least {:.4f} above always contact (lower end; {}, limit "
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

std::vector<Transfer> transfers(const std::vector<ConditionCounts>& counts,
                                const std::vector<noise::NoiseCell>& cells,
                                const Experiment& experiment) {
  const scoring::BootstrapConfig& config = experiment.intervals.bootstrap;
  const auto success = [](const scoring::Classification& sum) { return sum.success(); };
  const auto difference = [&](const std::vector<scoring::Classification>& first,
                              const std::vector<scoring::Classification>& second) {
    return scoring::bootstrap_differences(first, second, {success}, config).front();
  };
  std::vector<Transfer> result;
  for (const noise::NoiseCell& cell : experiment.highlights) {
    const std::size_t c = noise::cell_index(cells, cell);
    for (const Condition& condition : transfer_conditions(experiment)) {
      Condition own = condition;
      own.fit_simulator = own.test_simulator;
      Condition always = own;
      always.estimator = always_contact_name;
      const std::vector<scoring::Classification>& samples = samples_of(counts, condition, c);
      const std::vector<Interval> scores = scoring::bootstrap<scoring::Classification>(
          samples, {success, &scoring::Classification::no_contact_recall}, config);
      result.push_back({condition, cell, estimator_entry(experiment, condition.estimator).fits(),
                        scores[0], scores[1], difference(samples_of(counts, own, c), samples),
                        difference(samples, samples_of(counts, always, c))});
    }
  }
  return result;
}

std::vector<Verdict> verdicts(const std::vector<Transfer>& transfers,
                              const Experiment& experiment) {
  const VerdictConfig& config = experiment.studies.at<CrossSimulatorConfig>().verdict;
  std::vector<Verdict> result;
  for (const Transfer& transfer : transfers) {
    const Condition& condition = transfer.condition;
    if (condition.estimator == always_contact_name) continue;
    if (condition.fit_simulator == condition.test_simulator) continue;
    auto verdict = std::find_if(result.begin(), result.end(), [&](const Verdict& v) {
      return v.estimator == condition.estimator;
    });
    if (verdict == result.end()) {
      result.push_back({condition.estimator, false, false, -std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::infinity(), ""});
      verdict = result.end() - 1;
    }
    verdict->loss = worse(verdict->loss, transfer.loss.high, true);
    verdict->gain = worse(verdict->gain, transfer.gain.low, false);
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

}  // namespace touchdown::experiments
