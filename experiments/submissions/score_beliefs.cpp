#include "experiments/submissions/score_beliefs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/terminal_text.hpp"
#include "core/yaml.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/results/long_table.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/studies/benchmark.hpp"
#include "experiments/submissions/export.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;

struct BeliefFile {
  fs::path path;
  std::size_t run = 0;  ///< index in the exported runs
};

struct Submission {
  std::vector<BeliefFile> files;  ///< about test runs, in the order of the runs
  std::size_t about_fitted = 0;   ///< files about fitted runs, which are not scored
};

bool is_hidden(const fs::path& name) {
  return std::any_of(name.begin(), name.end(),
                     [](const fs::path& part) { return part.string().starts_with('.'); });
}

/// The relative paths of all files below the folder that are not hidden, sorted.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> names;
  std::error_code ignored;
  for (const fs::path& entry : entries_below(folder)) {
    const fs::path name = entry.lexically_relative(folder);
    if (fs::is_regular_file(entry, ignored) && !is_hidden(name)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

Submission submission_of_folder(const fs::path& folder, const std::vector<ExportedRun>& runs) {
  std::map<std::string, std::size_t> number;
  for (std::size_t i = 0; i < runs.size(); ++i) number.emplace(runs[i].name, i);
  std::map<std::size_t, fs::path> found;
  Submission all;
  for (const fs::path& name : files_below(folder)) {
    const fs::path path = folder / name;
    const std::string stem = (name.parent_path() / name.stem()).generic_string();
    const auto run = number.find(stem);
    if (run == number.end()) {
      std::vector<std::string> known;
      for (const auto& [one, index] : number) known.push_back(one);
      throw InputError(fmt::format("{}: the benchmark has no run of this name{}", path.string(),
                                   did_you_mean(stem, known)));
    }
    const auto [there, is_new] = found.emplace(run->second, path);
    if (!is_new) {
      throw InputError(fmt::format("{}: {} is about the same run: expected one of them",
                                   path.string(), there->second.string()));
    }
  }
  for (const auto& [index, path] : found) {
    if (runs[index].task) {
      all.files.push_back({path, index});
    } else {
      ++all.about_fitted;
    }
  }
  return all;
}

Submission submission_of_file(const fs::path& file, const std::vector<ExportedRun>& runs) {
  Submission all;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].task) continue;
    known.push_back(fs::path(runs[i].name).filename().string());
    if (known.back() == file.stem()) all.files.push_back({file, i});
  }
  if (all.files.size() == 1) return all;
  if (all.files.empty()) {
    throw InputError(fmt::format("{}: the benchmark has no test run of this name{}", file.string(),
                                 did_you_mean(file.stem().string(), known)));
  }
  throw InputError(fmt::format(
      "{}: the benchmark has {} runs of this name, '{}' and '{}' among them: expected a folder "
      "with a file for each",
      file.string(), all.files.size(), runs[all.files[0].run].name, runs[all.files[1].run].name));
}

/// Finds the files of a submission: those in a folder, named as in the export, or one file with the
/// name of exactly one run. Hidden files are ignored. Errors: `InputError` for a file with another
/// name, two files about one run, and no file at all.
Submission submission_in(const fs::path& beliefs, const std::vector<ExportedRun>& runs) {
  if (!is_there(beliefs)) {
    throw InputError(fmt::format("{}: no such file or folder", beliefs.string()));
  }
  Submission all =
      is_folder(beliefs) ? submission_of_folder(beliefs, runs) : submission_of_file(beliefs, runs);
  if (all.files.empty()) {
    throw InputError(
        fmt::format("{}: holds no beliefs about a test run: expected files such as {}.csv",
                    beliefs.string(), runs.back().name));
  }
  return all;
}

/// Reads every file once to check its content. Errors: the `InputError` of the first invalid file;
/// `Stopped`.
void require_sound(const std::vector<BeliefFile>& files, const ShouldContinue& should_continue) {
  std::vector<std::string> complaints(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    if (!should_continue()) throw Stopped();
    try {
      static_cast<void>(logs::read_beliefs(files[i].path));
    } catch (const InputError& error) {
      complaints[i] = error.what();
    }
  });
  for (const std::string& complaint : complaints) {
    if (!complaint.empty()) throw InputError(complaint);
  }
}

std::size_t step_of(const logs::Beliefs& beliefs, std::size_t index, const RunSignals& run) {
  const double period = run.period();
  const double step = std::round(beliefs.time[index] / period);
  if (step >= 0.0 && step < static_cast<double>(run.steps())) return static_cast<std::size_t>(step);
  throw InputError(fmt::format("{}: time {} s: expected one of the run, from 0 to {:.6g} s",
                               beliefs.place(index), beliefs.time[index],
                               period * static_cast<double>(run.steps() - 1)));
}

Belief belief_of(const logs::Beliefs& beliefs, std::size_t index) {
  Belief belief;
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    belief.wheel[w] = {beliefs.p_contact[w][index], beliefs.contact[w][index] != 0};
  }
  multiply_wheels(belief);
  return belief;
}

std::string name_of(const BeliefRequest& wanted) {
  std::string name = wanted.name;
  if (name.empty()) {
    const fs::path path = absolute_path(wanted.beliefs).lexically_normal();
    name = (path.has_filename() ? path : path.parent_path()).stem().string();
  }
  if (!is_name_word(name) || terminal_text(name) != name) {  // JSON files hold UTF-8 only
    throw InputError(fmt::format("--name: '{}': {}", name, expected_name_word));
  }
  const std::vector<std::string> taken = estimator_names();
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) {
    throw InputError(fmt::format(
        "--name: '{}' is one of touchdown's own estimators: expected another name", name));
  }
  return name;
}

/// Every run, with the report of test runs from the saved parts.
FinishedRuns runs_as_saved(const ExperimentContext& context) {
  const Plan& plan = context.plan;
  FinishedRuns runs;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) runs[i].plan = plan.runs[i];
  for (const Task& task : plan.tasks) {
    const std::optional<TaskCounts> counts = saved_counts(plan, task, context.directory.store());
    if (!counts) {
      throw InputError(fmt::format("{}: is not finished: run the same experiment again first",
                                   context.directory.path().string()));
    }
    runs.at(task.run).report = counts->report;
  }
  return runs;
}

/// The files to score: those of runs with a submitted file for every noise realisation of a noise
/// setting. The report names the missing files of the other runs that could be scored.
std::vector<BeliefFile> complete(const std::vector<BeliefFile>& files,
                                 const std::vector<ExportedRun>& exported, const FinishedRuns& runs,
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

/// The scores of these files, by task.
std::vector<SubmittedRun> scores_of(const std::vector<BeliefFile>& files,
                                    const std::vector<ExportedRun>& exported,
                                    ExperimentContext& context, BeliefReport& report) {
  Plan& plan = context.plan;
  const Experiment& experiment = context.request.experiment;
  std::vector<SubmittedRun> scores(files.size());
  std::map<std::size_t, std::vector<std::size_t>> by_run;  // indices of files
  std::set<std::size_t> needed;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::size_t index = exported[files[i].run].run;
    PlannedRun& run = plan.runs[index];
    run.kept = run.kept && is_recorded(run, context.directory);
    by_run[index].push_back(i);
    needed.insert(index);
  }
  std::mutex mutex;
  for_each_rollout(
      "scoring", experiment, plan, needed, context.directory, MissingRun::refuse,
      context.should_continue, [&](std::size_t index, const Rollout& rollout) {
        const RunSignals& run = rollout.signals;
        const std::int64_t period = run.info.control_period_us;
        for (const std::size_t i : by_run.at(index)) {
          if (!context.should_continue()) throw Stopped();
          const ExportedRun& about = exported[files[i].run];
          const SubmittedPrediction submitted =
              prediction_of(logs::read_beliefs(files[i].path), run);
          const scoring::Prediction& prediction = submitted.prediction;
          scores[i] = {
              *about.task, about.cell,
              scoring::score(run.contact, prediction, run.segments, period, experiment.scoring),
              scoring::extended_score(run.contact, run.normal_force, prediction, period,
                                      experiment.scoring)};
          const std::scoped_lock lock(mutex);
          report.missing_steps += submitted.without;
          report.files_with_missing += submitted.without > 0 ? 1 : 0;
        }
      });
  std::ranges::stable_sort(scores, {}, &SubmittedRun::task);
  return scores;
}

BeliefReport scored(const BeliefRequest& wanted, ExperimentContext& context) {
  BeliefReport report;
  report.name = name_of(wanted);
  const std::vector<ExportedRun> exported = exported_runs(context.request, context.plan);
  const FinishedRuns runs = runs_as_saved(context);
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
  const std::vector<SubmittedRun> scores = scores_of(files, exported, context, report);
  if (!context.should_continue()) throw Stopped();
  save(report.name, scores, context.directory.store());
  const Plan& plan = context.plan;
  const ScoreRows own = score_rows(plan.runs_in(0), plan, context.directory.store());
  const FittedModels no_models;
  const Evaluation evaluation{context.request,           plan, runs,
                              context.directory.store(), own,  no_models};
  report.table = write_benchmark(evaluation, context.directory);
  write_results(context.request, context.directory);
  return report;
}

}  // namespace

SubmittedPrediction prediction_of(const logs::Beliefs& beliefs, const RunSignals& run) {
  SubmittedPrediction result;
  Belief belief;
  apply_threshold(belief, 0.5);
  std::size_t next = 0;  // belief
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (next < beliefs.size() && step_of(beliefs, next, run) == k) {
      belief = belief_of(beliefs, next++);
      if (next < beliefs.size() && step_of(beliefs, next, run) == k) {
        throw InputError(fmt::format("{}: time {} s: expected one belief per step of {} ms",
                                     beliefs.place(next), beliefs.time[next],
                                     1e-3 * static_cast<double>(run.info.control_period_us)));
      }
    } else if (has_record(run.signals[k])) {
      ++result.without;
    }
    scoring::add_step(result.prediction, belief);
  }
  return result;
}

BeliefReport score_beliefs(const BeliefRequest& wanted, const RunOptions& options) {
  ExperimentContext context = reopened(wanted.run, options);
  if (!is_there(wanted.run / "manifest.json")) {
    throw InputError(fmt::format("{}: is not finished: run the same experiment again first",
                                 wanted.run.string()));
  }
  try {
    return scored(wanted, context);
  } catch (const Stopped&) {
    throw Stopped("stopped; nothing was scored or changed");
  }
}

}  // namespace touchdown::experiments
