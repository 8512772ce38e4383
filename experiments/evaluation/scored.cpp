#include "experiments/evaluation/scored.hpp"

namespace touchdown::experiments {

namespace {

/// Adds what a task found under the conditions of a group that `has` and are tested on the run's
/// engine: by condition, noise setting, then segment.
template <typename Score, typename Has>
void add_found(const std::vector<Score>& found, const PlannedRun& run, const RunGroup& group,
               const std::vector<noise::NoiseCell>& cells, const Has& has,
               RowsBySetting<Score>& rows) {
  std::vector<std::size_t> conditions = group.tested_on(run.simulator);
  std::erase_if(conditions, [&](std::size_t c) { return !has(group.conditions[c]); });
  const std::size_t settings = conditions.size() * cells.size();
  const std::size_t segments = settings == 0 ? 0 : found.size() / settings;
  auto next = found.begin();
  for (const std::size_t c : conditions) {
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      for (std::size_t segment = 0; segment < segments; ++segment, ++next) {
        rows.add(c, cell, {&run, segment, &group.conditions[c], &cells[cell], 0, *next});
      }
    }
  }
}

template <typename Score, typename Has>
std::vector<Scored<Score>> with_unscored(const RunGroup& group,
                                         const std::vector<noise::NoiseCell>& cells, const Has& has,
                                         RowsBySetting<Score> rows) {
  for (std::size_t c = 0; c < group.conditions.size(); ++c) {
    for (std::size_t cell = 0; has(group.conditions[c]) && cell < cells.size(); ++cell) {
      if (rows.has(c, cell)) continue;
      rows.add(c, cell, {.condition = &group.conditions[c], .noise = &cells[cell]});
    }
  }
  return rows.take();
}

}  // namespace

ScoreRows score_rows(std::span<const std::size_t> runs, const Plan& plan, const Store& store) {
  if (runs.empty()) return {};
  const RunGroup& group = plan.groups[plan.runs[runs.front()].group];
  const auto counts = [&](const Condition& one) { return group.counts(one); };
  const auto predicts = [&](const Condition& one) { return group.predicts(one); };
  RowsBySetting<scoring::Classification> counted;
  RowsBySetting<scoring::RobotScore> scored;
  for (const std::size_t run : runs) {
    for (const Task& task : plan.tasks_of(run)) {
      const TaskCounts found = counts_of(plan, task, store);
      add_found(found.counted, plan.runs[run], group, group.counted, counts, counted);
      add_found(found.scored, plan.runs[run], group, group.scored, predicts, scored);
    }
  }
  return {with_unscored(group, group.counted, counts, std::move(counted)),
          with_unscored(group, group.scored, predicts, std::move(scored))};
}

}  // namespace touchdown::experiments
