#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/plan/plan.hpp"
#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// The saved results of a plan's model tasks, by name and item.
class SavedModelTasks {
 public:
  /// `folder` is the run directory's `state`; `key` identifies the experiment and the build. Files
  /// with another key are ignored.
  SavedModelTasks(std::filesystem::path folder, std::string key);

  std::optional<std::string> read(const ModelTasks& tasks, std::size_t item) const;
  void write(const ModelTasks& tasks, std::size_t item, const std::string& bytes) const;
  /// The file of an item.
  std::filesystem::path file(const ModelTasks& tasks, std::size_t item) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

/// The share of some model tasks that belongs to a share of the plan's tasks.
TaskRange share_of(const ModelTasks& model_tasks, const TaskRange& tasks, std::size_t all_tasks);

/// Whether that share holds any work.
bool has_model_tasks(const Plan& plan, const TaskRange& tasks);

/// Computes and saves, in parallel, the items of this share that are not saved yet. Errors: `Error`
/// for an item that is missing and must not be computed; `Stopped`; those of the tasks.
void run_model_tasks(const Plan& plan, const TaskRange& tasks, const FittedModels& models,
                     const SavedModelTasks& saved, MissingRun missing,
                     const ShouldContinue& should_continue);

/// Whether an item of this share is not saved.
bool lacks_model_tasks(const Plan& plan, const TaskRange& tasks, const SavedModelTasks& saved);

}  // namespace touchdown::experiments
