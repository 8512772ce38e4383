#include "experiments/odometry_study/trajectories.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/fitting/make_estimator.hpp"
#include "experiments/odometry/contact_sources.hpp"
#include "experiments/odometry/dead_reckoning.hpp"
#include "experiments/odometry_study/plan.hpp"

namespace touchdown::experiments {

namespace {

constexpr double spacing = 0.01;  // s

/// As odometry is told in one run, in the order of `told_by`.
std::vector<ContactTrack> tracks_of(const RunGroup& group, const RunSignals& run,
                                    const NoiseRun& noise, const FittedModels& models) {
  std::vector<ContactTrack> tracks = oracle_tracks(*group.odometry, run);
  for (const Condition& condition : tested_on(group.conditions, run.info.simulator)) {
    if (!group.tells_odometry(condition)) continue;
    const auto estimator = make_estimator(condition, models, run);
    scoring::Prediction told = predict(*estimator, run, noise, group.scored.front().levels());
    tracks.push_back({std::move(told[0].p_contact), std::move(told[1].p_contact)});
  }
  return tracks;
}

}  // namespace

void write_trajectories(const Listened& listened, const FittedModels& models,
                        const RunDirectory& directory) {
  const Experiment& experiment = listened.request.experiment;
  const RunGroup& group = listened.plan.groups.front();
  for (const Task& task : listened.plan.tasks) {
    const PlayedRun& played = listened.runs.at(task.run);
    const bool is_first =
        played.plan.group == 0 && task.seed == 0 && played.plan.run % experiment.test.runs == 0;
    if (!is_first || played.failed()) continue;
    const RunSignals& run = played.signals;
    const NoiseRun noise = noise_run(run, task.noise);
    const auto stride = static_cast<std::size_t>(std::max(
        1LL, std::llround(1e6 * spacing / static_cast<double>(run.info.control_period_us))));
    const auto write = [&](const std::string& name, const scoring::Trajectory& way) {
      write_atomically(
          directory.file("trajectories", fmt::format("{}_{}_{}.tum", played.plan.simulator,
                                                     played.plan.scenario.name, name)),
          scoring::to_tum(way, stride));
    };
    const std::size_t first =
        scoring::first_scored_step(run.info.control_period_us, experiment.scoring);
    if (first >= run.steps()) continue;
    const auto scored = [&](const scoring::Trajectory& way) {
      return scoring::Trajectory(way.begin() + static_cast<std::ptrdiff_t>(first), way.end());
    };
    const scoring::Trajectory truth = scored(run.motion->truth);
    write("ground_truth", truth);
    const std::vector<std::string> names = told_by(group, played.plan.simulator);
    const std::vector<ContactTrack> tracks = tracks_of(group, run, noise, models);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const scoring::Trajectory told = scored(
          dead_reckoned(run, noise, group.scored.front().levels(), {tracks[i][0], tracks[i][1]}));
      write(names[i], scoring::begun_as(told, truth.front()));
    }
  }
}

}  // namespace touchdown::experiments
