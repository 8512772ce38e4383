#include "experiments/studies/odometry/trajectories.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/fitting/make_estimator.hpp"
#include "experiments/odometry/contact_sources.hpp"
#include "experiments/odometry/dead_reckoning.hpp"
#include "experiments/studies/odometry/plan.hpp"

namespace touchdown::experiments {

namespace {

constexpr double spacing = 0.01;  // s

/// The tracks of the contact sources in one run, in the order of `contact_sources_of`.
std::vector<ContactTrack> tracks_of(const Experiment& experiment, const RunGroup& group,
                                    const RunSignals& run, const NoiseRun& noise,
                                    const FittedModels& models) {
  std::vector<ContactTrack> tracks = oracle_tracks(*group.odometry, run);
  for (const Condition& condition : tested_on(group.conditions, run.info.simulator)) {
    if (!group.feeds_odometry(condition)) continue;
    const auto estimator = make_estimator(experiment, condition, models, run);
    scoring::Prediction prediction = predict(*estimator, run, noise, group.scored.front().levels());
    tracks.push_back({std::move(prediction[0].p_contact), std::move(prediction[1].p_contact)});
  }
  return tracks;
}

}  // namespace

void write_trajectories(const Evaluation& evaluation, const FittedModels& models,
                        const RunDirectory& directory) {
  const Experiment& experiment = evaluation.request.experiment;
  const RunGroup& group = evaluation.plan.groups.front();
  for (const Task& task : evaluation.plan.tasks) {
    const Rollout& rollout = evaluation.runs.at(task.run);
    const bool is_first =
        rollout.plan.group == 0 && task.seed == 0 && rollout.plan.run % experiment.test.runs == 0;
    if (!is_first || rollout.failed()) continue;
    const RunSignals& run = rollout.signals;
    const NoiseRun noise = noise_run(run, task.noise);
    const auto stride = static_cast<std::size_t>(std::max(
        1LL, std::llround(1e6 * spacing / static_cast<double>(run.info.control_period_us))));
    const auto write = [&](const std::string& name, const scoring::Trajectory& trajectory) {
      write_atomically(
          directory.file("trajectories", fmt::format("{}_{}_{}.tum", rollout.plan.simulator,
                                                     rollout.plan.scenario.name, name)),
          scoring::to_tum(trajectory, stride));
    };
    const std::size_t first =
        scoring::first_scored_step(run.info.control_period_us, experiment.scoring);
    if (first >= run.steps()) continue;
    const auto scored = [&](const scoring::Trajectory& trajectory) {
      return scoring::Trajectory(trajectory.begin() + static_cast<std::ptrdiff_t>(first),
                                 trajectory.end());
    };
    const scoring::Trajectory truth = scored(run.motion->truth);
    write("ground_truth", truth);
    const std::vector<std::string> names = contact_sources_of(group, rollout.plan.simulator);
    const std::vector<ContactTrack> tracks = tracks_of(experiment, group, run, noise, models);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const scoring::Trajectory estimated = scored(
          dead_reckoned(run, noise, group.scored.front().levels(), {tracks[i][0], tracks[i][1]}));
      write(names[i], scoring::aligned_at_start(estimated, truth.front()));
    }
  }
}

}  // namespace touchdown::experiments
