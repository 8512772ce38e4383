#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "models/robot.hpp"
#include "noise/gaussian.hpp"
#include "noise/sensors/profile.hpp"

namespace touchdown::experiments {

/// A profile as the experiment names it, found and read.
struct NamedSensors {
  std::string file;
  noise::SensorProfile profile;
};

/// Reads the profiles that an experiment names. Its own, under `sensors`, is not named any more if
/// it changes nothing: ideal sensors are the same request as none. Errors: `InputError` for a file
/// that is missing or wrong.
std::vector<NamedSensors> read_sensors(Experiment& experiment);

/// Reads them as they were when the request in this run directory was written.
std::vector<NamedSensors> read_sensors(const Experiment& experiment,
                                       const std::filesystem::path& run_directory);

/// Keeps them there, beside the scenarios.
void write_sensors(const std::vector<NamedSensors>& sensors,
                   const std::filesystem::path& run_directory);

/// The profile of this file; ideal sensors for no file.
noise::SensorProfile profile_of(const std::vector<NamedSensors>& sensors, const std::string& file);

/// By which draws the sensors of a run of the experiment err: whichever engine it is played in.
noise::NoiseKey sensor_key(const Experiment& experiment, std::int64_t run);

/// Turns what a run of the experiment recorded into what such sensors report. The same run of
/// another engine gets the same draws.
void report_through_sensors(const noise::SensorProfile& profile, const Experiment& experiment,
                            std::int64_t run, double period,
                            std::vector<models::Observation>& observations);

/// What captions say of robot and sensors: "; sensors as in sensors/upkie.yaml"; nothing of ideal
/// sensors, nor where each scenario has its own robot.
std::string setup_caption(const Experiment& experiment);

}  // namespace touchdown::experiments
