#include "experiments/score_beliefs.hpp"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file_names.hpp"
#include "core/files.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/owner.hpp"
#include "experiments/studies/benchmark/submission_rows.hpp"
#include "experiments/studies/benchmark/submission_scores.hpp"
#include "experiments/studies/benchmark/tables.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "experiments/submissions/belief_folder.hpp"
#include "experiments/submissions/prediction.hpp"
#include "experiments/tables/results.hpp"
#include "recordings/log/beliefs.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;

std::string name_of(const BeliefRequest& wanted) {
  std::string name = wanted.name;
  if (name.empty()) {
    const fs::path path = absolute_path(wanted.beliefs).lexically_normal();
    name = (path.has_filename() ? path : path.parent_path()).stem().string();
  }
  if (!is_name_word(name)) {
    throw InputError(fmt::format("--name: '{}': {}", name, expected_name_word));
  }
  const std::vector<std::string> taken = estimator_names();
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) {
    throw InputError(fmt::format(
        "--name: '{}' is one of touchdown's own estimators: expected another name", name));
  }
  return name;
}

/// Every run with its outcome alone, from the saved parts: whether it can be scored.
Rollouts runs_as_saved(const ExperimentContext& context) {
  const Plan& plan = context.plan;
  Rollouts runs;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) runs[i].plan = plan.runs[i];
  for (const Task& task : plan.tasks) {
    const std::optional<TaskCounts> counts = context.saved.read(plan, task);
    if (!counts) {
      throw InputError(fmt::format("{}: is not finished: run the same experiment again first",
                                   context.directory.path().string()));
    }
    if (!counts->is_scored()) {
      runs.at(task.run).report.outcome = recordings::Outcome::fell;
    }
  }
  return runs;
}

/// The files to score: those of runs with a submitted file for every noise realisation of a noise
/// setting. The report names the missing files of the other runs that could be scored.
std::vector<BeliefFile> complete(const std::vector<BeliefFile>& files,
                                 const std::vector<ExportedRun>& exported, const Rollouts& runs,
                                 BeliefReport& report) {
  std::set<std::size_t> given;
  for (const BeliefFile& file : files) given.insert(file.run);
  std::set<std::pair<std::size_t, std::size_t>> incomplete;  // run, cell
  for (std::size_t i = 0; i < exported.size(); ++i) {
    if (!exported[i].task || given.contains(i) || runs.at(exported[i].run).failed()) continue;
    report.without.push_back(exported[i].name);
    incomplete.emplace(exported[i].run, exported[i].cell);
  }
  std::vector<BeliefFile> scored;
  std::set<std::pair<std::size_t, std::size_t>> complete_runs;
  for (const BeliefFile& file : files) {
    const ExportedRun& run = exported[file.run];
    if (runs.at(run.run).failed()) {
      ++report.about_failed;
    } else if (!incomplete.contains({run.run, run.cell})) {
      scored.push_back(file);
      complete_runs.emplace(run.run, run.cell);
    }
  }
  report.scored = complete_runs.size();
  return scored;
}

/// The scores of a submitted prediction, as those of the only condition in one noise setting.
TaskCounts scores_of(const RunSignals& run, const scoring::Prediction& prediction,
                     const Experiment& experiment) {
  const NoiseRun no_noise;
  const MeasuredRun measured{run, no_noise, 0, {{}}, experiment.scoring};
  const std::array measures = {extended_scores()};
  const Condition condition;
  TaskCounts counts;
  add_scores({measured, condition, 0, prediction}, measures, 0, counts);
  return counts;
}

SubmissionScores scores_of(const std::vector<BeliefFile>& files,
                           const std::vector<ExportedRun>& exported, ExperimentContext& context,
                           BeliefReport& report) {
  Plan& plan = context.plan;
  const Experiment& experiment = context.request.experiment;
  SubmissionScores scores{report.name, {}};
  scores.by_cell.resize(experiment.highlights.size());
  std::map<std::size_t, std::vector<const BeliefFile*>> by_run;
  std::set<std::size_t> needed;
  for (const BeliefFile& file : files) {
    PlannedRun& run = plan.runs[exported[file.run].run];
    run.kept = run.kept && is_recorded(run, context.directory);
    by_run[exported[file.run].run].push_back(&file);
    needed.insert(exported[file.run].run);
  }
  std::mutex mutex;
  for_each_rollout(
      experiment, plan, needed, context.directory, MissingRun::refuse, context.should_continue,
      [&](std::size_t index, const Rollout& run) {
        for (const BeliefFile* file : by_run.at(index)) {
          if (!context.should_continue()) throw Stopped();
          const ExportedRun& about = exported[file->run];
          const SubmittedPrediction submitted =
              prediction_of(recordings::read_beliefs(file->path), run.signals);
          const TaskCounts counts = scores_of(run.signals, submitted.prediction, experiment);
          const std::scoped_lock lock(mutex);
          scores.by_cell[about.cell].emplace(task_name(plan, plan.tasks[*about.task]), counts);
          report.missing_steps += submitted.without;
          report.files_with_missing += submitted.without > 0 ? 1 : 0;
        }
      });
  return scores;
}

BeliefReport scored(const BeliefRequest& wanted, ExperimentContext& context) {
  BeliefReport report;
  report.name = name_of(wanted);
  const std::vector<ExportedRun> exported = exported_runs(context.request, context.plan);
  const Rollouts runs = runs_as_saved(context);
  const Submission submission = submission_in(wanted.beliefs, exported);
  require_sound(submission.files, context.should_continue);
  report.about_fitted = submission.about_fitted;
  const std::vector<BeliefFile> files = complete(submission.files, exported, runs, report);
  if (files.empty()) {
    throw InputError(fmt::format(
        "{}: holds no beliefs about all noise seeds of a run that stayed upright: {} of its files "
        "are missing, such as {}.csv",
        wanted.beliefs.string(), report.without.size(),
        report.without.empty() ? exported.back().name : report.without.front()));
  }
  const SubmissionScores scores = scores_of(files, exported, context, report);
  if (!context.should_continue()) throw Stopped();
  save(scores, context.request, context.directory);
  const Plan& plan = context.plan;
  const CollectedCounts own = collect(plan, plan.runs_in(0), context.saved);
  const FittedModels no_models;
  const Evaluation evaluation{context.request,          plan, runs, context.saved, own, no_models,
                              context.saved_model_tasks};
  report.table =
      benchmark_text(write_benchmark(evaluation, context.directory), context.request.experiment);
  write_results(context.request, context.directory);
  return report;
}

}  // namespace

BeliefReport score_beliefs(const BeliefRequest& wanted, const RunOptions& options) {
  require_no_links(wanted.run);
  std::optional<DirectoryLock> lock;
  if (owner_of(wanted.run)) lock.emplace(wanted.run, Access::alone, options.command);
  RunRequest request = read_request(wanted.run);  // throws if no run owns the directory
  if (!is_there(wanted.run / "manifest.json")) {
    throw InputError(fmt::format("{}: is not finished: run the same experiment again first",
                                 wanted.run.string()));
  }
  RunDirectory directory(request.experiment.name, request.id, wanted.run);
  directory.keep(*lock);
  ExperimentContext context = start(std::move(request), std::move(directory), options);
  try {
    return scored(wanted, context);
  } catch (const Stopped&) {
    throw Stopped("stopped; nothing was scored or changed");
  }
}

}  // namespace touchdown::experiments
