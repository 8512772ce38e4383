#include "experiments/cross_simulator/check.hpp"

#include "core/error.hpp"

namespace touchdown::experiments {

namespace {

/// The experiment's test runs of one engine.
std::vector<const PlayedRun*> test_runs(const Plan& plan, const PlayedRuns& runs,
                                        const std::string& simulator) {
  std::vector<const PlayedRun*> found;
  for (const std::size_t index : plan.runs_in(0)) {
    if (plan.runs[index].simulator == simulator) found.push_back(&runs.at(index));
  }
  return found;
}

/// Of the runs that the robot gets through in both engines.
Agreement agreement_of(const Experiment& experiment, const Plan& plan, const PlayedRuns& runs) {
  const auto first = test_runs(plan, runs, experiment.simulators[0]);
  const auto second = test_runs(plan, runs, experiment.simulators[1]);
  std::vector<RunFacts> first_facts;
  std::vector<RunFacts> second_facts;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i]->failed() || second[i]->failed()) continue;
    first_facts.push_back(facts_of(*first[i], experiment));
    second_facts.push_back(facts_of(*second[i], experiment));
  }
  if (first_facts.empty()) {
    throw Error("there is no test run that the robot gets through in both engines");
  }
  return agreement(first_facts, second_facts, experiment.intervals.bootstrap);
}

}  // namespace

CrossSimulatorResult check_across_simulators(const RunRequest& request, const Plan& plan,
                                             const PlayedRuns& runs, const CollectedCounts& counts,
                                             const SavedCounts& saved) {
  const Experiment& experiment = request.experiment;
  CrossSimulatorResult result{experiment, agreement_of(experiment, plan, runs), {}, {}, {}};
  result.transfers = transfers(counts.counted, plan.groups.front().counted, experiment);
  for (const Variation& variation : variations(request)) {
    const auto rows = sensitivity(variation, request, plan, runs, saved);
    result.sensitivities.insert(result.sensitivities.end(), rows.begin(), rows.end());
  }
  result.verdicts = verdicts(result.transfers, experiment.cross_simulator->verdict,
                             experiment.intervals.bootstrap.level);
  return result;
}

}  // namespace touchdown::experiments
