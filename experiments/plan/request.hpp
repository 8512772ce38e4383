#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/plan/sensors.hpp"
#include "experiments/run_directory/directory.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::experiments {

/// A scenario under the name that the experiment uses, found and read.
struct NamedScenario {
  std::string file;
  std::string robot;  ///< of a benchmark; empty: the scenario's own
  scenarios::Scenario scenario;
};

/// An experiment with all inputs that determine its results.
struct RunRequest {
  Experiment experiment;
  std::vector<NamedScenario> scenarios;  ///< in the order of first use
  std::vector<NamedSensors> sensors;     ///< likewise
  std::string id;                        ///< digest of all of these
};

/// Reads the scenarios and sensors of an experiment. Errors: `InputError` for files that are
/// missing or wrong.
RunRequest request_of(const Experiment& experiment);

/// A scenario of the request with one of its robots. Both must be part of the request.
const NamedScenario& scenario_of(const RunRequest& request, const std::string& file,
                                 std::string_view robot = {});

/// The key of saved state: the request and the build.
std::string state_key(const RunRequest& request);

/// Errors: `InputError`, with the other request, when the directory holds another experiment and
/// `overwrite` is false; also when it holds untracked files where a run would write.
void require_place(const RunRequest& request, const std::filesystem::path& directory,
                   bool overwrite);

/// Whether a run directory already belongs to this request and this build.
bool is_written(const RunRequest& request, const std::filesystem::path& directory);

/// Writes the request into a directory that `require_place` allows. `merge` needs no other input.
/// Removes the files of another request or build. The caller must hold the directory's exclusive
/// lock.
void write_request(const RunRequest& request, const RunDirectory& directory, bool overwrite);

/// Reads the request of a directory, which may have these studies' sections. Errors: `InputError`
/// when the directory holds none, one of another build, or a request that was changed after it was
/// written.
RunRequest read_request(const std::filesystem::path& directory, std::vector<StudySection> sections);

}  // namespace touchdown::experiments
