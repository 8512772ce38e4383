#include "render/studies/worst_segments.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/make_estimator.hpp"
#include "experiments/plan/sensors.hpp"
#include "render/benchmark/scores.hpp"
#include "render/film/video.hpp"
#include "render/report/filmed_run.hpp"
#include "scenarios/engine.hpp"

namespace touchdown::render {

namespace {

constexpr double shown = 2.0;  ///< length of a film (s)

/// The runs of a standing's worst scene.
std::vector<experiments::PlannedRun> worst_runs(const experiments::ExperimentResult& result,
                                                const Standing& standing) {
  std::vector<experiments::PlannedRun> runs;
  for (const experiments::Rollout& run : result.runs) {
    const experiments::PlannedRun& plan = run.plan;
    if (plan.role == experiments::RunRole::test && !run.failed() && plan.group == 0 &&
        plan.simulator == standing.worst_simulator && plan.scenario.name == standing.worst_scene) {
      runs.push_back(plan);
    }
  }
  return runs;
}

/// The number of wheels about which the estimator decides wrongly, at every scored step.
std::vector<int> wrong_decisions(const FilmedRun& run, const scoring::ScoringConfig& scoring) {
  const auto contact = scoring::contact_labels(run.recording, run.labels);
  const auto& decisions = run.beliefs.front().contact;
  std::vector<int> wrong(run.recording.steps());
  for (std::size_t k = scoring::first_scored_step(run.recording.info.control_period_us, scoring);
       k < wrong.size(); ++k) {
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      wrong[k] += contact[wheel][k] != decisions[wheel][k] ? 1 : 0;
    }
  }
  return wrong;
}

void film_worst_segment(const experiments::ExperimentResult& result, const Standing& standing,
                        const noise::SensorProfile& profile, const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  const std::vector<experiments::PlannedRun> plans = worst_runs(result, standing);
  if (plans.empty()) return;
  const std::vector<std::string> estimators = {standing.estimator};
  const experiments::FittedModels models =
      read_models(result.directory.path(), experiment, standing.worst_simulator, estimators);
  std::vector<FilmedRun> runs;
  std::vector<std::vector<int>> wrong;
  for (const experiments::PlannedRun& plan : plans) {
    runs.push_back(filmed(scenarios::play(plan.scenario, plan.simulator, plan.seed, plan.run),
                          experiment, profile,
                          {estimators, models, experiment.highlights.front().levels()}));
    wrong.push_back(wrong_decisions(runs.back(), experiment.scoring));
  }
  const double period = runs.front().recording.period();
  const WorstSegment segment =
      worst_segment(wrong, static_cast<std::size_t>(std::llround(shown / period)));
  const FilmedRun& run = runs[segment.run];
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
