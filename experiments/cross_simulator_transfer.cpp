#include "experiments/cross_simulator_transfer.hpp"

#include <algorithm>

#include "experiments/always_contact.hpp"
#include "experiments/estimator_registry.hpp"

namespace touchdown {

namespace {

using Samples = std::vector<Classification>;

const Samples& samples_of(const std::vector<ConditionCounts>& counts, const Condition& wanted,
                          std::size_t cell) {
  const auto found =
      std::find_if(counts.begin(), counts.end(), [&](const ConditionCounts& candidate) {
        return candidate.condition.fit_simulator == wanted.fit_simulator &&
               candidate.condition.test_simulator == wanted.test_simulator &&
               candidate.condition.estimator == wanted.estimator;
      });
  return found->samples[cell];
}

/// The first's success minus the second's.
Interval difference(const Samples& first, const Samples& second, const BootstrapConfig& config) {
  std::vector<Paired<Classification>> pairs;
  for (std::size_t i = 0; i < first.size(); ++i) pairs.push_back({first[i], second[i]});
  return bootstrap<Paired<Classification>>(
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
                                const std::vector<NoiseCell>& cells,
                                const BootstrapConfig& config) {
  std::vector<Transfer> result;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const ConditionCounts& here : counts) {
      const Condition& condition = here.condition;
      const EstimatorEntry& entry = estimator_entry(condition.estimator);
      Condition own = condition;
      own.fit_simulator = own.test_simulator;
      Condition always = own;
      always.estimator = always_contact_name;
      const Samples& samples = here.samples[c];
      const std::vector<Interval> scores =
          bootstrap<Classification>(samples,
                                    {[](const Classification& sum) { return sum.success(); },
                                     [](const Classification& s) { return s.no_contact_recall(); }},
                                    config);
      result.push_back({condition, cells[c], entry.config.has_value() || entry.phase.has_value(),
                        scores[0], scores[1],
                        difference(samples_of(counts, own, c), samples, config),
                        difference(samples, samples_of(counts, always, c), config)});
    }
  }
  return result;
}

}  // namespace touchdown
