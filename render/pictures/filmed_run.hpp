#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/estimators/fitted_model.hpp"
#include "models/robot_model.hpp"
#include "noise/sensor_noise.hpp"
#include "noise/sensors/profile.hpp"
#include "recordings/recording.hpp"
#include "render/film/video.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// A run with everything that filming it needs.
struct FilmedRun {
  models::RobotModel robot;
  recordings::Recording recording;
  std::vector<BeliefTrack> beliefs;
  scoring::LabelConfig labels;

  VideoSource source() const { return {robot, recording, beliefs}; }
};

/// Who listens to a filmed run, through which noise.
struct FilmedEstimators {
  std::vector<std::string> estimators;
  const experiments::FittedModels& models;
  noise::SensorNoise noise;
};

/// A run of an experiment as its sensors report it, with the noise of its first realisation, and
/// what estimators that were fitted in its engine make of it.
FilmedRun filmed(recordings::Recording recording, const experiments::Experiment& experiment,
                 const noise::SensorProfile& profile, const FilmedEstimators& filmed_estimators);

/// The run that an experiment films, for each of its engines: the recording with the noise that the
/// experiment asks for, and what the estimators made of it. An engine without that recording is
/// left out. Errors: `InputError` for a recording that is broken, or when the directory lacks a
/// model.
std::vector<FilmedRun> filmed_runs(const ReportSubject& subject);

/// A recording alone. Errors: `InputError` when it does not say on which terrain it was made.
/// What was wrong with the log but not fatal is added to `warnings`.
FilmedRun filmed_recording(const std::filesystem::path& log, std::vector<std::string>& warnings);

/// What a video calls after every frame: moves a bar that lives as long as this, and stops the
/// filming once the user asked for it (`Stopped`).
std::function<void(int done, int of)> film_progress(const std::string& what,
                                                    const std::atomic<bool>* stop);

}  // namespace touchdown::render
