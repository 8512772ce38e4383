#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/run_plan.hpp"
#include "experiments/sweep.hpp"
#include "experiments/sweep_run.hpp"

namespace touchdown {

/// The unit in which an experiment's listening is computed, saved and spread over machines: all its
/// estimators hear one test run through one noise realisation, in every noise cell.
struct ListeningTask {
  std::size_t run = 0;  ///< index in the plan
  int seed = 0;         ///< of the noise
};

/// What a task found out; empty for a run that is not scored.
struct Heard {
  std::vector<Classification> cells;   ///< by condition of the run's engine, cell, piece of the run
  std::vector<RobotScore> highlights;  ///< by highlighted cell, condition, piece
};

/// Every task of the experiment: by test run, in the order of the plan, then seed.
std::vector<ListeningTask> listening_tasks(const Experiment& experiment,
                                           const std::vector<PlannedRun>& plan);

/// Where an experiment's tasks are saved.
class SavedListening {
 public:
  /// `key` names the experiment and the build: nothing else is believed.
  SavedListening(std::filesystem::path folder, std::string key);

  /// The name of a task's file.
  static std::string name(const PlannedRun& run, int seed);

  std::optional<Heard> read(const std::string& name) const;
  void write(const std::string& name, const Heard& heard) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

/// Computes one task. Errors: `Stopped`.
Heard listen(const Experiment& experiment, const std::vector<NoiseCell>& cells, const HeardRun& run,
             int seed, const FittedModels& models, const GoingOn& going_on);

/// All tasks' findings, added up in the order of the tasks: whoever computed them, and in which
/// order, the sums are the same.
struct CollectedListening {
  std::vector<ConditionCounts> counts;
  std::vector<std::vector<ConditionScores>> highlights;  ///< by highlighted cell
};
CollectedListening collect(const Experiment& experiment, const std::vector<NoiseCell>& cells,
                           const std::vector<PlannedRun>& plan,
                           const std::vector<ListeningTask>& tasks, const SavedListening& saved);

}  // namespace touchdown
