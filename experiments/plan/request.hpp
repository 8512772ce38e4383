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

/// A scenario as the experiment names it, found and read.
struct NamedScenario {
  std::string file;
  std::string robot;  ///< that a benchmark puts into it; empty: its own
  scenarios::Scenario scenario;
};

/// An experiment with everything that decides its results.
struct RunRequest {
  Experiment experiment;
  std::vector<NamedScenario> scenarios;  ///< in the order of first use
  std::vector<NamedSensors> sensors;     ///< likewise
  std::string id;                        ///< a digest of all
};

/// Errors: `InputError` for scenarios and sensors that are missing or wrong.
RunRequest request_of(const Experiment& experiment);

/// One of the request's own scenarios, with one of its robots.
const NamedScenario& scenario_of(const RunRequest& request, const std::string& file,
                                 std::string_view robot = {});

/// The request and the build that a run directory's contents belong to: what state is saved under.
std::string state_key(const RunRequest& request);

/// Errors: `InputError` when a directory holds another experiment, named with its request, unless
/// it is to be overwritten; or when it holds files that no run made where a run would write.
void require_place(const RunRequest& request, const std::filesystem::path& directory,
                   bool overwrite);

/// Whether a run directory is this request's and this build's already.
bool is_written(const RunRequest& request, const std::filesystem::path& directory);

/// Makes a directory that `require_place` allows this request's, so that `merge` needs nothing
/// else. What another request or another build made there is removed; whoever calls this has the
/// directory alone.
void write_request(const RunRequest& request, const RunDirectory& directory, bool overwrite);

/// Reads it back. Errors: `InputError` when the directory holds none, one of another build, or not
/// what was written there.
RunRequest read_request(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
