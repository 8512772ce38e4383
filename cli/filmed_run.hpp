#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment.hpp"
#include "models/robot_model.hpp"
#include "recordings/recording.hpp"
#include "render/video.hpp"

namespace touchdown {

/// A run with everything that filming it needs.
struct FilmedRun {
  RobotModel robot;
  Recording recording;
  std::vector<BeliefTrack> beliefs;
  LabelConfig labels;

  VideoSource source() const { return {robot, recording, beliefs}; }
};

/// The run that an experiment films, for each of its engines, from the experiment's run directory:
/// the recording with the noise that the experiment asks for, and what the estimators made of it,
/// with the models that were fitted then. An engine without that recording is left out.
/// Errors: `InputError` when the directory is none, or lacks a model.
std::vector<FilmedRun> filmed_runs(const std::filesystem::path& run_directory);

/// A recording alone. Errors: `InputError` when it does not say on which terrain it was made.
/// What was wrong with the log but not fatal is added to `warnings`.
FilmedRun filmed_recording(const std::filesystem::path& log, std::vector<std::string>& warnings);

/// Whether the path is an experiment's run directory.
bool is_run_directory(const std::filesystem::path& path);

}  // namespace touchdown
