#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/estimators/fitted_model.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "experiments/studies/closed_loop/contact_source.hpp"
#include "experiments/studies/closed_loop/metrics.hpp"
#include "experiments/studies/closed_loop/plan.hpp"
#include "scenarios/compiled_scenes.hpp"

namespace touchdown::experiments {

/// A closed-loop run.
struct ClosedLoopRun {
  scenarios::Scenario scenario;  ///< as simulated
  recordings::Recording recording;
  ContactTrace trace;  ///< before the policy's delay
};

/// Simulates a run of a cell. Its perturbations are those of the test run with this index, for
/// every contact source. Errors: `InputError` for an invalid scene.
ClosedLoopRun run_closed_loop(const RunRequest& request, const ClosedLoopCell& cell,
                              std::int64_t run, const FittedModels& models,
                              scenarios::CompiledScenes& scenes,
                              const ShouldContinue& should_continue);

/// The saved metrics of closed-loop runs, by run number.
class SavedClosedLoops {
 public:
  /// `key` names the experiment and the build; files with other keys are ignored.
  SavedClosedLoops(std::filesystem::path folder, std::string key);

  std::optional<ClosedLoopMetrics> read(std::size_t run) const;
  void write(std::size_t run, const ClosedLoopMetrics& metrics) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

/// Simulates and saves, in parallel, the runs of the range that are not saved yet. A run that
/// cannot be simulated counts as a fall. Errors: `InputError` for an invalid scene; `Error` for a
/// missing run with `MissingRun::refuse`; `Stopped`.
void run_closed_loops(const RunRequest& request, const TaskRange& runs, const FittedModels& models,
                      const SavedClosedLoops& saved, MissingRun missing,
                      const ShouldContinue& should_continue);

}  // namespace touchdown::experiments
