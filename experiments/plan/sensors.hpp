#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "noise/gaussian.hpp"
#include "noise/sensor_profile.hpp"
#include "recordings/recording.hpp"

namespace touchdown::experiments {

/// A sensor profile under the name that the experiment uses, found and read.
struct NamedSensors {
  std::string file;
  noise::SensorProfile profile;
};

/// Reads the sensor profiles of an experiment. Clears the experiment's own `sensors` if that
/// profile is ideal, so that ideal sensors and none are the same request. Errors: `InputError` for
/// a file that is missing or wrong.
std::vector<NamedSensors> read_sensors(Experiment& experiment);

/// Reads the copies of the profiles in a run directory.
std::vector<NamedSensors> read_sensors(const Experiment& experiment,
                                       const std::filesystem::path& run_directory);

/// Writes copies of the profiles into a run directory, beside the scenarios.
void write_sensors(const std::vector<NamedSensors>& sensors,
                   const std::filesystem::path& run_directory);

/// The profile of this file; ideal sensors for no file.
noise::SensorProfile profile_of(const std::vector<NamedSensors>& sensors, const std::string& file);

/// The key of the sensor errors of a run, the same in every engine.
noise::NoiseKey sensor_key(const Experiment& experiment, std::int64_t run);

/// Replaces the recorded observations of a run by the output of the sensor model, and targets by
/// those with the zeros of its joints. The same run of another engine gets the same draws.
void report_through_sensors(const noise::SensorProfile& profile, const Experiment& experiment,
                            std::int64_t run, recordings::Recording& recording);

/// The caption of robot and sensors, such as "; sensors as in sensors/upkie.yaml". It omits ideal
/// sensors, and the robot where each scenario has its own.
std::string setup_caption(const Experiment& experiment);

}  // namespace touchdown::experiments
