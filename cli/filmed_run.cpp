#include "cli/filmed_run.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cli/belief_track.hpp"
#include "core/error.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/sweep.hpp"
#include "recordings/model_file.hpp"
#include "recordings/recording_file.hpp"

namespace touchdown {

namespace {

namespace fs = std::filesystem;

fs::path recording_of(const fs::path& directory, const std::string& simulator, int run) {
  std::vector<fs::path> found;
  std::error_code ignored;
  const std::string ending = fmt::format("_test_{:03}.mpack", run);
  for (const auto& entry : fs::directory_iterator(directory / "recordings", ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(simulator + "_") && name.ends_with(ending)) found.push_back(entry.path());
  }
  return found.empty() ? fs::path() : *std::min_element(found.begin(), found.end());
}

FittedModel model_of(const fs::path& directory, const std::string& simulator,
                     const std::string& estimator) {
  const EstimatorEntry& entry = estimator_entry(estimator);
  const fs::path file = directory / "models" / fmt::format("{}_{}.npz", simulator, estimator);
  FittedModel model;
  if (entry.config) model.measurement = read_measurement_model(file);
  if (entry.phase) model.phase = std::make_shared<const PhaseModelFile>(read_phase_model(file));
  return model;
}

FilmedRun filmed_run(const fs::path& directory, const Experiment& experiment,
                     const std::string& simulator, const fs::path& log) {
  const VideoConfig& video = experiment.video;
  const NoiseLevels levels =
      with_encoder_noise({video.torque_noise, video.accelerometer_noise}, experiment.noise)
          .levels();
  const NoiseKey key = noise_key(experiment, 0, video.run);
  Recording recording = read_recording(log);
  const HeardRun heard =
      hear(recording, experiment.labels, experiment.scoring, experiment.intervals.over);
  const UnitNoise noise = unit_noise(heard, key);
  FittedModels models;
  std::vector<BeliefTrack> beliefs;
  for (const std::string& estimator : video.estimators) {
    models[simulator][estimator] = model_of(directory, simulator, estimator);
    beliefs.push_back(believe({simulator, simulator, estimator}, models, heard, noise, levels));
  }
  RobotModel robot = robot_of(recording);
  return {std::move(robot), with_noise(std::move(recording), key, levels), std::move(beliefs),
          experiment.labels};
}

}  // namespace

std::vector<FilmedRun> filmed_runs(const fs::path& run_directory) {
  if (!fs::exists(run_directory / "config.yaml")) {
    throw InputError(fmt::format("{}: no run directory of an experiment: it has no config.yaml",
                                 run_directory.string()));
  }
  const Experiment experiment =
      experiment_from_yaml(YamlDocument::load(run_directory / "config.yaml"));
  std::vector<FilmedRun> runs;
  for (const std::string& simulator : experiment.simulators) {
    const fs::path log = recording_of(run_directory, simulator, experiment.video.run);
    if (!log.empty()) runs.push_back(filmed_run(run_directory, experiment, simulator, log));
  }
  return runs;
}

FilmedRun filmed_recording(const fs::path& log, std::vector<std::string>& warnings) {
  Recording recording = read_recording(log, &warnings);
  RobotModel robot = robot_of(recording);
  return {std::move(robot), std::move(recording), {}, {}};
}

bool is_run_directory(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

}  // namespace touchdown
