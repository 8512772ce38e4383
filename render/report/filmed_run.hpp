#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/estimators/fitted_model.hpp"
#include "logs/recording.hpp"
#include "models/robot_model.hpp"
#include "noise/sensor_noise.hpp"
#include "noise/sensor_profile.hpp"
#include "render/film/video.hpp"
#include "render/report/subject.hpp"

namespace touchdown {
class ContactEstimator;
struct Belief;
}  // namespace touchdown

namespace touchdown::render {

/// The robot of a recording, on the terrain of the scenario that the recording contains. Errors:
/// `InputError` when it contains none.
models::RobotModel recorded_robot(const logs::Recording& recording);

/// The models of these estimators in a run directory, with the hyperparameters that its tuning
/// chose. Errors: `InputError` when the directory lacks a model.
experiments::FittedModels read_models(const std::filesystem::path& directory,
                                      const experiments::Experiment& experiment,
                                      const std::string& simulator,
                                      const std::vector<std::string>& estimators);

/// Adds an estimator's belief at the next row. The estimator is null if it processed a whole run.
void add_belief(BeliefTrack& track, const ContactEstimator* estimator, const Belief& belief);

/// A run with all data for a film of it.
struct FilmedRun {
  models::RobotModel robot;
  logs::Recording recording;
  std::vector<BeliefTrack> beliefs;
  scoring::LabelConfig labels;

  VideoSource source() const { return {robot, recording, beliefs}; }
};

/// A run of an experiment as its sensors report it, with the first noise realisation at these
/// levels, and the beliefs of estimators that were fitted in its engine.
FilmedRun filmed(logs::Recording recording, const experiments::Experiment& experiment,
                 const noise::SensorProfile& profile, const std::vector<std::string>& estimators,
                 const experiments::FittedModels& models, const noise::SensorNoise& levels);

/// The run that an experiment films, for each of its engines: the recording with the experiment's
/// noise, and the estimators' beliefs. An engine without that recording is left out. Errors:
/// `InputError` for a broken recording, or when the directory lacks a model.
std::vector<FilmedRun> filmed_runs(const ReportSubject& subject);

/// A recording without beliefs. Non-fatal errors of the log are added to `warnings`. It stops once
/// `stop` is true. Errors: `Stopped`; `InputError` when the recording does not contain its terrain.
FilmedRun filmed_recording(const std::filesystem::path& log, std::vector<std::string>& warnings,
                           const std::atomic<bool>* stop = nullptr);

/// A callback for after every frame. It advances a progress bar, which lives as long as the
/// callback, and throws `Stopped` once the user has asked to stop.
std::function<void(int done, int of)> film_progress(const std::string& what,
                                                    const std::atomic<bool>* stop);

}  // namespace touchdown::render
