#include "render/pictures/filmed_run.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/resources.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/plan/condition.hpp"
#include "recordings/log/recording_file.hpp"
#include "render/pictures/belief_track.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

experiments::FittedModel model_of(const fs::path& directory, const std::string& simulator,
                                  const std::string& estimator) {
  const auto kind = experiments::estimator_entry(estimator).fits();
  if (!kind) return {};
  return experiments::read_fitted_model(
      *kind, directory / "models" / experiments::model_name(simulator, estimator));
}

/// The recording as its sensors with this noise report it; the ground truth stays.
recordings::Recording with_noise(recordings::Recording recording, const noise::NoiseKey& key,
                                 const noise::SensorNoise& levels) {
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    recording.observation[k] = noise::with_noise(recording.observation[k], key, k, levels);
  }
  return recording;
}

/// The robot on the terrain of the scenario that a recording says it was made in.
models::RobotModel robot_of(const recordings::Recording& recording) {
  const recordings::RecordingInfo& info = recording.info;
  if (info.scenario_yaml.empty()) {
    throw InputError(
        "the recording does not say on which terrain it was made: a robot's own log "
        "cannot be drawn");
  }
  const scenarios::Scenario scenario = scenarios::scenario_from_yaml(
      YamlDocument::parse(info.scenario_yaml, info.scenario + " (in the log)"));
  return models::compile_robot_model(find_resource(scenario.robot), scenario.terrain);
}

FilmedRun filmed_run(const experiments::Experiment& experiment, const std::string& simulator,
                     const experiments::FittedModels& models, recordings::Recording recording) {
  const experiments::VideoConfig& video = experiment.video;
  const noise::SensorNoise levels =
      noise::with_encoder_noise({video.torque_noise, video.accelerometer_noise}, experiment.noise)
          .levels();
  const noise::NoiseKey key = experiments::noise_key(experiment, 0, video.run);
  const experiments::RunSignals heard = experiments::signals_of(
      recording, experiment.labels, experiment.scoring, experiment.intervals.over);
  const experiments::NoiseRun noise = experiments::noise_run(heard, key);
  std::vector<BeliefTrack> beliefs;
  for (const std::string& estimator : video.estimators) {
    beliefs.push_back(believe({simulator, simulator, estimator}, models, heard, noise, levels));
  }
  models::RobotModel robot = robot_of(recording);
  return {std::move(robot), with_noise(std::move(recording), key, levels), std::move(beliefs),
          experiment.labels};
}

}  // namespace

std::vector<FilmedRun> filmed_runs(const experiments::ExperimentResult& result) {
  const experiments::Experiment& experiment = result.experiment;
  std::vector<FilmedRun> filmed;
  for (const std::string& simulator : experiment.simulators) {
    const experiments::PlayedRun* run =
        experiments::test_run(result.runs, simulator, experiment.video.run);
    if (run == nullptr || !run->report.error.empty()) continue;
    filmed.push_back(filmed_run(
        experiment, simulator, result.models,
        recordings::read_recording(result.directory.file("recordings", run->plan.file))));
  }
  return filmed;
}

std::vector<FilmedRun> filmed_runs(const ReportSubject& subject) {
  const experiments::VideoConfig& video = subject.experiment.video;
  std::vector<FilmedRun> filmed;
  for (const experiments::RunSummary& run : subject.summary.runs) {
    if (run.role != experiments::RunRole::test || run.run != video.run) continue;
    const fs::path log = subject.directory / "recordings" / run.recording;
    if (!fs::exists(log)) continue;
    experiments::FittedModels models;
    for (const std::string& estimator : video.estimators) {
      models[run.simulator][estimator] = model_of(subject.directory, run.simulator, estimator);
    }
    filmed.push_back(
        filmed_run(subject.experiment, run.simulator, models, recordings::read_recording(log)));
  }
  return filmed;
}

FilmedRun filmed_recording(const fs::path& log, std::vector<std::string>& warnings) {
  recordings::Recording recording = recordings::read_recording(log, &warnings);
  models::RobotModel robot = robot_of(recording);
  return {std::move(robot), std::move(recording), {}, {}};
}

}  // namespace touchdown::render
