#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "experiments/listening.hpp"
#include "experiments/run_experiment.hpp"
#include "experiments/run_request.hpp"

namespace touchdown {

/// An experiment on its way through simulating, fitting and listening to a result: what
/// `run_experiment`, `run_shard` and `merge_run` have in common. While it lives, it limits the
/// number of threads to what the experiment asks for.
class Execution {
 public:
  Execution(RunRequest request, RunDirectory directory, const RunOptions& options);

  const RunDirectory& directory() const { return directory_; }
  const std::vector<ListeningTask>& tasks() const { return tasks_; }
  const std::vector<PlayedRun>& runs() const { return runs_; }

  /// Everything that the tasks from `begin` to `end` need and that is not there yet. Returns how
  /// many tasks it computed. Errors: `Stopped`, saying what is saved.
  std::size_t compute(std::size_t begin, std::size_t end);

  /// Tasks that nobody has finished, by their indices.
  std::vector<std::size_t> missing_tasks() const;

  /// The result and its files, from what is there; simulates nothing and listens to nothing. Once.
  /// Errors: `Error` when something is missing or no run can be scored.
  ExperimentResult assemble(const std::string& command);

 private:
  bool going_on() const { return stop_ == nullptr || !*stop_; }
  void simulate(std::size_t begin, std::size_t end, MissingRun missing);
  void fit();
  std::size_t listen_to(std::size_t begin, std::size_t end);
  bool listen_to(const ListeningTask& task);
  std::string what_is_saved() const;

  RunRequest request_;
  RunDirectory directory_;
  const std::atomic<bool>* stop_;
  int threads_;
  tbb::global_control limit_;
  std::vector<NoiseCell> cells_;
  std::vector<PlannedRun> plan_;
  std::vector<ListeningTask> tasks_;
  SavedListening saved_;
  Provenance provenance_;
  std::vector<PlayedRun> runs_;
  std::vector<std::optional<std::size_t>> run_of_;  ///< by plan, where in `runs_`
  FittedModels models_;
};

}  // namespace touchdown
