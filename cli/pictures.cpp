#include "cli/pictures.hpp"

#include <chrono>

#include <fmt/format.h>

#include "cli/belief_track.hpp"
#include "cli/drop_figures.hpp"
#include "cli/film_progress.hpp"
#include "cli/heatmaps.hpp"
#include "cli/score_figures.hpp"
#include "experiments/estimator_registry.hpp"
#include "recordings/recording_file.hpp"

namespace touchdown {

namespace {

const PlayedRun* filmed_run(const ExperimentResult& result, const std::string& simulator) {
  for (const PlayedRun& run : result.runs) {
    if (run.plan.role == RunRole::test && run.plan.simulator == simulator &&
        run.plan.run == result.experiment.video.run) {
      return &run;
    }
  }
  return nullptr;
}

Picture film(const ExperimentResult& result, const PlayedRun& run, const Session& session) {
  const Experiment& experiment = result.experiment;
  const NoiseLevels levels =
      with_encoder_noise({experiment.video.torque_noise, experiment.video.accelerometer_noise},
                         experiment.noise)
          .levels();
  const NoiseKey key = noise_key(experiment, 0, run.plan.run);
  const UnitNoise noise = unit_noise(run.heard, key);
  std::vector<BeliefTrack> beliefs;
  for (const std::string& estimator : experiment.video.estimators) {
    beliefs.push_back(believe({run.plan.simulator, run.plan.simulator, estimator}, result.models,
                              run.heard, noise, levels));
  }
  const Recording recording =
      with_noise(read_recording(result.directory.file("recordings", run.plan.file)), key, levels);
  const auto path = result.directory.file(
      "videos", fmt::format("{}_{}.mp4", run.plan.simulator, run.plan.scenario.name));
  VideoOptions options;
  options.labels = experiment.labels;
  options.workers = experiment.workers;
  options.progress = FilmProgress(fmt::format("filming {}", run.plan.simulator), session);
  render_video(robot_of(recording), recording, beliefs, options, path);
  return {"video", path};
}

}  // namespace

void add_figure(std::vector<Picture>& pictures, const std::string& kind, const Figure& figure) {
  pictures.push_back({kind, figure.png});
  pictures.push_back({"", figure.svg});
}

std::vector<Picture> draw_pictures(ExperimentResult& result, const Session& session) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Picture> pictures;
  if (result.cells.size() > 1) {
    for (const std::string& simulator : result.experiment.simulators) {
      add_figure(pictures, "heatmap",
                 draw_heatmap(success_heatmap(result, simulator),
                              result.directory.file("figures", "success_" + simulator)));
      if (const auto map = knee_wheel_heatmap(result, simulator)) {
        add_figure(pictures, "heatmap",
                   draw_heatmap(*map, result.directory.file("figures", "knee_wheel_" + simulator)));
      }
    }
  }
  for (Picture& drawn : draw_score_figures(result)) pictures.push_back(std::move(drawn));
  for (Picture& drawn : draw_drop_figures(result)) pictures.push_back(std::move(drawn));
  if (result.experiment.video.enabled) {
    for (const std::string& simulator : result.experiment.simulators) {
      const PlayedRun* run = filmed_run(result, simulator);
      if (run != nullptr) pictures.push_back(film(result, *run, session));
    }
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result.provenance.timings.emplace_back("draw", elapsed.count());
  return pictures;
}

}  // namespace touchdown
