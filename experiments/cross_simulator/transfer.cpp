#include "experiments/cross_simulator/transfer.hpp"

#include <algorithm>

#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

namespace {

using Samples = std::vector<scoring::Classification>;

const Samples& samples_of(const std::vector<ConditionCounts>& counts, const Condition& wanted,
                          std::size_t cell) {
  const auto found =
      std::find_if(counts.begin(), counts.end(),
                   [&](const ConditionCounts& candidate) { return candidate.condition == wanted; });
  return found->samples[cell];
}

/// The first's success minus the second's.
Interval difference(const Samples& first, const Samples& second,
                    const scoring::BootstrapConfig& config) {
  std::vector<scoring::Paired<scoring::Classification>> pairs;
  for (std::size_t i = 0; i < first.size(); ++i) pairs.push_back({first[i], second[i]});
  return scoring::bootstrap<scoring::Paired<scoring::Classification>>(
             pairs, {[](const auto& pair) { return pair.first.success() - pair.second.success(); }},
             config)
      .front();
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
  std::vector<Transfer> result;
  for (const noise::NoiseCell& cell : experiment.highlights) {
    const std::size_t c = noise::cell_index(cells, cell);
    for (const Condition& condition : transfer_conditions(experiment)) {
      Condition own = condition;
      own.fit_simulator = own.test_simulator;
      Condition always = own;
      always.estimator = always_contact_name;
      const Samples& samples = samples_of(counts, condition, c);
      const std::vector<Interval> scores = scoring::bootstrap<scoring::Classification>(
          samples,
          {[](const scoring::Classification& sum) { return sum.success(); },
           [](const scoring::Classification& s) { return s.no_contact_recall(); }},
          config);
      result.push_back({condition, cell, estimator_entry(condition.estimator).fits().has_value(),
                        scores[0], scores[1],
                        difference(samples_of(counts, own, c), samples, config),
                        difference(samples, samples_of(counts, always, c), config)});
    }
  }
  return result;
}

}  // namespace touchdown::experiments
