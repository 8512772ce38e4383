#include "experiments/studies/cross_simulator/check.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace touchdown::experiments {

namespace {

/// The experiment's test runs of one engine.
std::vector<const Rollout*> test_runs(const Evaluation& evaluation, const std::string& simulator) {
  std::vector<const Rollout*> found;
  for (const std::size_t index : evaluation.plan.runs_in(0)) {
    const Rollout& run = evaluation.runs.at(index);
    if (run.plan.simulator == simulator) found.push_back(&run);
  }
  return found;
}

/// The agreement over the runs that the robot completes in both engines.
Agreement agreement_of(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const auto first = test_runs(evaluation, experiment.simulators[0]);
  const auto second = test_runs(evaluation, experiment.simulators[1]);
  std::vector<RunFacts> first_facts;
  std::vector<RunFacts> second_facts;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i]->failed() || second[i]->failed()) continue;
    first_facts.push_back(facts_of(*first[i], experiment));
    second_facts.push_back(facts_of(*second[i], experiment));
  }
  if (first_facts.empty()) {
    throw Error("there is no test run that the robot completes in both engines");
  }
  return agreement(first_facts, second_facts, experiment.intervals.bootstrap);
}

/// Adds a row per in-domain estimator, at the experiment's first highlighted noise setting.
void add_sensitivity(const Variation& variation, const Evaluation& evaluation,
                     std::vector<Sensitivity>& all) {
  const Experiment& experiment = evaluation.request.experiment;
  const std::vector<std::size_t> varied = runs_of(variation, evaluation.request, evaluation.plan);
  const auto failed =
      static_cast<std::size_t>(std::count_if(varied.begin(), varied.end(), [&](std::size_t run) {
        return evaluation.runs.at(run).failed();
      }));
  const CollectedCounts counts = collect(evaluation.plan, varied, evaluation.saved);
  const RunGroup& group = evaluation.plan.groups[evaluation.plan.runs[varied.front()].group];
  const std::size_t cell = noise::cell_index(group.counted, experiment.highlights.front());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ConditionCounts& count : own(counts.counted)) {
    if (count.condition.test_simulator != variation.simulator) continue;
    Sensitivity row{
        variation, count.condition.estimator, varied.size() - failed, failed, {nan, nan, nan}};
    if (row.runs > 0) {
      row.success = scoring::bootstrap<scoring::Classification>(count.samples[cell],
                                                                {&scoring::Classification::success},
                                                                experiment.intervals.bootstrap)
                        .front();
    }
    all.push_back(std::move(row));
  }
}

}  // namespace

CrossSimulatorResult check_across_simulators(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  CrossSimulatorResult result{experiment, agreement_of(evaluation), {}, {}, {}};
  result.transfers =
      transfers(evaluation.own.counted, evaluation.plan.groups.front().counted, experiment);
  for (const Variation& variation : variations(evaluation.request)) {
    add_sensitivity(variation, evaluation, result.sensitivities);
  }
  result.verdicts = verdicts(result.transfers, experiment);
  return result;
}

}  // namespace touchdown::experiments
