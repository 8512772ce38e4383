#include "experiments/foreign/rows.hpp"

#include "experiments/foreign/saved_scores.hpp"

namespace touchdown::experiments {

namespace {

/// A plan in which one estimator alone is scored, at one noise setting.
Plan plan_for(const std::string& estimator, const noise::NoiseCell& cell,
              const Listened& listened) {
  Plan plan = listened.plan;
  for (const BenchmarkSetting& setting : benchmark_settings(listened.request, plan)) {
    RunGroup& group = plan.groups[setting.group];
    group.conditions.clear();
    for (const std::string& simulator : listened.request.experiment.simulators) {
      group.conditions.push_back({simulator, simulator, estimator, group.fit});
    }
    group.counted.clear();
    group.disturbed.clear();
    group.scored = {cell};
  }
  return plan;
}

void add_foreign_rows(const Listened& listened, const RunDirectory& directory,
                      std::vector<BenchmarkRow>& rows) {
  for (const ForeignScores& scores : saved_foreign(listened.request, directory)) {
    for (std::size_t cell = 0; cell < scores.by_cell.size(); ++cell) {
      RunRequest request = listened.request;
      request.experiment.highlights = {listened.request.experiment.highlights[cell]};
      Plan plan = plan_for(scores.name, request.experiment.highlights.front(), listened);
      std::map<std::string, TaskCounts> counts = scores.by_cell[cell];
      constexpr std::size_t nobody = std::size_t{0} - 1;
      for (const Task& task : plan.tasks) {
        const std::string name = task_name(plan, task);
        if (listened.runs.at(task.run).failed()) {
          counts.emplace(name, TaskCounts{});
        } else if (!counts.contains(name)) {
          plan.runs[task.run].group = nobody;
        }
      }
      const SavedCounts at_hand(std::move(counts));
      const Listened alone{request, plan, listened.runs, at_hand, listened.own};
      for (BenchmarkRow& row : benchmark(alone)) rows.push_back(std::move(row));
    }
  }
}

}  // namespace

BenchmarkResult write_benchmark(const Listened& listened, const RunDirectory& directory) {
  std::vector<BenchmarkRow> rows = benchmark(listened);
  add_foreign_rows(listened, directory, rows);
  const double level = listened.request.experiment.intervals.bootstrap.level;
  BenchmarkResult result = with_standings(std::move(rows), level);
  write_tables(result, level, directory);
  return result;
}

}  // namespace touchdown::experiments
