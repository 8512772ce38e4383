#include "experiments/results/label_sensitivity.hpp"

#include <tbb/parallel_for.h>

#include "experiments/fitting/make_estimator.hpp"
#include "experiments/plan/condition.hpp"

namespace touchdown::experiments {

namespace {

std::vector<scoring::LabelConfig> definitions() {
  std::vector<scoring::LabelConfig> all;
  for (const double threshold : {0.1, 1.0, 5.0, 10.0}) {
    for (const double debounce : {0.0, 0.002, 0.005, 0.01}) all.push_back({threshold, debounce});
  }
  return all;
}

using Truth = std::array<scoring::ContactSequence, models::wheel_count>;

Truth truth_of(const RunSignals& run, const scoring::LabelConfig& labels) {
  const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
  Truth truth;
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    truth[w] = scoring::contact_labels(run.normal_force[w], period, labels);
  }
  return truth;
}

/// By condition of the run's engine, then definition: both wheels added.
using RunCounts = std::vector<std::vector<scoring::Classification>>;

RunCounts counts_of(const Rollout& run, const std::vector<Condition>& conditions,
                    const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  std::vector<Truth> truths;
  for (const scoring::LabelConfig& labels : definitions()) {
    truths.push_back(truth_of(run.signals, labels));
  }
  const NoiseRun noise = noise_run(run.signals, noise_key(experiment, 0, run.signals.info.run));
  const std::int64_t period = run.signals.info.control_period_us;
  RunCounts counts;
  for (const Condition& condition : conditions) {
    EstimatorRunner runner = runner_of(experiment, condition, result.models, run.signals);
    const auto decisions =
        decide(runner, run.signals, noise, experiment.highlights.front().levels());
    counts.emplace_back();
    for (const auto& truth : truths) {
      scoring::Classification sum;
      for (std::size_t w = 0; w < models::wheel_count; ++w) {
        sum += scoring::classify(truth[w], decisions[w], {0}, period, experiment.scoring).front();
      }
      counts.back().push_back(sum);
    }
  }
  return counts;
}

}  // namespace

Table label_sensitivity_table(const ExperimentResult& result) {
  Table table{header_with_intervals({"simulator", "estimator", "force_threshold_n", "debounce_s"},
                                    {"success", "no_contact_precision", "no_contact_recall"}),
              {}};
  for (const std::string& simulator : result.experiment.simulators) {
    const std::vector<Condition> conditions =
        tested_on(own_engine_conditions(result.experiment), simulator);
    std::vector<const Rollout*> runs;
    for (const Rollout& run : result.runs) {
      if (run.plan.role == RunRole::test && run.plan.simulator == simulator && !run.failed()) {
        runs.push_back(&run);
      }
    }
    if (runs.empty()) continue;
    std::vector<RunCounts> counts(runs.size());
    tbb::parallel_for(std::size_t{0}, runs.size(),
                      [&](std::size_t i) { counts[i] = counts_of(*runs[i], conditions, result); });
    for (std::size_t c = 0; c < conditions.size(); ++c) {
      for (std::size_t d = 0; d < definitions().size(); ++d) {
        std::vector<scoring::Classification> samples;
        for (const RunCounts& run : counts) samples.push_back(run[c][d]);
        const std::vector<Interval> scores = scoring::bootstrap<scoring::Classification>(
            samples,
            {&scoring::Classification::success, &scoring::Classification::no_contact_precision,
             &scoring::Classification::no_contact_recall},
            result.experiment.intervals.bootstrap);
        const scoring::LabelConfig labels = definitions()[d];
        table.rows.push_back(
            row_with_intervals({simulator, conditions[c].estimator, exact(labels.force_threshold),
                                exact(labels.debounce)},
                               scores));
      }
    }
  }
  return table;
}

}  // namespace touchdown::experiments
