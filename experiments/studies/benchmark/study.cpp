#include "experiments/studies/benchmark/study.hpp"

#include "experiments/studies/benchmark/overlap.hpp"
#include "experiments/studies/benchmark/submission_rows.hpp"

namespace touchdown::experiments {

bool BenchmarkStudy::is_requested(const Experiment& experiment) const {
  return experiment.benchmark.has_value();
}

void BenchmarkStudy::add_needs(const RunRequest& request, Needs& needs) const {
  // Each robot may run differently, and each combination of robot and sensors has fitted runs.
  const Experiment& experiment = request.experiment;
  const auto robots = 1.0 + static_cast<double>(experiment.benchmark->robots.size());
  const auto profiles = 1.0 + static_cast<double>(experiment.benchmark->sensors.size());
  const double others = robots * profiles - 1.0;
  const auto engines = static_cast<double>(experiment.simulators.size());
  for (const std::string& file : experiment.fit.scenarios) {
    add_runs(needs, scenario_of(request, file).scenario, others * engines * experiment.fit.runs,
             0.0);
  }
  needs.setups += others;
}

void BenchmarkStudy::plan(const RunRequest& request, Plan& plan) const {
  add_benchmark(request, plan);
}

StudyResult BenchmarkStudy::summarize(const Evaluation& evaluation,
                                      const RunDirectory& directory) const {
  const BenchmarkResult found = write_benchmark(evaluation, directory);
  write_overlap(evaluation.models, evaluation, directory);
  return {{benchmark_text(found, evaluation.request.experiment)}};
}

}  // namespace touchdown::experiments
