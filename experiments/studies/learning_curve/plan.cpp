#include "experiments/studies/learning_curve/plan.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/studies/learning_curve/config.hpp"

namespace touchdown::experiments {

namespace {

/// The segments are planned already if one of the estimators learns from them anyway.
void require_segments(const RunRequest& request, Plan& plan) {
  const bool are_planned = std::any_of(plan.runs.begin(), plan.runs.end(), [](const auto& run) {
    return run.role == RunRole::fit && run.group >= segment_group(0);
  });
  if (are_planned) return;
  const std::vector<TrainingSegments>& entries = request.experiment.training_segments;
  for (std::size_t entry = 0; entry < entries.size(); ++entry) {
    plan_segment_runs(request, {}, entry, 0, entries[entry].runs, plan);
  }
}

}  // namespace

std::string fit_of_size(int size) { return fmt::format("~set{}", size); }

void add_learning_curve(const RunRequest& request, Plan& plan) {
  const Experiment& experiment = request.experiment;
  const LearningCurveConfig& config = experiment.studies.at<LearningCurveConfig>();
  RunGroup group{std::string(learning_curve_name), {}, {}, experiment.highlights};
  group.scores_transfer = true;
  for (const Condition& own : own_engine_conditions(experiment)) {
    if (!estimator_entry(experiment, own.estimator).fits()) continue;
    for (const int size : config.sizes) {
      Condition condition = own;
      condition.fit = fit_of_size(size);
      for (condition.refit = 0; condition.refit < config.draws; ++condition.refit) {
        group.conditions.push_back(condition);
      }
    }
  }
  if (group.conditions.empty()) {
    throw InputError("learning_curve: expected an estimator that is fitted among the experiment's");
  }
  for (const int size : config.sizes) {
    plan.training_sets[fit_of_size(size)] = static_cast<std::size_t>(size);
    plan.refits[fit_of_size(size)] = config.draws - 1;
  }
  require_segments(request, plan);
  const std::size_t first = plan.runs.size();
  plan_runs(request, RunRole::test, {}, plan.groups.size(), plan);
  plan.groups.push_back(std::move(group));
  plan_tasks(experiment, first, plan);
}

}  // namespace touchdown::experiments
