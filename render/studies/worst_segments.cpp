#include "render/studies/worst_segments.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/make_estimator.hpp"
#include "experiments/plan/sensors.hpp"
#include "render/benchmark/scores.hpp"
#include "render/film/video.hpp"
#include "render/pictures/filmed_run.hpp"
#include "scenarios/engine.hpp"

namespace touchdown::render {

namespace {

constexpr double shown = 2.0;  ///< length of a film (s)

using Runs = std::vector<const experiments::Rollout*>;

Runs runs_of(const experiments::ExperimentResult& result, const Standing& standing) {
  Runs runs;
  for (const experiments::Rollout& run : result.runs) {
    if (run.plan.role == experiments::RunRole::test && !run.failed() &&
        run.plan.simulator == standing.worst_simulator &&
        run.plan.scenario.name == standing.worst_scene) {
      runs.push_back(&run);
    }
  }
  return runs;
}

/// The number of wheels about which an estimator decides wrongly, at every scored step.
std::vector<int> wrong_decisions(const experiments::ExperimentResult& result,
                                 const std::string& estimator, const experiments::Rollout& run,
                                 const noise::SensorNoise& levels) {
  const std::string& simulator = run.plan.simulator;
  const auto runner = experiments::make_estimator(
      result.experiment, {simulator, simulator, estimator}, result.models, run.signals);
  const auto drawn = experiments::noise_run(
      run.signals, experiments::noise_key(result.experiment, 0, run.plan.run));
  const auto decisions = experiments::decide(*runner, run.signals, drawn, levels);
  std::vector<int> wrong(run.signals.steps());
  for (std::size_t k = scoring::first_scored_step(run.signals.info.control_period_us,
                                                  result.experiment.scoring);
       k < wrong.size(); ++k) {
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      wrong[k] += run.signals.contact[wheel][k] != decisions[wheel][k] ? 1 : 0;
    }
  }
  return wrong;
}

void film_worst_segment(const experiments::ExperimentResult& result, const Standing& standing,
                        const noise::SensorProfile& profile, const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  const noise::SensorNoise levels = experiment.highlights.front().levels();
  const Runs runs = runs_of(result, standing);
  if (runs.empty()) return;
  std::vector<std::vector<int>> wrong;
  for (const experiments::Rollout* run : runs) {
    wrong.push_back(wrong_decisions(result, standing.estimator, *run, levels));
  }
  const double period = 1e-6 * static_cast<double>(runs.front()->signals.info.control_period_us);
  const auto length = static_cast<std::size_t>(shown / period);
  const WorstSegment segment = worst_segment(wrong, length);
  const experiments::PlannedRun& plan = runs[segment.run]->plan;
  const FilmedRun run = filmed(scenarios::play(plan.scenario, plan.simulator, plan.seed, plan.run),
                               experiment, profile, {{standing.estimator}, result.models, levels});
  VideoOptions options;
  options.width = 640;
  options.height = 360;
  options.crf = 28;
  options.from = period * static_cast<double>(segment.begin);
  options.to = options.from + shown;
  options.speed = 0.5;
  options.workers = experiment.workers;
  options.labels = run.labels;
  options.progress = film_progress(fmt::format("filming {}", standing.estimator), stop);
  render_video(
      {run.source()}, options,
      result.directory.own_file("videos", fmt::format("worst_{}.mp4", standing.estimator)));
}

}  // namespace

WorstSegment worst_segment(const std::vector<std::vector<int>>& wrong, std::size_t length) {
  WorstSegment worst{0, 0, -1};
  for (std::size_t run = 0; run < wrong.size(); ++run) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < wrong[run].size(); ++k) {
      sum += wrong[run][k];
      if (k >= length) sum -= wrong[run][k - length];
      if (k + 1 < std::min(length, wrong[run].size()) || sum <= worst.wrong) continue;
      worst = {run, k + 1 - std::min(length, k + 1), sum};
    }
  }
  return worst;
}

void film_worst_segments(const experiments::ExperimentResult& result,
                         const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  const noise::SensorProfile profile = experiments::profile_of(
      experiments::read_sensors(experiment, result.directory.path()), experiment.sensors);
  const BenchmarkScores scores = benchmark_scores(result.directory.path());
  if (scores.standings.empty()) return;
  const Standing& first = scores.standings.front();  // the experiment's own robot comes first
  for (const Standing& standing : scores.standings) {
    if (standing.setting != first.setting || standing.noise != first.noise) continue;
    const auto& names = experiment.estimators;
    const bool is_ours = std::find(names.begin(), names.end(), standing.estimator) != names.end();
    if (is_ours) film_worst_segment(result, standing, profile, stop);
  }
}

}  // namespace touchdown::render
