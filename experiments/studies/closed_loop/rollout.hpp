#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/closed_loop/metrics.hpp"
#include "experiments/studies/closed_loop/plan.hpp"
#include "experiments/studies/closed_loop/contact_source.hpp"
#include "experiments/estimators/fitted_model.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "scenarios/compiled_scenes.hpp"

namespace touchdown::experiments {

/// A run whose policy was told about contact.
struct ClosedLoopRun {
  scenarios::Scenario scenario;  ///< as it was played
  recordings::Recording recording;
  ContactTrace told;
};

/// Plays a cell's run: its perturbations are those of the test run of this index, whoever tells.
/// Errors: `InputError` for a scene that makes no sense.
ClosedLoopRun run_closed_loop(const RunRequest& request, const ClosedLoopCell& cell, std::int64_t run,
                  const FittedModels& models, scenarios::CompiledScenes& scenes,
                  const ShouldContinue& should_continue);

/// Where the outcomes of a closed loop's runs are saved, by their numbers.
class SavedClosedLoops {
 public:
  /// `key` names the experiment and the build: nothing else is believed.
  SavedClosedLoops(std::filesystem::path folder, std::string key);

  std::optional<ClosedLoopMetrics> read(std::size_t run) const;
  void write(std::size_t run, const ClosedLoopMetrics& outcome) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

/// Plays and saves, in parallel, those runs of the range that nobody has saved; a run that cannot
/// be simulated counts as one that fell. Errors: `InputError` for a scene that makes no sense;
/// `Error` for a run that is missing and not to be simulated; `Stopped`.
void run_closed_loops(const RunRequest& request, const TaskRange& runs, const FittedModels& models,
                 const SavedClosedLoops& saved, MissingRun missing, const ShouldContinue& should_continue);

}  // namespace touchdown::experiments
