#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "viewer/watch_live.hpp"
#include "viewer/watch_log.hpp"

namespace touchdown::viewer {

/// What is watched.
enum class SubjectKind : int {
  scenario,  ///< a scenario file, or the name of a drawn scenario
  robot,     ///< a robot's MJCF, URDF or YAML file, on flat ground
  log,       ///< a recording or a robot's log
  run        ///< an experiment's run directory
};

/// The request of the command line.
struct WatchRequest {
  std::string subject;
  std::vector<std::string> estimators;  ///< NAME or NAME=MODEL; empty: the default ones
  std::string engine = "mujoco";
  std::uint64_t seed = 1;
  std::int64_t run = -1;
  std::vector<std::string> overrides;  ///< KEY=VALUE, of the scenario
  std::string robot;                   ///< of a log
  std::string labels;                  ///< of a log
};

/// Errors: `InputError` for a file of another kind.
SubjectKind kind_of(const std::string& subject);

/// Errors: `InputError` for a scenario, a robot or an estimator that cannot be used.
LiveRequest live_request(const WatchRequest& request, SubjectKind kind);
LoggedRun logged_run(const WatchRequest& request, SubjectKind kind);

}  // namespace touchdown::viewer
