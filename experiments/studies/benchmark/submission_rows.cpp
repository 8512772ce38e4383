#include "experiments/studies/benchmark/submission_rows.hpp"

#include <set>

#include "experiments/studies/benchmark/submission_scores.hpp"

namespace touchdown::experiments {

namespace {

/// A plan that scores one estimator alone, at one noise setting.
Plan plan_for(const std::string& estimator, const noise::NoiseCell& cell,
              const Evaluation& evaluation) {
  Plan plan = evaluation.plan;
  for (const BenchmarkSetup& setup : benchmark_setups(evaluation.request, plan)) {
    RunGroup& group = plan.groups[setup.group];
    group.conditions.clear();
    for (const std::string& simulator : evaluation.request.experiment.simulators) {
      group.conditions.push_back({simulator, simulator, estimator, group.fit});
    }
    group.counted.clear();
    group.scored = {cell};
  }
  return plan;
}

void add_submission_rows(const Evaluation& evaluation, const RunDirectory& directory,
                         std::vector<BenchmarkRow>& rows) {
  for (const SubmissionScores& scores : saved_submissions(directory.store())) {
    for (std::size_t cell = 0; cell < scores.by_cell.size(); ++cell) {
      RunRequest request = evaluation.request;
      request.experiment.highlights = {evaluation.request.experiment.highlights[cell]};
      Plan plan = plan_for(scores.name, request.experiment.highlights.front(), evaluation);
      std::map<std::string, TaskCounts> counts = scores.by_cell[cell];
      std::set<std::size_t> incomplete;
      for (const Task& task : plan.tasks) {
        const std::string name = task_name(plan, task);
        if (evaluation.runs.at(task.run).failed()) {
          counts.emplace(name, TaskCounts{});
        } else if (!counts.contains(name)) {
          incomplete.insert(task.run);
        }
      }
      constexpr std::size_t no_group = std::size_t{0} - 1;
      for (const std::size_t run : incomplete) plan.runs[run].group = no_group;
      const Store in_memory;
      for (const auto& [name, found] : counts) in_memory.put(task_parts, name, found);
      const Evaluation alone{request,   plan,           evaluation.runs,
                             in_memory, evaluation.own, evaluation.models};
      for (BenchmarkRow& row : benchmark(alone)) rows.push_back(std::move(row));
    }
  }
}

}  // namespace

BenchmarkResult write_benchmark(const Evaluation& evaluation, const RunDirectory& directory) {
  std::vector<BenchmarkRow> rows = benchmark(evaluation);
  add_submission_rows(evaluation, directory, rows);
  const scoring::BootstrapConfig& intervals = evaluation.request.experiment.intervals.bootstrap;
  BenchmarkResult result = with_standings(std::move(rows), intervals);
  write_tables(result, evaluation.request.experiment, directory);
  return result;
}

}  // namespace touchdown::experiments
