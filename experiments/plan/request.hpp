#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/run_directory/directory.hpp"
#include "logs/recording.hpp"
#include "noise/gaussian.hpp"
#include "noise/sensor_profile.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::experiments {

/// A sensor profile under the name that the experiment uses, found and read.
struct NamedSensors {
  std::string file;
  noise::SensorProfile profile;
};

/// Reads the copies of the profiles in a run directory.
std::vector<NamedSensors> read_sensors(const Experiment& experiment,
                                       const std::filesystem::path& run_directory);

/// The profile of this file; ideal sensors for no file.
noise::SensorProfile profile_of(const std::vector<NamedSensors>& sensors, const std::string& file);

/// The key of the sensor errors of a run, the same in every engine.
noise::NoiseKey sensor_key(const Experiment& experiment, std::int64_t run);

/// Replaces the recorded observations of a run by the output of the sensor model, and targets by
/// those with the zeros of its joints. The same run of another engine gets the same draws.
void report_through_sensors(const noise::SensorProfile& profile, const Experiment& experiment,
                            std::int64_t run, logs::Recording& recording);

/// The caption of robot and sensors, such as "; sensors as in noise/profiles/upkie.yaml". It omits
/// ideal sensors, and the robot where each scenario has its own.
std::string setup_caption(const Experiment& experiment);

/// A scenario under the name that the experiment uses, found and read.
struct NamedScenario {
  std::string file;
  std::string robot;  ///< of a benchmark; empty: the scenario's own
  scenarios::Scenario scenario;
};

/// A file that a request reads, and a digest of its content. Experiments, scenarios and sensor
/// profiles count as they are resolved, so that comments and the order of their keys do not count.
struct RequestInput {
  std::string file;
  std::string digest;
};

/// An experiment with all inputs that determine its results.
struct RunRequest {
  Experiment experiment;
  std::vector<NamedScenario> scenarios;  ///< in the order of first use
  std::vector<NamedSensors> sensors;     ///< likewise
  /// All files that it reads: the experiment, its sensors and scenarios, their robots with included
  /// files and meshes, and models that come with the program.
  std::vector<RequestInput> inputs;
  std::string id;  ///< digest of all of these
};

/// Reads the scenarios and sensors of an experiment. Errors: `InputError` for files that are
/// missing or wrong.
RunRequest request_of(const Experiment& experiment);

/// A scenario of the request with one of its robots. Both must be part of the request.
const NamedScenario& scenario_of(const RunRequest& request, const std::string& file,
                                 std::string_view robot = {});

/// Errors: `InputError`, with the other request and the first input in which they differ, when the
/// directory holds another experiment and `overwrite` is false; also when it holds untracked files
/// where a run would write.
void require_place(const RunRequest& request, const std::filesystem::path& directory,
                   bool overwrite);

/// Whether a run directory already belongs to this request and this build.
bool is_written(const RunRequest& request, const std::filesystem::path& directory);

/// Writes the request into a directory that `require_place` allows. `finish_run` needs no other
/// input. Removes the files of another request or build. The caller must hold the directory's
/// exclusive lock.
void write_request(const RunRequest& request, const RunDirectory& directory, bool overwrite);

/// Reads the request of a directory. Errors: `InputError` when the directory holds none, one of
/// another build, or a request with an input that was changed after it was written, which is named.
RunRequest read_request(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
