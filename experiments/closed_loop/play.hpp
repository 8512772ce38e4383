#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/closed_loop/outcome.hpp"
#include "experiments/closed_loop/plan.hpp"
#include "experiments/closed_loop/teller.hpp"
#include "experiments/estimators/fitted_model.hpp"
#include "experiments/play/play.hpp"
#include "scenarios/compiled_scenes.hpp"

namespace touchdown::experiments {

/// A run whose policy was told about contact.
struct LoopRun {
  scenarios::Scenario scenario;  ///< as it was played
  recordings::Recording recording;
  Told told;
};

/// Plays a cell's run: its perturbations are those of the test run of this index, whoever tells.
/// Errors: `InputError` for a scene that makes no sense.
LoopRun play_loop(const RunRequest& request, const LoopCell& cell, std::int64_t run,
                  const FittedModels& models, scenarios::CompiledScenes& scenes,
                  const GoingOn& going_on);

/// Where the outcomes of a closed loop's runs are saved, by their numbers.
class SavedLoops {
 public:
  /// `key` names the experiment and the build: nothing else is believed.
  SavedLoops(std::filesystem::path folder, std::string key);

  std::optional<LoopOutcome> read(std::size_t run) const;
  void write(std::size_t run, const LoopOutcome& outcome) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

/// Plays and saves, in parallel, those runs of the range that nobody has saved; a run that cannot
/// be simulated counts as one that fell. Errors: `InputError` for a scene that makes no sense;
/// `Error` for a run that is missing and not to be simulated; `Stopped`.
void close_loops(const RunRequest& request, const TaskRange& runs, const FittedModels& models,
                 const SavedLoops& saved, MissingRun missing, const GoingOn& going_on);

}  // namespace touchdown::experiments
