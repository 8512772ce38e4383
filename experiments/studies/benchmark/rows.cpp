#include "experiments/studies/benchmark/rows.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "experiments/evaluation/joint_bootstrap.hpp"

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

}  // namespace

double extra_switches_per_minute(const BenchmarkRow& row) {
  return 60e6 * scoring::ratio(row.extended.extra_switches, row.score.scored_us);
}

std::vector<BenchmarkRow> benchmark(const Evaluation& evaluation) {
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

}  // namespace touchdown::experiments
