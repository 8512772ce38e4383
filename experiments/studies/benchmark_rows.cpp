#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/run_directory/store.hpp"
#include "experiments/studies/benchmark.hpp"

namespace touchdown::experiments {

namespace {

bool is_fitted_scene(const Experiment& experiment, const std::string& file) {
  const std::vector<std::string>& fitted = experiment.fit.scenarios;
  return std::find(fitted.begin(), fitted.end(), file) != fitted.end() ||
         std::any_of(experiment.training_segments.begin(), experiment.training_segments.end(),
                     [&](const TrainingSegments& segments) { return segments.scenario == file; });
}

std::string fitted_on(const Condition& condition, const BenchmarkSetup& here,
                      const std::vector<BenchmarkSetup>& setups) {
  if (condition.is_fitted_in_domain(here.robot_and_sensors.fit)) return "own";
  if (condition.fit_simulator != condition.test_simulator) return condition.fit_simulator;
  const auto there = std::find_if(setups.begin(), setups.end(), [&](const BenchmarkSetup& setup) {
    return setup.robot_and_sensors.fit == condition.fit;
  });
  return fmt::format("{} {}", there->robot, there->sensors);
}

/// The row of a scene in which every run failed.
BenchmarkRow without_scores(BenchmarkRow row) {
  row.balanced_accuracy = {std::numeric_limits<double>::quiet_NaN()};
  row.score = {};
  row.extended = {};
  return row;
}

std::vector<BenchmarkRow> rows_of(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const std::vector<std::string>& scenes = experiment.test.scenarios;
  const scoring::BootstrapConfig& bootstrap = experiment.intervals.bootstrap;
  std::vector<BenchmarkRow> rows;
  const auto setups = benchmark_setups(evaluation.request, evaluation.plan);
  for (const BenchmarkSetup& setup : setups) {
    for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
      const auto runs = runs_in_scene(evaluation.plan, experiment, setup.group, scene);
      const Store saved = in_memory(evaluation.plan, runs, evaluation.saved);
      const CollectedCounts counts = collect(evaluation.plan, runs, saved);
      const auto extended =
          measured_samples<scoring::ExtendedScore>(extended_measure, runs, evaluation.plan, saved);
      for (std::size_t c = 0; c < counts.scored.size(); ++c) {
        const ConditionScores& scored = counts.scored[c];
        if (scored.condition.refit > 0) continue;
        const std::string& simulator = scored.condition.test_simulator;
        BenchmarkRow row{simulator,
                         setup.robot,
                         setup.sensors,
                         scenario_of(evaluation.request, scenes[scene]).scenario.name,
                         is_fitted_scene(experiment, scenes[scene]) ? "test" : "unseen",
                         {},
                         scored.condition.estimator,
                         fitted_on(scored.condition, setup, setups),
                         {},
                         {},
                         {}};
        for (const std::size_t index : runs) {
          const Rollout& run = evaluation.runs.at(index);
          if (run.plan.simulator != simulator) continue;
          ++row.runs;
          row.failed += run.failed() ? 1 : 0;
        }
        for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
          row.noise = experiment.highlights[cell];
          if (scored.samples[cell].empty()) {
            if (row.runs > 0 && row.failed == row.runs) rows.push_back(without_scores(row));
            continue;
          }
          const FitsAndRuns fits = fits_and_runs(points_by_fit(counts, scored.condition, cell));
          row.refits = fits.of_refit.size();
          row.balanced_accuracy =
              balanced_accuracy(fits, stream_of(scene, simulator, experiment), bootstrap);
          row.score = scoring::sum(scored.samples[cell]).wheels();
          row.extended = scoring::sum(samples_of(extended, scored.condition, cell));
          rows.push_back(row);
        }
      }
    }
  }
  return rows;
}

constexpr const char* submission_parts = "submissions";

std::vector<SubmissionScores> saved_submissions(const Store& store) {
  using CountsByCell = std::vector<std::map<std::string, TaskCounts>>;
  std::vector<SubmissionScores> all;
  for (const std::string& name : store.names(submission_parts)) {
    std::optional<CountsByCell> by_cell = store.find<CountsByCell>(submission_parts, name);
    if (by_cell) all.push_back({name, *std::move(by_cell)});
  }
  return all;
}

/// A plan that scores one estimator alone, at one noise setting.
Plan plan_for(const std::string& estimator, const noise::NoiseCell& cell,
              const Evaluation& evaluation) {
  Plan plan = evaluation.plan;
  for (const BenchmarkSetup& setup : benchmark_setups(evaluation.request, plan)) {
    RunGroup& group = plan.groups[setup.group];
    group.conditions.clear();
    for (const std::string& simulator : evaluation.request.experiment.simulators) {
      group.conditions.push_back({simulator, simulator, estimator, group.fit});
    }
    group.counted.clear();
    group.scored = {cell};
  }
  return plan;
}

}  // namespace

double extra_switches_per_minute(const BenchmarkRow& row) {
  return 60e6 * scoring::ratio(row.extended.extra_switches, row.score.scored_us);
}

void save(const SubmissionScores& scores, const Store& store) {
  store.put(submission_parts, scores.name, scores.by_cell);
}

std::vector<BenchmarkRow> benchmark_rows(const Evaluation& evaluation,
                                         const RunDirectory& directory) {
  std::vector<BenchmarkRow> rows = rows_of(evaluation);
  for (const SubmissionScores& scores : saved_submissions(directory.store())) {
    for (std::size_t cell = 0; cell < scores.by_cell.size(); ++cell) {
      RunRequest request = evaluation.request;
      request.experiment.highlights = {evaluation.request.experiment.highlights[cell]};
      Plan plan = plan_for(scores.name, request.experiment.highlights.front(), evaluation);
      std::map<std::string, TaskCounts> counts = scores.by_cell[cell];
      std::set<std::size_t> incomplete;
      for (const Task& task : plan.tasks) {
        const std::string name = task_name(plan, task);
        if (evaluation.runs.at(task.run).failed()) {
          counts.emplace(name, TaskCounts{});
        } else if (!counts.contains(name)) {
          incomplete.insert(task.run);
        }
      }
      constexpr std::size_t no_group = std::size_t{0} - 1;
      for (const std::size_t run : incomplete) plan.runs[run].group = no_group;
      const Store in_memory;
      for (const auto& [name, found] : counts) in_memory.put(task_parts, name, found);
      const Evaluation alone{request,   plan,           evaluation.runs,
                             in_memory, evaluation.own, evaluation.models};
      for (BenchmarkRow& row : rows_of(alone)) rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace touchdown::experiments
