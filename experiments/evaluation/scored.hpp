#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

/// A score that adds up, with all that it can be grouped by. The noise seeds of a run are added.
/// The plan must outlive it.
template <typename Score>
struct Scored {
  const PlannedRun* run = nullptr;  ///< engine, scene, robot, sensors, draw; null: none was scored
  std::size_t segment = 0;          ///< of the run: a drop
  const Condition* condition = nullptr;     ///< null: a score of the run itself
  const noise::NoiseCell* noise = nullptr;  ///< likewise
  std::size_t item = 0;  ///< place in a list that the score belongs to: a view, a bin
  Score score = {};
};

/// Whether the estimator was fitted on the engine of its test, with the experiment's own fit.
template <typename Score>
bool is_own(const Scored<Score>& row) {
  return row.condition->is_fitted_in_domain();
}

/// Rows by condition and noise setting, then in the order in which they are added.
template <typename Score>
class RowsBySetting {
 public:
  /// Adds a row, or its score to the row of the same run, segment and item.
  void add(std::size_t condition, std::size_t cell, const Scored<Score>& row) {
    std::vector<Scored<Score>>& rows = by_setting_[{condition, cell}];
    const auto same = std::find_if(rows.rbegin(), rows.rend(), [&](const Scored<Score>& other) {
      return other.run != row.run || (other.segment == row.segment && other.item == row.item);
    });
    if (same != rows.rend() && same->run == row.run) {
      same->score += row.score;
    } else {
      rows.push_back(row);
    }
  }
  bool has(std::size_t condition, std::size_t cell) const {
    return by_setting_.contains({condition, cell});
  }
  /// All rows, which leave the object.
  std::vector<Scored<Score>> take() {
    std::vector<Scored<Score>> all;
    for (auto& [setting, rows] : by_setting_) std::ranges::move(rows, std::back_inserter(all));
    by_setting_.clear();
    return all;
  }

 private:
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Scored<Score>>> by_setting_;
};

/// The scores of every experiment, by condition, noise setting, run, then segment. A condition
/// without a scored run has a row without a run at each noise setting.
struct ScoreRows {
  std::vector<Scored<scoring::Classification>> counted;  ///< both wheels added
  std::vector<Scored<scoring::RobotScore>> scored;
};

/// Those of runs of one group. The sums do not depend on which process computed the tasks, and
/// when. Errors: `Error` when a task is missing.
ScoreRows score_rows(std::span<const std::size_t> runs, const Plan& plan, const Store& store);

/// The rows of a measure in runs of one group: of the runs themselves, then by condition, noise
/// setting, run, and item. Runs that are not scored have none. Errors: `Error` when a task is
/// missing.
template <typename Score>
std::vector<Scored<Score>> rows_of(std::string_view measure, std::span<const std::size_t> runs,
                                   const Plan& plan, const Store& store) {
  RowsBySetting<Score> rows;
  for (const std::size_t index : runs) {
    const PlannedRun& run = plan.runs[index];
    const RunGroup& group = plan.groups[run.group];
    const std::vector<std::size_t> tested = group.tested_on(run.simulator);
    for (const Task& task : plan.tasks_of(index)) {
      const TaskCounts counts = counts_of(plan, task, store);
      for (const MeasuredBytes& found : counts.measured) {
        if (found.measure != measure) continue;
        Scored<Score> row{&run};
        std::size_t place = 0;
        if (found.condition != no_condition) {
          place = 1 + tested[found.condition];
          row.condition = &group.conditions[tested[found.condition]];
          row.noise = &group.scored[found.cell];
        }
        std::string_view bytes = found.bytes;
        for (Score& score : unpack<std::vector<Score>>(bytes)) {
          row.score = std::move(score);
          rows.add(place, found.cell, row);
          ++row.item;
        }
      }
    }
  }
  return rows.take();
}

/// The evaluated experiment, as its studies use it.
struct Evaluation {
  const RunRequest& request;
  const Plan& plan;
  const FinishedRuns& runs;  ///< the test runs, and those of their fits
  const Store& saved;        ///< the results of tasks and model tasks
  const ScoreRows& own;      ///< of the experiment's own test runs
  const FittedModels& models;
};

}  // namespace touchdown::experiments
