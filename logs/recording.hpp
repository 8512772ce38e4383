#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/robot.hpp"

namespace touchdown::logs {

/// How a run ended.
enum class Outcome : int {
  finished,      ///< reached the end of its scenario
  timed_out,     ///< upright at the time limit, but not at the end
  fell,          ///< something other than a tyre touched the terrain, or the robot tipped over
  diverged,      ///< the physics engine gave NaN or unrealistic velocities
  left_terrain,  ///< the base is below the floor: the robot fell through the ground
};

/// "finished", "timed_out", "fell", "diverged", "left_terrain".
std::string_view to_text(Outcome outcome);
/// The inverse. Errors: `InputError` for anything else.
Outcome outcome_from_text(std::string_view text);

/// Origin of a recording. Fields that a log does not specify are empty or zero.
struct RecordingInfo {
  std::string scenario;   ///< name of the scenario
  std::string simulator;  ///< "mujoco" or "bullet"; empty for a real robot
  std::uint64_t seed = 0;
  std::int64_t run = 0;  ///< index of the run in its experiment
  std::int64_t control_period_us = 1000;
  std::optional<Outcome> outcome;
  /// The resolved scenario as YAML: enough to rebuild the terrain for a video.
  std::string scenario_yaml;
  std::string robot_digest = {};      ///< of that scenario's robot, as `scenarios::robot_digest`
  std::string robot = {};             ///< name of the robot of a robot's log, if the log states it
  double robot_mass = 0.0;            ///< of the simulated robot with what it carries (kg)
  std::filesystem::path folder = {};  ///< of the log's file, which does not hold it
};

/// One run, stored by columns. Row k is the observation at time k·period and the action for it.
/// `truth` has as many rows for simulated runs, and none for a robot's log.
struct Recording {
  RecordingInfo info;
  std::vector<models::Observation> observation;
  std::vector<models::Action> action;
  std::vector<models::GroundTruth> truth;

  std::size_t steps() const { return observation.size(); }
  double period() const { return 1e-6 * static_cast<double>(info.control_period_us); }
};

}  // namespace touchdown::logs
