#include "experiments/score_beliefs.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file_names.hpp"
#include "experiments/studies/benchmark/tables.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/submissions/belief_folder.hpp"
#include "experiments/submissions/prediction.hpp"
#include "experiments/submissions/rows.hpp"
#include "experiments/submissions/saved_scores.hpp"
#include "experiments/run_directory/owner.hpp"
#include "recordings/beliefs/file.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;

std::string name_of(const BeliefRequest& wanted) {
  std::string name = wanted.name;
  if (name.empty()) {
    const fs::path path = fs::absolute(wanted.beliefs).lexically_normal();
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

/// Every run as the parts that are saved tell of it: whether it can be scored, and nothing more.
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
    if (counts->counted.empty() && counts->scored.empty()) {
      runs.at(task.run).report.outcome = recordings::Outcome::fell;
    }
  }
  return runs;
}

/// Runs of which every noise realisation was handed in, at one noise setting, are scored; others
/// are not, and what was not handed in for any that could be is named.
std::vector<BeliefFile> complete(const std::vector<BeliefFile>& files,
                                 const std::vector<HeardRun>& heard, const Rollouts& runs,
                                 BeliefReport& report) {
  std::set<std::size_t> given;
  for (const BeliefFile& file : files) given.insert(file.heard);
  std::set<std::pair<std::size_t, std::size_t>> incomplete;  // run, cell
  for (std::size_t i = 0; i < heard.size(); ++i) {
    if (!heard[i].task || given.contains(i) || runs.at(heard[i].run).failed()) continue;
    report.without.push_back(heard[i].name);
    incomplete.emplace(heard[i].run, heard[i].cell);
  }
  std::vector<BeliefFile> scored;
  std::set<std::pair<std::size_t, std::size_t>> complete_ones;
  for (const BeliefFile& file : files) {
    const HeardRun& run = heard[file.heard];
    if (runs.at(run.run).failed()) {
      ++report.about_failed;
    } else if (!incomplete.contains({run.run, run.cell})) {
      scored.push_back(file);
      complete_ones.emplace(run.run, run.cell);
    }
  }
  report.scored = complete_ones.size();
  return scored;
}

SubmissionScores scores_of(const std::vector<BeliefFile>& files, const std::vector<HeardRun>& heard,
                        ExperimentContext& context, BeliefReport& report) {
  Plan& plan = context.plan;
  const Experiment& experiment = context.request.experiment;
  SubmissionScores scores{report.name, {}};
  scores.by_cell.resize(experiment.highlights.size());
  std::map<std::size_t, std::vector<const BeliefFile*>> by_run;
  std::set<std::size_t> needed;
  for (const BeliefFile& file : files) {
    PlannedRun& run = plan.runs[heard[file.heard].run];
    run.kept = run.kept && is_recorded(run, context.directory);
    by_run[heard[file.heard].run].push_back(&file);
    needed.insert(heard[file.heard].run);
  }
  std::mutex mutex;
  for_each_rollout(experiment, plan, needed, context.directory, MissingRun::refuse, context.should_continue,
                  [&](std::size_t index, const Rollout& run) {
                    for (const BeliefFile* file : by_run.at(index)) {
                      if (!context.should_continue()) throw Stopped();
                      const HeardRun& about = heard[file->heard];
                      const SubmittedPrediction said =
                          prediction_of(recordings::read_beliefs(file->path), run.signals);
                      TaskCounts counts;
                      add_scores(run.signals, said.prediction, experiment.scoring, true, counts);
                      const std::scoped_lock lock(mutex);
                      scores.by_cell[about.cell].emplace(task_name(plan, plan.tasks[*about.task]),
                                                         std::move(counts));
                      report.missing_steps += said.without;
                      report.files_with_missing += said.without > 0 ? 1 : 0;
                    }
                  });
  return scores;
}

BeliefReport scored(const BeliefRequest& wanted, ExperimentContext& context) {
  BeliefReport report;
  report.name = name_of(wanted);
  const std::vector<HeardRun> heard = exported_runs(context.request, context.plan);
  const Rollouts runs = runs_as_saved(context);
  const Submission handed = handed_in(wanted.beliefs, heard);
  require_sound(handed.files, context.should_continue);
  report.about_fitted = handed.about_fitted;
  const std::vector<BeliefFile> files = complete(handed.files, heard, runs, report);
  if (files.empty()) {
    throw InputError(fmt::format(
        "{}: holds no beliefs about all noise seeds of a run that stayed upright: {} of its files "
        "are missing, such as {}.csv",
        wanted.beliefs.string(), report.without.size(),
        report.without.empty() ? heard.back().name : report.without.front()));
  }
  const SubmissionScores scores = scores_of(files, heard, context, report);
  if (!context.should_continue()) throw Stopped();
  save(scores, context.request, context.directory);
  const Plan& plan = context.plan;
  const CollectedCounts own = collect(plan, plan.runs_in(0), context.saved);
  const Evaluation evaluation{context.request, plan, runs, context.saved, own};
  report.table =
      benchmark_text(write_benchmark(evaluation, context.directory), context.request.experiment);
  return report;
}

}  // namespace

BeliefReport score_beliefs(const BeliefRequest& wanted, const RunOptions& options) {
  std::optional<DirectoryLock> lock;
  if (owner_of(wanted.run)) lock.emplace(wanted.run, Access::alone, options.command);
  RunRequest request = read_request(wanted.run);  // complains of a directory that is nobody's
  if (!fs::exists(wanted.run / "manifest.json")) {
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
